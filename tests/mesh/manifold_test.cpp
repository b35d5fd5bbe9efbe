#include "mesh/manifold.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>

#include "base/error.h"
#include "mesh/mesh_checks.h"
#include "mesh/obj.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "mesh/torture_meshes.h"

namespace sateen {
namespace {

/// A book of bent pages along a spine of `knots` vertices, two faces deep.
std::string book(int pages, int knots) {
  std::string text, faces;
  for (int k = 0; k < knots; ++k) text += fmt::format("v {} {} 0\n", 0.2 * k * k, k);
  for (int p = 0; p < pages; ++p) {
    const double a = 2 * std::numbers::pi * p / pages;
    for (int ring = 1; ring <= 2; ++ring)
      for (int k = 0; k < knots; ++k)
        text += fmt::format("v {} {} {}\n", 0.2 * k * k + ring * std::cos(a), k, ring * std::sin(a));
    for (int ring = 0; ring < 2; ++ring)
      for (int k = 0; k + 1 < knots; ++k) {
        const int far = knots * (1 + 2 * p + ring) + k + 1, near = ring == 0 ? k + 1 : far - knots;
        faces += fmt::format("f {} {} {} {}\n", near, far, far + 1, near + 1);
      }
  }
  return text + faces;
}

TEST(Manifolds, SurfacesAreLeftAlone) {
  for (const std::string& shape : built_in_shapes()) EXPECT_FALSE(cut_into_manifolds(built_in_shape(shape))) << shape;
  EXPECT_FALSE(cut_into_manifolds(parse_obj(torture::cube, "cube")));
  EXPECT_FALSE(cut_into_manifolds(parse_obj(torture::square + "f 1 2 3 4\nf 4 3 2 1\n", "pillow")));
}

TEST(Manifolds, EveryCutCageIsOne) {
  for (std::uint32_t i = 0; i < 500; ++i) {
    const ControlMesh cage = parse_obj(torture::random_mesh(i), "random");
    const std::optional<CutCage> cut = cut_into_manifolds(cage);
    if (!cut) continue;
    EXPECT_GT(cut->edges + cut->vertices, 0) << i;
    EXPECT_FALSE(cut_into_manifolds(cut->cage)) << i;
    ASSERT_EQ(cut->cage.face_sizes, cage.face_sizes) << i;
    for (size_t k = 0; k < cage.position_indices.size(); ++k)
      ASSERT_EQ(cut->origin[size_t(cut->cage.position_indices[k])], cage.position_indices[k]) << i;
  }
}

TEST(Manifolds, ABooksSpineStaysOneSmoothCurveWithoutACrack) {
  const ControlMesh cage = parse_obj(book(3, 5), "book");
  const std::optional<CutCage> cut = cut_into_manifolds(cage);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->edges, 4);
  EXPECT_EQ(cut->vertices, 5);
  const Mesh mesh = subdivide(cage, 2);
  expect_sound(mesh);
  // The cubic spline of the spine at its middle knot.
  const Vec3 a = cage.positions[1], b = cage.positions[2], c = cage.positions[3], knot = (a + b * 4 + c) / 6;
  std::map<std::array<float, 3>, int> met;
  int at_knot = 0;
  for (const Vec3& p : mesh.positions) {
    at_knot += (p - knot).length() < 1e-5f;
    if (std::abs(p.z) < 1e-6f) ++met[{p.x, p.y, p.z}];
  }
  EXPECT_EQ(at_knot, 3);
  // 4 edges of 4 pieces: all points of the spine are there three times, in the same bits.
  int threefold = 0;
  for (const auto& [position, count] : met) threefold += count == 3;
  EXPECT_EQ(threefold, 17);
}

TEST(Manifolds, NoCutLeavesACrack) {
  // A cage's vertices are a thousandth apart or in one place: what lies closer was cut, and must be in one place too.
  for (std::uint32_t i = 0; i < 60; ++i) {
    const ControlMesh cage = parse_obj(i == 0 ? torture::fan(50, 7) : torture::random_mesh(i), "random");
    if (!cut_into_manifolds(cage)) continue;
    const Mesh mesh = subdivide(cage, 1);
    const Vec3 size = mesh.bounds_max - mesh.bounds_min;
    const float close = 4e-7f * std::max({size.x, size.y, size.z});
    int cracks = 0;
    for (size_t a = 0; mesh.refined && a < mesh.positions.size(); ++a)
      for (size_t b = a + 1; b < mesh.positions.size(); ++b) {
        const float distance = (mesh.positions[a] - mesh.positions[b]).length();
        cracks += distance > 0 && distance < close;
      }
    EXPECT_EQ(cracks, 0) << i;
  }
}

TEST(Manifolds, WhatWasCutIsTold) {
  const Mesh mesh = subdivide(parse_obj(torture::fan(12, 3), "fan.obj"), 1);
  EXPECT_TRUE(mesh.refined);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_EQ(
      mesh.warnings[0],
      "fan.obj: 4 edges where more than two faces meet or two are turned against each other, and 4 vertices where "
      "several surfaces meet: each is smooth by itself and sharp there");
}

TEST(Manifolds, WithoutBorderInterpolationFacesAtTheBorderAreGone) {
  const std::string text = book(4, 6) + "t interpolateboundary 1/0/0 0\n";
  const Mesh mesh = subdivide(parse_obj(text, "book"), 1);
  EXPECT_TRUE(mesh.refined);
  // Of every page the inner faces that are not at the ends of the spine.
  EXPECT_EQ(mesh.quads.size(), size_t(4 * 3 * 4));
}

TEST(CheckCage, ArraysThatDoNotFitTogetherAreRefused) {
  const ControlMesh good = parse_obj(torture::square + "vt 0 0\nf 1/1 2/1 3/1 4/1\n", "a");
  const auto error = [&](const auto& spoil) -> std::string {
    ControlMesh bad = good;
    spoil(bad);
    try {
      subdivide(bad, 1);
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  };
  EXPECT_EQ(error([](ControlMesh&) {}), "no error");
  EXPECT_EQ(error([](ControlMesh& m) { m.position_indices[1] = 4; }),
            "error: a: vertex 4 does not exist, expected 0 to 3");
  EXPECT_EQ(error([](ControlMesh& m) { m.position_indices[1] = 0; }), "error: a: face 0 meets a vertex twice");
  EXPECT_EQ(error([](ControlMesh& m) { m.face_sizes[0] = 2; }),
            "error: a: face 0 has 2 corners, expected at least 3");
  EXPECT_EQ(error([](ControlMesh& m) { m.face_sizes[0] = 5; }),
            "error: a: face 0 has 5 corners, but the list of corners ends before");
  EXPECT_EQ(error([](ControlMesh& m) { m.face_sizes[0] = 3; }), "error: a: has 4 corners, but its faces use 3");
  EXPECT_EQ(error([](ControlMesh& m) { m.uv_indices[2] = 1; }),
            "error: a: texture coordinate 1 does not exist, expected 0 to 0");
  EXPECT_EQ(error([](ControlMesh& m) {
              m.creases.push_back({{0, -1}, 1});
            }),
            "error: a: vertex of a crease -1 does not exist, expected 0 to 3");
  EXPECT_EQ(error([](ControlMesh& m) {
              m.corners.push_back({0, NAN});
            }),
            "error: a: has a sharpness of nan, expected 0 to 10");
  EXPECT_EQ(error([](ControlMesh& m) { m.holes.push_back(1); }),
            "error: a: face of a hole 1 does not exist, expected 0 to 0");
  EXPECT_EQ(error([](ControlMesh& m) { m.positions[2].y = INFINITY; }),
            "error: a: vertex 2 is at (1, inf, 0), expected finite numbers");
}

}  // namespace
}  // namespace sateen
