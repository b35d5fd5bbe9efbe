#include "scene/openness.h"

#include <gtest/gtest.h>

#include <thread>

#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "scene/scene.h"

namespace sateen {
namespace {

Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  scene.rays = std::make_shared<const RayTracer>(*scene.mesh, 1);
  renew_openness(scene);
  return scene;
}

Mesh built_in(const char* name, int level) {
  return subdivide(built_in_shape(name), level, 1);
}

/// A square floor of 2 x 2 with four walls that lean against nothing, `height` high, in fine quads.
Mesh well(float height) {
  Mesh mesh;
  const auto sheet = [&](Vec3 corner, Vec3 along, Vec3 across) {
    constexpr int n = 16;
    const auto first = std::uint32_t(mesh.positions.size());
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        mesh.positions.push_back(corner + along * (float(i) / n) + across * (float(j) / n));
        mesh.normals.push_back(normalize(cross(along, across)));
        mesh.dpdu.push_back(along);
        mesh.dpdv.push_back(across);
        mesh.uvs.push_back(Vec2(float(i) / n, float(j) / n));
      }
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t at = first + j * (n + 1) + i;
        mesh.quads.push_back({at, at + 1, at + n + 2, at + n + 1});
      }
  };
  sheet({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});  // looks up
  const Vec3 up(0, height, 0);
  sheet({-1, 0, -1}, {2, 0, 0}, up);
  sheet({-1, 0, 1}, {2, 0, 0}, up);
  sheet({-1, 0, -1}, {0, 0, 2}, up);
  sheet({1, 0, -1}, {0, 0, 2}, up);
  mesh.bounds_min = Vec3(-1, 0, -1);
  mesh.bounds_max = Vec3(1, height, 1);
  return mesh;
}

TEST(Openness, TheOutsideOfASphereIsOpen) {
  const Scene scene = scene_of(built_in("sphere", 3));
  const Vec3 middle = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  int known = 0;
  for (size_t v = 0; v < scene.mesh->positions.size(); v += 97) {
    const Vec3 out = normalize(scene.mesh->positions[v] - middle);
    const OpenDirections* outside = scene.openness->find(scene, scene.mesh->positions[v], out);
    const OpenDirections* inside = scene.openness->find(scene, scene.mesh->positions[v], -out);
    if (!outside || !inside) continue;
    ++known;
    EXPECT_EQ(outside->at(out), 1) << v;
    EXPECT_EQ(inside->at(-out), 0) << v;
  }
  EXPECT_GT(known, 20);
}

TEST(Openness, TheFloorOfAWellSeesTheSkyAbove) {
  const Scene scene = scene_of(well(4));
  const OpenDirections* floor = scene.openness->find(scene, Vec3(0.03f, 0, 0.03f), Vec3(0, 1, 0));
  ASSERT_TRUE(floor);
  EXPECT_EQ(floor->at({0, 1, 0.01f}), 1);
  for (const Vec3& level : {Vec3(1, 0.2f, 0.3f), Vec3(-1, 0.2f, 0.3f), Vec3(0.2f, 0.1f, -1)})
    EXPECT_EQ(floor->at(level), 0);
  EXPECT_FALSE(scene.openness->find(scene, Vec3(30, 30, 30), Vec3(0, 1, 0)));
}

TEST(Openness, TheGroundClosesWhatLiesBelow) {
  Scene scene = scene_of(built_in("sphere", 3));
  const Vec3 side((scene.mesh->bounds_max.x), 0, 0), away(1, 0, 0), down(1, -1, 0);
  const Vec3 place(side.x, (scene.mesh->bounds_min.y + scene.mesh->bounds_max.y) / 2, 0);
  const OpenDirections* free = scene.openness->find(scene, place, away);
  ASSERT_TRUE(free);
  EXPECT_EQ(free->at(down), 1);
  Ground ground;
  ground.height = scene.mesh->bounds_min.y;
  scene.ground = ground;
  EXPECT_EQ(scene.openness->find(scene, place, away)->at(down), 1) << "was traced before";
  renew_openness(scene);
  EXPECT_EQ(scene.openness->find(scene, place, away)->at(down), 0);
  EXPECT_EQ(scene.openness->find(scene, place, away)->at({1, 1, 0}), 1);
}

TEST(Openness, DoesNotDependOnWhoAsksFirst) {
  const Scene one = scene_of(built_in("drape", 0)), other = scene_of(built_in("drape", 0));
  const auto look = [](const Scene& scene, size_t quad, float side, std::vector<OpenDirections>& out) {
    const SurfacePoint point = surface_point(*scene.mesh, {0, std::uint32_t(quad), 0.3f, 0.3f});
    const OpenDirections* open = scene.openness->find(scene, point.position, point.geometric_normal * side);
    out.push_back(open ? *open : OpenDirections{});
  };
  const size_t quads = one.mesh->quads.size();
  std::vector<OpenDirections> forward, backward;
  for (size_t i = 0; i < quads; i += 7) look(one, i, 1, forward);
  {
    // Two at once, from both ends.
    std::vector<OpenDirections> dropped;
    std::thread helper([&] {
      for (size_t i = 0; i < quads; i += 7) look(other, i, 1, dropped);
    });
    for (size_t i = (quads - 1) / 7 * 7 + 7; i >= 7; i -= 7) look(other, i - 7, 1, backward);
    helper.join();
  }
  ASSERT_EQ(forward.size(), backward.size());
  for (size_t i = 0; i < forward.size(); ++i) EXPECT_EQ(forward[i].halves, backward[forward.size() - 1 - i].halves);
}

TEST(Openness, OddMeshesHaveAGuideOrNone) {
  Mesh empty;
  EXPECT_FALSE(scene_of(empty).openness->find(scene_of(empty), Vec3(0), Vec3(0, 1, 0)));
  Mesh flat = well(4);
  for (Vec3& p : flat.positions) p = Vec3(0);  // no area at all
  const Scene scene = scene_of(flat);
  EXPECT_FALSE(scene.openness->find(scene, Vec3(0), Vec3(0, 1, 0)));
  for (const float scale : {1e-12f, 1e10f}) {
    Mesh mesh = well(4);
    for (Vec3& p : mesh.positions) p *= scale;
    mesh.bounds_min *= scale;
    mesh.bounds_max *= scale;
    const Scene odd = scene_of(mesh);
    const OpenDirections* floor = odd.openness->find(odd, Vec3(0.03f, 0, 0.03f) * scale, Vec3(0, 1, 0));
    ASSERT_TRUE(floor) << scale;
    EXPECT_EQ(floor->at({0, 1, 0.01f}), 1) << scale;
    EXPECT_EQ(floor->at({1, 0.2f, 0.3f}), 0) << scale;
  }
}

}  // namespace
}  // namespace sateen
