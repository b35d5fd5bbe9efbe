#include "scene/near_weave.h"

#include <gtest/gtest.h>

#include <random>

#include "look/read.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "scene/footprint.h"

namespace sateen {
namespace {

SurfacePoint plane_point(const Vec3& position, const Vec3& dpdu, const Vec3& dpdv) {
  SurfacePoint point;
  point.position = position;
  point.dpdu = dpdu;
  point.dpdv = dpdv;
  point.normal = point.geometric_normal = normalize(cross(dpdu, dpdv));
  return point;
}

TEST(Footprint, IsWhatNeighbouringRaysFindOnThePlane) {
  std::mt19937 random(4);
  const auto r = [&] { return float(random() % 20001) / 10000 - 1; };
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    CameraSettings settings;
    settings.azimuth_deg = 180 * r();
    settings.elevation_deg = 80 * r();
    const Camera camera = frame_points({Vec3(-1), Vec3(1)}, settings, 640, 360);
    const SurfacePoint point =
        plane_point(Vec3(r(), r(), r()) * 0.3f, Vec3(2 + r(), r(), r()), Vec3(r(), 1 + 0.3f * r(), r()));
    // The pixel where the point is seen, and its neighbours a hundredth of a pixel away.
    const Vec3 to = point.position - camera.position;
    const float depth = dot(to, camera.forward);
    const Vec3 direction = to / depth;
    if (std::abs(dot(direction, point.normal)) < 0.1f) continue;
    const Footprint found = camera_footprint(camera, direction, point, point.normal);
    constexpr double share = 0.01;
    for (const bool along_x : {true, false}) {
      const Vec3 axis = along_x ? camera.right * (2 * camera.tan_x / float(camera.width))
                                : camera.up * (-2 * camera.tan_y / float(camera.height));
      const Vec3d d0(direction), d = d0 + Vec3d(axis) * share, n(point.normal);
      const double distance = Vec3d(to).dot(n);
      const Vec3d moved = d * (distance / d.dot(n)) - d0 * (distance / d0.dot(n));
      const Vec2 uv = along_x ? found.x : found.y;
      const Vec3d told = (Vec3d(point.dpdu) * double(uv.x) + Vec3d(point.dpdv) * double(uv.y)) * share;
      EXPECT_NEAR((told - moved).length() / moved.length(), 0, 1e-3);
    }
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

TEST(Footprint, StaysFiniteAtTheHorizonAndWithoutAPlane) {
  const Camera camera = frame_points({Vec3(-1), Vec3(1)}, {}, 64, 36);
  const SurfacePoint edge = plane_point(Vec3(0), camera.forward, camera.right);
  const Footprint at_horizon = camera_footprint(camera, camera.forward, edge, edge.normal);
  for (const Vec2& v : {at_horizon.x, at_horizon.y}) EXPECT_TRUE(std::isfinite(v.x) && std::isfinite(v.y));
  EXPECT_GT(length(Vec3(at_horizon.y.x, at_horizon.y.y, 0)), 100.0f);
  SurfacePoint line = edge;
  line.dpdv = line.dpdu;
  EXPECT_EQ(camera_footprint(camera, camera.forward, line, edge.normal).x.x, 1e30f);
}

TEST(NearShare, GrowsFromNothingToAllWithoutAStep) {
  EXPECT_EQ(near_share(0), 0);
  EXPECT_EQ(near_share(1), 0);
  EXPECT_EQ(near_share(3), 1);
  EXPECT_EQ(near_share(1e6f), 1);
  float before = 0;
  for (float pixels = 0.9f; pixels < 4; pixels += 0.01f) {
    const float now = near_share(pixels);
    EXPECT_GE(now, before);
    EXPECT_LT(now - before, 0.03f);
    before = now;
  }
}

Scene woven_scene(const std::string& look, float zoom) {
  Scene scene;
  scene.mesh = std::make_unique<const Mesh>(subdivide(built_in_shape("drape"), 0, 2));
  scene.rays = std::make_unique<const RayTracer>(*scene.mesh, 2);
  FabricParts parts;
  parts.table = false;
  scene.front = compile_fabric(read_look(SATEEN_SOURCE_DIR "/looks/" + look + ".json"), same_space, parts);
  CameraSettings settings;
  settings.zoom = zoom;
  scene.camera = frame_points(scene.mesh->positions, settings, 960, 540);
  scene.metres_per_uv = scene.mesh->metres_per_uv;
  scene.near_weave_pixel = near_weave_pixel(scene);
  return scene;
}

/// Hits of a grid of rays: how many show a yarn, and how many the depth alone had ruled out although they do.
struct Shown {
  int hits = 0, near = 0, missed = 0;
};
Shown look_at(const Scene& scene) {
  Shown shown;
  for (int y = 4; y < 540; y += 9)
    for (int x = 4; x < 960; x += 9) {
      const Ray ray = scene.camera.ray(float(x) + 0.5f, float(y) + 0.5f);
      const std::optional<Hit> hit = scene.rays->closest_hit(ray);
      if (!hit) continue;
      ClothPoint point = cloth_point(scene, *hit, ray.direction);
      place_yarn(scene, ray.direction, point);
      ++shown.hits;
      shown.near += point.yarn.near > 0;
      shown.missed += point.yarn.near > 0 && !may_show_yarns(scene, hit->t);
    }
  return shown;
}

TEST(NearWeave, ShowsNoThreadsInThePictureOfTheWholeDrape) {
  for (const char* look : {"champagne_silk_satin", "linen_plain", "natural_linen"}) {
    const Shown shown = look_at(woven_scene(look, 1));
    EXPECT_GT(shown.hits, 1000);
    EXPECT_EQ(shown.near, 0) << look;
  }
}

TEST(NearWeave, IsNeverRuledOutByTheDepthAloneWhereItShows) {
  for (const float zoom : {3.0f, 10.0f, 40.0f, 150.0f}) {
    const Shown shown = look_at(woven_scene("natural_linen", zoom));
    EXPECT_EQ(shown.missed, 0) << zoom;
    if (zoom > 30) {
      EXPECT_GT(shown.near, 1000) << zoom;
    }
  }
}

TEST(NearWeave, IsAbsentWithoutADraft) {
  EXPECT_EQ(woven_scene("velvet", 100).near_weave_pixel, 0);
  EXPECT_EQ(look_at(woven_scene("velvet", 100)).near, 0);
}

}  // namespace
}  // namespace sateen
