// The torture meshes: each must come out as a sound mesh or as an error with a text, at every level.
#include <gtest/gtest.h>

#include "base/error.h"
#include "mesh/mesh_checks.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"
#include "mesh/torture_meshes.h"

namespace sateen {
namespace {

using namespace torture;

TEST(TortureMeshes, ComeOutSoundAtEveryLevel) {
  for (const Case& c : cases()) {
    const ControlMesh cage = parse_obj(c.text, "torture.obj");
    for (int level = 0; level <= 3; ++level) {
      if (level > 0 && cage.position_indices.size() > 500 && level != 2) continue;
      SCOPED_TRACE(fmt::format("{}, level {}", c.name, level));
      const Mesh mesh = subdivide(cage, level);
      expect_sound(mesh);
      const bool unrefined = !mesh.warnings.empty() && mesh.warnings.back().find("unrefined") != std::string::npos;
      if (c.refused_by_opensubdiv) {
        EXPECT_TRUE(unrefined);
      }
    }
  }
}

TEST(TortureMeshes, LoopOfAnythingButTrianglesIsRenderedFromItsCageWithAWarning) {
  ControlMesh cage = parse_obj(cube, "cube");
  cage.scheme = ControlMesh::Scheme::loop;
  const Mesh mesh = subdivide(cage, 2);
  expect_sound(mesh);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_NE(mesh.warnings[0].find("cube: OpenSubdiv refuses this mesh, rendered unrefined from its cage: "),
            std::string::npos)
      << mesh.warnings[0];
  EXPECT_EQ(mesh.quads.size(), 6u);
}

TEST(TortureMeshes, WhatIsNoSurfaceIsCutIntoSurfacesThatOpenSubdivTakes) {
  const int meshes = std::getenv("SATEEN_LONG_TESTS") ? 20'000 : 300;
  for (int i = 0; i < meshes; ++i) {
    SCOPED_TRACE(i);
    ControlMesh cage = parse_obj(random_mesh(std::uint32_t(i)), "random.obj");
    const bool triangles = std::all_of(cage.face_sizes.begin(), cage.face_sizes.end(), [](int n) { return n == 3; });
    cage.scheme = i % 7 == 3                ? ControlMesh::Scheme::bilinear
                  : triangles && i % 2 == 0 ? ControlMesh::Scheme::loop
                                            : ControlMesh::Scheme::catmull_clark;
    const Mesh mesh = subdivide(cage, i % 4);
    expect_sound(mesh);
    if (HasFatalFailure()) return;
    // Nothing is left to its cage but what has no limit surface at all.
    if (mesh.refined) continue;
    EXPECT_NE(mesh.warnings.back().find("no face has a limit surface"), std::string::npos) << mesh.warnings.back();
  }
}

TEST(TortureMeshes, EverySchemeTakesEveryCage) {
  for (const Case& c : cases())
    for (const ControlMesh::Scheme scheme : {ControlMesh::Scheme::loop, ControlMesh::Scheme::bilinear}) {
      SCOPED_TRACE(c.name);
      ControlMesh cage = parse_obj(c.text, "torture.obj");
      cage.scheme = scheme;
      expect_sound(subdivide(cage, 1));
    }
}

TEST(TortureMeshes, SizeAndDistanceFromTheOriginDoNotChangeTheShape) {
  const Mesh unit = subdivide(parse_obj(sheet(1, 0, plain), "unit"), 2);
  for (const double scale : {1e-30, 1e-6, 1e6, 1e14}) {
    const Mesh other = subdivide(parse_obj(sheet(scale, 0, plain), "other"), 2);
    for (size_t i = 0; i < unit.positions.size(); ++i) {
      EXPECT_NEAR((other.normals[i] - unit.normals[i]).length(), 0, 1e-5);
      EXPECT_NEAR((other.dpdu[i] / float(scale) - unit.dpdu[i]).length(), 0, 1e-4);
    }
  }
  // 1e3 sizes away a float still holds 1/16,000 of the shape.
  const Mesh away = subdivide(parse_obj(sheet(1, 1000, plain), "away"), 2);
  for (size_t i = 0; i < unit.positions.size(); ++i)
    EXPECT_NEAR((away.normals[i] - unit.normals[i]).length(), 0, 2e-3);
}

TEST(TortureMeshes, AFullPoleIsSmooth) {
  const Mesh mesh = subdivide(parse_obj(pole(360), "pole"), 2);
  size_t apex = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].z > mesh.positions[apex].z) apex = i;
  EXPECT_NEAR(mesh.normals[apex].z, 1, 1e-4);
}

TEST(TortureMeshes, TenMillionTrianglesWork) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "takes 4 GB and a minute; set SATEEN_LONG_TESTS";
  const auto wave = [](float x, float y) { return Vec3(x, y, std::sin(x) * std::cos(y)); };
  const auto chart = [](float x, float y) { return Vec2(x, y); };
  for (const auto& [cells, level] : {std::pair(560, 2), std::pair(2240, 0)}) {
    const Mesh mesh = subdivide(grid_cage(cells, cells, wave, chart), level);
    EXPECT_GE(mesh.triangles(), 10'000'000);
    expect_sound(mesh);
  }
}

}  // namespace
}  // namespace sateen
