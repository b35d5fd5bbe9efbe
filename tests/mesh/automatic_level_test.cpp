#include <gtest/gtest.h>

#include "mesh/mesh_checks.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

Vec2 plain(float x, float y) { return Vec2(x, y); }
Vec3 flat(float x, float y) { return Vec3(x, y, 0); }

TEST(AutomaticLevel, HalvesTheLongestEdgeUntilItIsBelowTwoPixels) {
  const ControlMesh cage = grid_cage(4, 4, flat, plain);
  const auto level = [&](float pixel) { return automatic_level(cage, [&](const Vec3&) { return pixel; }); };
  EXPECT_EQ(level(1.0f), 0);
  EXPECT_EQ(level(0.5f), 0);
  EXPECT_EQ(level(0.49f), 1);
  EXPECT_EQ(level(0.1f), 3);
  EXPECT_EQ(level(1e-6f), 6);
  EXPECT_EQ(level(0), 0) << "behind the camera";
  EXPECT_EQ(level(NAN), 0);
  EXPECT_EQ(automatic_level(
                cage, [](const Vec3&) { return 1e-6f; }, 2, 300),
            2)
      << "4 * 4 * 16 quads fit, 1024 do not";
  EXPECT_EQ(automatic_level(cage, [](const Vec3& p) { return p.x < 1 ? 0.1f : 9.0f; }), 3)
      << "the nearest part decides";
}

}  // namespace
}  // namespace sateen
