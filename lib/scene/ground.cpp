#include "scene/ground.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

// All in radii of the object, tuned by eye with the default camera: the fade begins behind what an unzoomed picture
// shows of the floor, the sweep is soft and does not reach the object.
constexpr float fades_from = 5, fades_to = 16, wall_distance = 3, sweep_radius = 1.7f, highest_wall = 40;

double level_dot(const Vec3& a, const Vec3& b) {
  return double(a.x) * double(b.x) + double(a.z) * double(b.z);
}

float level_distance(const Ground& g, const Vec3& p) {
  return std::hypot(p.x - g.middle.x, p.z - g.middle.z);
}

float smooth_step(float from, float to, float value) {
  const float x = std::clamp((value - from) / (to - from), 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

/// Height at which the picture's upper edge meets the wall.
float seen_height(const Ground& g, const Camera& camera) {
  double height = -1e30;
  for (const double x : {0.0, 0.5, 1.0}) {
    const Ray ray = camera.ray(float(x * camera.width), 0);
    const double towards = level_dot(ray.direction, g.away);
    if (towards <= 0) return 1e30f;
    const double t = (double(g.wall) - level_dot(ray.origin - g.middle, g.away)) / towards;
    height = std::max(height, double(ray.origin.y) + t * double(ray.direction.y));
  }
  return float(height);
}

}  // namespace

Ground compile_ground(const GroundSettings& settings, const Mesh& mesh, const Camera& camera,
                      const Environment& environment) {
  Ground g;
  g.kind = settings.kind;
  g.albedo = settings.color;
  g.middle = (mesh.bounds_min + mesh.bounds_max) * 0.5f;
  const Vec3 extent = mesh.bounds_max - mesh.bounds_min;
  const float radius = std::max({std::hypot(extent.x, extent.z) / 2, extent.y / 2, 1e-20f});
  // A hair lower than the cloth, which may lie flat on it: by what no eye sees and floats still tell apart.
  const float far_out = std::max(std::abs(mesh.bounds_min.y), std::abs(mesh.bounds_max.y));
  const Placement& placement = mesh.placement;
  g.height = settings.height ? placement.held_length(double(*settings.height) - placement.origin.y)
                             : mesh.bounds_min.y - std::max(2e-4f * radius, 4e-7f * far_out);
  g.fade_from = fades_from * radius;
  g.fade_to = fades_to * radius;
  const float level = std::hypot(camera.forward.x, camera.forward.z);
  if (level > 1e-4f) g.away = Vec3(camera.forward.x / level, 0, camera.forward.z / level);
  g.wall = wall_distance * radius;
  g.sweep = sweep_radius * radius;
  const float lowest = std::max(g.height + g.sweep, g.height + 2 * (mesh.bounds_max.y - g.height));
  g.top = std::clamp(seen_height(g, camera) + 0.1f * radius, lowest, lowest + highest_wall * radius);
  g.open_sky = upward_irradiance(environment) / pi;
  g.radius = radius;
  return g;
}

std::optional<GroundPoint> meet_ground(const Ground& g, const Vec3& origin, const Vec3& direction, float t_max) {
  // A surface that is met is left for good: the space above a floor and before a cyclorama is convex, so a ray from
  // its border never meets the same place again and needs no offset.
  const double oy = double(origin.y) - double(g.height), dy = double(direction.y);
  const bool bent = g.kind == GroundKind::cyclorama;
  double t = -1, s = 0, ds = 0;
  Vec3 normal(0, 1, 0);
  const double foot = double(g.wall) - double(g.sweep);  // where the sweep begins
  if (bent) {
    s = level_dot(origin - g.middle, g.away);
    ds = level_dot(direction, g.away);
  }
  if (dy < 0 && oy >= 0 && (!bent || s - oy / dy * ds <= foot)) {
    t = -oy / dy;
  } else if (bent) {
    const double top = double(g.top) - double(g.height), radius = double(g.sweep);
    if (ds > 0 && s <= double(g.wall)) {
      const double at = (double(g.wall) - s) / ds, y = oy + at * dy;
      if (y >= radius && y <= top) {
        t = at;
        normal = -g.away;
      }
    }
    if (t < 0) {
      // The far root of the sweep's circle.
      const double x = s - foot, y = oy - radius, a = ds * ds + dy * dy, b = x * ds + y * dy;
      const double square = b * b - a * (x * x + y * y - radius * radius);
      if (a > 0 && square > 0) {
        const double at = (std::sqrt(square) - b) / a, px = x + at * ds, py = y + at * dy;
        if (at > 0 && px >= 0 && py <= 0) {
          t = at;
          const auto inward = float(-1 / std::hypot(px, py));
          normal = g.away * (float(px) * inward) + Vec3(0, float(py) * inward, 0);
        }
      }
    }
  }
  if (!(t >= 0 && t < double(t_max))) return std::nullopt;
  GroundPoint point;
  point.t = float(t);
  point.normal = normal;
  for (int k = 0; k < 3; ++k) point.position[k] = float(double(origin[k]) + t * double(direction[k]));
  if (normal.y == 1) point.position.y = g.height;
  return point;
}

float ground_opacity(const Ground& g, const Vec3& position) {
  return g.kind == GroundKind::floor ? 1 - smooth_step(g.fade_from, g.fade_to, level_distance(g, position)) : 1;
}

float openness(const Ground& g, const Vec3& position) {
  return smooth_step(0.2f * g.radius, 0.9f * g.radius, level_distance(g, position));
}

Color upward_irradiance(const Environment& e) {
  constexpr double pi_d = std::numbers::pi;
  Vec3d sum(0);
  for (int y = 0; 2 * y < e.height; ++y) {
    // Of cosine over a row: half the difference of squared sines, down to the horizon.
    const double from = std::sin(pi_d * y / e.height), to = std::sin(std::min(pi_d * (y + 1) / e.height, pi_d / 2));
    const double weight = (to * to - from * from) / 2 * (2 * pi_d / e.width);
    for (int x = 0; x < e.width; ++x)
      sum += Vec3d(e.radiance_at(x, y)) * weight;
  }
  return Color(Vec3(sum));
}

}  // namespace sateen
