#include "render/turntable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/exposure.h"

namespace sateen {

namespace {
constexpr double turn_radians = std::numbers::pi / 180;

// About the vertical axis; a camera at azimuth a comes to a + angle.
Vec3 turned(const Vec3& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return Vec3(float(double(v.x) * c + double(v.z) * s), v.y, float(double(v.z) * c - double(v.x) * s));
}

// Rings that enclose what the mesh sweeps: its largest radius in each of many layers of height.
std::vector<Vec3> swept_points(const Mesh& mesh, const Vec3& pivot) {
  constexpr int layers = 128, corners = 64;
  std::array<float, layers> radius;
  radius.fill(-1);
  const float low = mesh.bounds_min.y, height = std::max(mesh.bounds_max.y - low, 1e-20f);
  for (const Vec3& p : mesh.positions) {
    const int layer = std::clamp(int((p.y - low) / height * layers), 0, layers - 1);
    radius[size_t(layer)] = std::max(radius[size_t(layer)], std::hypot(p.x - pivot.x, p.z - pivot.z));
  }
  // Outside the circle, so that its chords do not cut the mesh.
  const float outside = 1 / std::cos(pi / corners);
  std::vector<Vec3> points;
  for (int layer = 0; layer < layers; ++layer)
    if (radius[size_t(layer)] >= 0)
      for (int end = 0; end < 2; ++end)
        for (int i = 0; i < corners; ++i) {
          const float angle = 2 * pi * float(i) / corners, r = radius[size_t(layer)] * outside;
          points.emplace_back(pivot.x + r * std::cos(angle), low + height * float(layer + end) / layers,
                              pivot.z + r * std::sin(angle));
        }
  return points;
}
}  // namespace

const std::vector<std::string>& turn_names() {
  static const std::vector<std::string> names{"object", "camera", "light"};
  return names;
}

TurntableStart start_turntable(const Scene& scene, const CameraSettings& camera, Turn turn) {
  TurntableStart start;
  start.turn = turn;
  start.light_rotation = 2 * std::numbers::pi * scene.environment.rotation_turns;
  start.pivot = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  start.camera = turn == Turn::light ? scene.camera
                                     : frame_points(swept_points(*scene.mesh, start.pivot), camera,
                                                    scene.camera.width, scene.camera.height);
  return start;
}

void set_turning_stage(Scene& scene, TurntableStart& start, const StageSettings& settings) {
  scene.camera = start.camera;
  set_stage(scene, settings);
  scene.shutter = shutter_of(*scene.mesh, double(settings.shutter_deg), start.turn == Turn::camera);
  if (scene.ground) start.away = scene.ground->away;
}

void pose_turntable(Scene& scene, const TurntableStart& start, double angle_deg) {
  const double angle = angle_deg * turn_radians;
  const double walk = start.turn == Turn::object ? -angle : start.turn == Turn::camera ? angle : 0;
  Camera camera = start.camera;
  camera.position = start.pivot + turned(camera.position - start.pivot, walk);
  camera.right = turned(camera.right, walk);
  camera.up = turned(camera.up, walk);
  camera.forward = turned(camera.forward, walk);
  scene.camera = walk == 0 ? start.camera : camera;
  // The wall stays behind the object as the camera sees it; a frame knows nothing of where it stood in others.
  const Vec3 away = walk == 0 ? start.away : turned(start.away, walk);
  if (scene.ground && scene.ground->away != away) {
    scene.ground->away = away;
    if (solid_ground(scene)) renew_openness(scene);
  }
  set_rotation(scene.environment, start.light_rotation + (start.turn == Turn::camera ? 0 : angle));
}

float turntable_exposure(Environment& environment, Turn turn, float azimuth_deg, float environment_ev,
                         double degrees) {
  constexpr int steps = 24;
  if (turn == Turn::object) return metered_towards(environment, azimuth_deg, environment_ev);
  double light = 0;
  for (int i = 0; i < steps; ++i) {
    // A light that turns to the right meets the meter like a camera that walks to the right: see metered_towards.
    const float angle = float(degrees * i / steps);
    light += std::exp2(-double(metered_towards(environment, azimuth_deg + angle, environment_ev)));
  }
  return float(-std::log2(light / steps));
}

}  // namespace sateen
