#include "sampling/disk.h"

#include <gtest/gtest.h>

namespace sateen_test {
namespace {

using namespace sateen;

constexpr int n = 400;  // midpoints a side

// Moments of the uniform disk: mean 0, mean of x^2 and of y^2 1/4, of r^4 1/3.
TEST(ConcentricDisk, IsUniform) {
  double x = 0, y = 0, xx = 0, yy = 0, r4 = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec2 d = concentric_disk({(i + 0.5) / n, (j + 0.5) / n});
      const double r2 = double(d.x * d.x + d.y * d.y);
      ASSERT_LE(r2, 1 + 1e-6);
      x += d.x, y += d.y, xx += d.x * d.x, yy += d.y * d.y, r4 += r2 * r2;
    }
  EXPECT_NEAR(x / n / n, 0, 1e-5);
  EXPECT_NEAR(y / n / n, 0, 1e-5);
  EXPECT_NEAR(xx / n / n, 0.25, 1e-4);
  EXPECT_NEAR(yy / n / n, 0.25, 1e-4);
  EXPECT_NEAR(r4 / n / n, 1.0 / 3, 1e-4);
}

// Of a regular polygon with k corners on the unit circle the mean of r^2 is (2 + cos(2 pi / k)) / 6.
TEST(RegularPolygon, IsUniform) {
  for (const int corners : {3, 5, 8}) {
    double x = 0, y = 0, rr = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Vec2 d = regular_polygon(corners, {(i + 0.5) / n, (j + 0.5) / n});
        x += d.x, y += d.y, rr += d.x * d.x + d.y * d.y;
      }
    EXPECT_NEAR(x / n / n, 0, 1e-4);
    EXPECT_NEAR(y / n / n, 0, 1e-4);
    EXPECT_NEAR(rr / n / n, (2 + std::cos(2 * M_PI / corners)) / 6, 1e-4) << corners;
  }
}

TEST(CosineDirection, HasTheDensityOfItsCosine) {
  double z = 0, zz = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3 d = cosine_direction({(i + 0.5) / n, (j + 0.5) / n});
      EXPECT_NEAR(length(d), 1, 1e-5);
      z += d.z, zz += d.z * d.z;
    }
  EXPECT_NEAR(z / n / n, 2.0 / 3, 1e-3);  // of z with density 2 z
  EXPECT_NEAR(zz / n / n, 0.5, 1e-3);
}

}  // namespace
}  // namespace sateen_test
