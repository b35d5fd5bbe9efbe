#include "scene/near_weave.h"

#include <gtest/gtest.h>

#include <random>

#include "look/read.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "scene/footprint.h"

namespace sateen {
namespace {

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
      place_yarn(scene, camera_footprint(scene.camera, ray, point.surface), point);
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
