#include "mesh/shapes.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "mesh/mesh_checks.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

TEST(Shapes, EachHasUvsInMetresNoWarningAndASoundSurface) {
  const std::vector<std::string> names = built_in_shapes();
  EXPECT_EQ(names, (std::vector<std::string>{"swatch", "sphere", "drape", "skirt"}));
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(is_built_in_shape(name));
    const ControlMesh cage = built_in_shape(name);
    EXPECT_EQ(cage.metres_per_uv, 1);
    for (const int size : cage.face_sizes) EXPECT_EQ(size, 4);
    for (int level = 0; level <= 2; ++level) {
      const Mesh mesh = subdivide(cage, level);
      expect_sound(mesh);
      EXPECT_EQ(mesh.fallback_warps, 0);
      EXPECT_TRUE(mesh.warnings.empty());
      EXPECT_GE(mesh.bounds_min.y, -1e-3f);
      EXPECT_EQ(mesh.name, name);
      EXPECT_EQ(mesh.metres_per_uv, 1);
    }
  }
}

TEST(Shapes, AnUnknownNameIsRefusedWithTheNearestOne) {
  EXPECT_FALSE(is_built_in_shape("skrit"));
  try {
    built_in_shape("skrit");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()), "error: no built-in shape is called skrit\n  help: did you mean skirt?");
  }
}

TEST(Sphere, ItsLimitSurfaceIsASphere) {
  const Mesh mesh = subdivide(built_in_shape("sphere"), 3);
  const Vec3 centre(0, 0.15f, 0);
  double worst = 0, turned = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i] - centre;
    worst = std::max(worst, std::abs(double(p.length()) / 0.15 - 1));
    turned = std::max(turned, double((mesh.normals[i] - p.normalized()).length()));
  }
  EXPECT_LT(worst, 0.002);
  EXPECT_LT(turned, 0.02);
}

TEST(Sphere, ItsPatternKeepsAreaAndItsWarpStandsUprightInFront) {
  const Mesh mesh = subdivide(built_in_shape("sphere"), 3);
  size_t front = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i].z > mesh.positions[front].z) front = i;
    EXPECT_NEAR(cross(mesh.dpdu[i], mesh.dpdv[i]).length(), 1, 0.12) << i;
    EXPECT_GT(dot(cross(mesh.dpdu[i], mesh.dpdv[i]), mesh.normals[i]), 0);
  }
  EXPECT_NEAR((mesh.dpdu[front].normalized() - Vec3(0, 1, 0)).length(), 0, 0.01);
}

TEST(Swatch, ItsThreadsKeepTheirLengthAndItsFoldsAreNotFlat) {
  const Mesh mesh = subdivide(built_in_shape("swatch"), 2);
  double sum_u = 0, sum_v = 0, worst = 0, slope = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double u = double(mesh.dpdu[i].length()) - 1, v = double(mesh.dpdv[i].length()) - 1;
    sum_u += std::abs(u);
    sum_v += std::abs(v);
    worst = std::max({worst, std::abs(u), std::abs(v)});
    slope = std::max(slope, 1 - double(mesh.normals[i].z));
    EXPECT_GT(mesh.normals[i].z, 0.3f) << "no fold hides behind another";
  }
  const double n = double(mesh.positions.size());
  EXPECT_LT(sum_u / n, 0.01);
  EXPECT_LT(sum_v / n, 0.02);
  EXPECT_LT(worst, 0.1);
  EXPECT_GT(slope, 0.15) << "some of it leans by more than 30 degrees";
  EXPECT_NEAR(mesh.bounds_max.y, 0.3f, 1e-3);
}

}  // namespace
}  // namespace sateen
