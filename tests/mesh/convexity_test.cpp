#include "mesh/convexity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/shapes.h"
#include "mesh/subdivide.h"

using namespace sateen;

namespace {

/// A closed box of quads with a seam: no vertex is shared between faces.
Mesh box(const Vec3& size) {
  Mesh mesh;
  const auto face = [&](const Vec3& middle, const Vec3& a, const Vec3& b) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (const auto& [s, t] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
      mesh.positions.push_back(middle + a * s + b * t);
    mesh.quads.push_back({first, first + 1, first + 2, first + 3});
  };
  const Vec3 x(size.x, 0, 0), y(0, size.y, 0), z(0, 0, size.z);
  face(x, y, z);
  face(-x, z, y);
  face(y, z, x);
  face(-y, x, z);
  face(z, x, y);
  face(-z, y, x);
  mesh.bounds_min = -size;
  mesh.bounds_max = size;
  return mesh;
}

}  // namespace

TEST(MeshForm, AParallelogramIsFlatWhereverItLies) {
  Mesh mesh;
  mesh.positions = {{1e4f, 1, 2}, {1e4f + 3, 2, 2}, {1e4f + 4, 4, 5}, {1e4f + 1, 3, 5}};
  mesh.quads = {{0, 1, 2, 3}};
  mesh.bounds_min = {1e4f, 1, 2};
  mesh.bounds_max = {1e4f + 4, 4, 5};
  EXPECT_EQ(mesh_form(mesh), MeshForm::flat);
  mesh.positions[2].y += 0.01f;
  EXPECT_EQ(mesh_form(mesh), MeshForm::folded) << "an open sheet that bends sees itself from one side";
}

TEST(MeshForm, ABoxIsConvexAcrossItsSeams) {
  EXPECT_EQ(mesh_form(box({1, 2, 3})), MeshForm::convex);
  EXPECT_EQ(mesh_form(box({1e-2f, 1e2f, 1})), MeshForm::convex);
}

TEST(MeshForm, ABoxWithoutALidIsNot) {
  Mesh open = box({1, 1, 1});
  open.quads.pop_back();
  EXPECT_EQ(mesh_form(open), MeshForm::folded);
}

TEST(MeshForm, ABoxInsideOutIsNot) {
  Mesh inside = box({1, 1, 1});
  for (auto& quad : inside.quads) std::swap(quad[1], quad[3]);
  EXPECT_EQ(mesh_form(inside), MeshForm::folded);
}

TEST(MeshForm, TwoBoxesAreNot) {
  Mesh two = box({1, 1, 1});
  const Mesh other = box({1, 1, 1});
  const auto first = std::uint32_t(two.positions.size());
  for (const Vec3& p : other.positions) two.positions.push_back(p + Vec3(5, 0, 0));
  for (auto quad : other.quads) {
    for (std::uint32_t& corner : quad) corner += first;
    two.quads.push_back(quad);
  }
  two.bounds_max.x = 6;
  EXPECT_EQ(mesh_form(two), MeshForm::folded);
}

TEST(MeshForm, TheLimitSphereIsConvexAtEveryLevelAndADentIsFound) {
  for (const int level : {0, 2, 4}) {
    Mesh sphere = subdivide(built_in_shape("sphere"), level);
    EXPECT_EQ(mesh_form(sphere), MeshForm::convex) << "level " << level;
    // One vertex, pushed in by a thousandth of the size; split vertices move together.
    const Vec3 from = sphere.positions[sphere.positions.size() / 2];
    const Vec3 middle = (sphere.bounds_min + sphere.bounds_max) * 0.5f;
    for (Vec3& p : sphere.positions)
      if (p == from) p = middle + (p - middle) * 0.8f;
    EXPECT_EQ(mesh_form(sphere), MeshForm::folded) << "level " << level;
  }
}

TEST(MeshForm, AQuadThatIsTwistedIntoAValleyIsNotTakenForAConvexOne) {
  // Its corners are as far off its own plane as the valley between its two triangles is deep: nothing rises above it.
  Mesh mesh = box({1, 1, 1});
  const Vec3 corner = mesh.positions[mesh.quads[4][1]];
  for (Vec3& p : mesh.positions)
    if (p == corner) p.z -= 0.8f;
  EXPECT_EQ(mesh_form(mesh), MeshForm::folded);
}

TEST(MeshForm, ClothIsFolded) {
  for (const char* shape : {"drape", "skirt", "swatch"})
    EXPECT_EQ(mesh_form(subdivide(built_in_shape(shape), 1)), MeshForm::folded) << shape;
}

TEST(MeshForm, ATorusIsNotConvexThoughItIsClosed) {
  Mesh torus;
  constexpr int n = 24, m = 12;
  constexpr float tau = 2 * std::numbers::pi_v<float>;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const float a = tau * float(i) / n, b = tau * float(j) / m, r = 2 + 0.5f * std::cos(b);
      torus.positions.push_back({r * std::cos(a), 0.5f * std::sin(b), -r * std::sin(a)});
      const auto at = [](int p, int q) { return std::uint32_t(p % n * m + q % m); };
      torus.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  torus.bounds_min = {-2.5f, -0.5f, -2.5f};
  torus.bounds_max = {2.5f, 0.5f, 2.5f};
  EXPECT_EQ(mesh_form(torus), MeshForm::folded);
}
