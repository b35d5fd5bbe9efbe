#include "scene/blurred_map.h"

#include <gtest/gtest.h>

#include <random>

#include "scene/maps.h"

namespace sateen_test {
namespace {

using namespace sateen;

Vec3 towards(double longitude, double elevation) {
  return {float(std::cos(elevation) * std::sin(longitude)), float(std::sin(elevation)),
          float(-std::cos(elevation) * std::cos(longitude))};
}

Environment noise(int width, int height) {
  std::mt19937 random(9);
  const auto r = [&] { return std::pow(float(random()) * 0x1p-32f, 8.0f); };
  return build_environment(make_map(width, height, [&](int, int) { return Color(r(), r(), r()); }));
}

TEST(BlurredMap, OfAConstantIsThatConstant) {
  const Environment map = build_environment(make_map(33, 17, [](int, int) { return Color(1, 2, 0.5f); }));
  for (const float width : {5.0f, 20.0f, 180.0f}) {
    const BlurredMap blurred = blur_environment(map, width);
    for (double a = -3; a < 3; a += 0.37)
      for (const double e : {-1.57, -0.8, 0.0, 0.3, 1.5, 1.5707}) {
        const Color c = blurred_radiance(blurred, map, towards(a, e));
        EXPECT_NEAR(c.x, 1, 1e-5);
        EXPECT_NEAR(c.y, 2, 1e-5);
      }
  }
}

TEST(BlurredMap, KeepsTheMeanRadiance) {
  const Environment map = noise(64, 32);
  for (const float width : {10.0f, 40.0f}) {
    const BlurredMap blurred = blur_environment(map, width);
    double sum = 0;
    for (int y = 0; y < blurred.radiance.height; ++y)
      for (int x = 0; x < blurred.radiance.width; ++x)
        sum += double(blurred.radiance.at(x, y)[0]) * environment_row_weight(y, blurred.radiance.height) / 2 /
               blurred.radiance.width;
    EXPECT_NEAR(sum, map.mean_radiance.x, 5e-3 * double(map.mean_radiance.x));
  }
}

TEST(BlurredMap, FallsToHalfAtHalfItsWidth) {
  // One lit texel of the grid that the map is averaged to, high up, in a turned map.
  Environment map =
      build_environment(make_map(120, 60, [](int x, int y) { return x == 66 && y == 16 ? Color(1000) : Color(0); }),
                        {radians(50), 0, "spot"});
  const double longitude = (66.5 / 120 - 0.5) * 2 * M_PI + 50 * M_PI / 180, elevation = M_PI / 2 - 16.5 / 60 * M_PI;
  const BlurredMap blurred = blur_environment(map, 24);
  const float peak = blurred_radiance(blurred, map, towards(longitude, elevation)).x;
  for (const double side : {-1.0, 1.0}) {
    const float half = blurred_radiance(blurred, map, towards(longitude, elevation + side * 12 * M_PI / 180)).x;
    EXPECT_NEAR(half / peak, 0.5, 0.02);
  }
}

TEST(BlurredMap, IsTheSameForAnyNumberOfThreads) {
  const Environment map = noise(50, 25);
  EXPECT_EQ(blur_environment(map, 30, 1).radiance.pixels, blur_environment(map, 30, 3).radiance.pixels);
}

}  // namespace
}  // namespace sateen_test
