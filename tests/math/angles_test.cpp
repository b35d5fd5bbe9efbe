#include "math/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace sateen {
namespace {

TEST(FastAtan2, StaysWithinItsStatedErrorAllAround) {
  for (int i = 0; i <= 400000; ++i) {
    const double a = (i / 200000.0 - 1) * std::numbers::pi, x = std::cos(a), y = std::sin(a);
    ASSERT_NEAR(fast_atan2(y, x), std::atan2(y, x), 4e-9) << a;
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-200, 200);
  for (int i = 0; i < 200000; ++i) {
    const double x = std::exp2(exponent(random)), y = (i % 2 ? 1 : -1) * std::exp2(exponent(random));
    ASSERT_NEAR(fast_atan2(y, x), std::atan2(y, x), 4e-9) << x << " " << y;
  }
}

TEST(FastAtan2, HasTheSignsOfTheStandardOne) {
  for (double y : {0.0, -0.0, 1.0, -1.0})
    for (double x : {0.0, -0.0, 1.0, -1.0}) {
      if (y == 0 && x == 0) {
        EXPECT_TRUE(std::isfinite(fast_atan2(y, x)));
        continue;
      }
      EXPECT_NEAR(fast_atan2(y, x), std::atan2(y, x), 4e-9) << y << " " << x;
      EXPECT_EQ(std::signbit(fast_atan2(y, x)), std::signbit(std::atan2(y, x)));
    }
  EXPECT_TRUE(std::isnan(fast_atan2(std::numeric_limits<double>::quiet_NaN(), 1)));
}

TEST(FastSincosTurns, StaysWithinItsStatedError) {
  for (int i = -300000; i <= 300000; ++i) {
    const double turns = i / 100000.0;
    const SineCosine sc = fast_sincos_turns(turns);
    ASSERT_NEAR(sc.sine, std::sin(2 * std::numbers::pi * turns), 1e-10) << turns;
    ASSERT_NEAR(sc.cosine, std::cos(2 * std::numbers::pi * turns), 1e-10) << turns;
  }
}

}  // namespace
}  // namespace sateen
