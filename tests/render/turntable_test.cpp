#include "render/turntable.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "render/exposure.h"

namespace sateen {

namespace {
// A small map whose texels all differ.
Environment numbered_map() {
  Image map(16, 8, 3);
  for (size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = 1 + float(i);
  return build_environment(map);
}

Scene swatch_scene() {
  Scene scene;
  scene.mesh = std::make_unique<Mesh>(subdivide(built_in_shape("swatch"), 0));
  scene.environment = numbered_map();
  scene.camera = frame_points(scene.mesh->positions, CameraSettings(), 160, 90);
  return scene;
}

Vec2 seen_at(const Camera& camera, const Vec3& p) {
  const Vec3 d = p - camera.position;
  const float z = dot(d, camera.forward);
  return Vec2(dot(d, camera.right) / z / camera.tan_x, dot(d, camera.up) / z / camera.tan_y);
}

Vec3 rotated(const Vec3& p, const Vec3& pivot, double degrees) {
  const double a = degrees * double(pi) / 180, x = double(p.x - pivot.x), z = double(p.z - pivot.z);
  return pivot +
         Vec3(float(x * std::cos(a) + z * std::sin(a)), p.y - pivot.y, float(z * std::cos(a) - x * std::sin(a)));
}
}  // namespace

TEST(TurntablePose, ATurningObjectLooksAsIfItsPointsHadTurned) {
  Scene scene = swatch_scene();
  const TurntableStart start = start_turntable(scene, CameraSettings(), Turn::object);
  for (const double angle : {30.0, 90.0, 200.0}) {
    pose_turntable(scene, start, angle);
    for (size_t i = 0; i < scene.mesh->positions.size(); i += 37) {
      const Vec3 p = scene.mesh->positions[i];
      const Vec2 a = seen_at(scene.camera, p), b = seen_at(start.camera, rotated(p, start.pivot, angle));
      EXPECT_NEAR(a.x, b.x, 1e-4f);
      EXPECT_NEAR(a.y, b.y, 1e-4f);
    }
  }
}

TEST(TurntablePose, TheLightStaysWithTheCameraWhileTheObjectTurns) {
  Scene scene = swatch_scene();
  const TurntableStart start = start_turntable(scene, CameraSettings(), Turn::object);
  const auto light_ahead = [&] {
    return environment_radiance(scene.environment, scene.camera.forward + scene.camera.right * 0.3f);
  };
  pose_turntable(scene, start, 0);
  const Color first = light_ahead();
  for (const double angle : {45.0, 101.0, 260.0}) {
    pose_turntable(scene, start, angle);
    EXPECT_EQ(light_ahead(), first) << angle;
  }
}

TEST(TurntablePose, ACameraThatWalksLeavesTheLightAndATurningLightLeavesTheCamera) {
  Scene scene = swatch_scene();
  const Vec3 place = scene.camera.position;
  pose_turntable(scene, start_turntable(scene, CameraSettings(), Turn::camera), 90);
  EXPECT_EQ(scene.environment.rotation_turns, 0);
  EXPECT_GT(scene.camera.position.x, 0.5f * length(place));
  scene = swatch_scene();
  pose_turntable(scene, start_turntable(scene, CameraSettings(), Turn::light), 90);
  EXPECT_EQ(scene.camera.position, place);
  EXPECT_DOUBLE_EQ(scene.environment.rotation_turns, 0.25);
}

TEST(TurntablePose, AFrameKnowsNothingOfWhereTheWallStoodInOthers) {
  const auto stage = [](TurntableStart& start) {
    Scene scene;
    scene.mesh = std::make_shared<const Mesh>(subdivide(built_in_shape("sphere"), 2));
    scene.rays = std::make_shared<const RayTracer>(*scene.mesh, 1);
    scene.environment = numbered_map();
    scene.camera = frame_points(scene.mesh->positions, CameraSettings(), 160, 90);
    start = start_turntable(scene, CameraSettings(), Turn::camera);
    StageSettings settings;
    settings.ground.emplace().kind = GroundKind::cyclorama;
    set_turning_stage(scene, start, settings);
    return scene;
  };
  const auto open_at = [](const Scene& scene, std::vector<OpenDirections>& rows) {
    for (size_t quad = 0; quad < scene.mesh->quads.size(); quad += 5) {
      const SurfacePoint point = surface_point(*scene.mesh, {0, std::uint32_t(quad), 0.3f, 0.3f});
      if (const OpenDirections* open = scene.openness->find(scene, point.position, point.geometric_normal))
        rows.push_back(*open);
    }
  };
  TurntableStart start, other_start;
  Scene scene = stage(start), other = stage(other_start);
  std::vector<OpenDirections> before, after, alone;
  pose_turntable(scene, start, 0);
  open_at(scene, before);
  pose_turntable(scene, start, 90);
  open_at(scene, after);
  pose_turntable(other, other_start, 90);
  open_at(other, alone);
  ASSERT_GT(alone.size(), 50u);
  ASSERT_EQ(after.size(), alone.size());
  size_t moved = 0;
  for (size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(after[i].halves, alone[i].halves) << i;
    moved += before[i].halves != after[i].halves;
  }
  EXPECT_GT(moved, 0u) << "the wall takes part in what is open";
}

TEST(TurntablePose, TheMeshStaysInsideThePictureAtEveryAngleAndDistanceIsConstant) {
  Scene scene = swatch_scene();
  const TurntableStart start = start_turntable(scene, CameraSettings(), Turn::object);
  const float distance = length(start.camera.position - start.pivot);
  for (int angle = 0; angle < 360; angle += 7) {
    pose_turntable(scene, start, angle);
    EXPECT_NEAR(length(scene.camera.position - start.pivot), distance, 1e-4f * distance);
    for (const Vec3& p : scene.mesh->positions) {
      const Vec2 at = seen_at(scene.camera, p);
      ASSERT_LT(std::max(std::abs(at.x), std::abs(at.y)), 1.0f) << angle;
    }
  }
}

TEST(Exposure, AMeterHeldTowardsTheCameraFollowsItAroundTheLight) {
  // Lit from the right (+X) alone: a camera there sees more light than one on the other side.
  Image map(64, 32, 3);
  for (float& v : map.pixels) v = 0.02f;
  for (int y = 0; y < 32; ++y)
    for (int x = 44; x < 52; ++x)
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = 10;
  Environment environment = build_environment(map);
  EXPECT_LT(metered_towards(environment, 90, 0), metered_towards(environment, 0, 0) - 0.5f);
  EXPECT_GT(metered_towards(environment, -90, 0), metered_towards(environment, 0, 0));
  EXPECT_EQ(environment.rotation_turns, 0);
  EXPECT_FLOAT_EQ(metered_towards(environment, 90, 1.5f), metered_towards(environment, 90, 0) + 1.5f);
}

}  // namespace sateen
