#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "math/lane_functions.h"
#include "portable_lanes.h"

namespace sateen::test {

void native_results(const float* a, const float* b, const float* c, LaneResults& out) {
#include "lane_operations.inc"
}

namespace {

TEST(Lanes, HaveTheSameBitsWithoutAvx2) {
#ifndef SATEEN_AVX2
  GTEST_SKIP() << "this build has no AVX2 branch to compare with";
#endif
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-30, 30), sign(-1, 1);
  const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, 1.5f, 2.5f, -87.3f, 88.0f, 3e38f, 1e-38f};
  for (int i = 0; i < 20000; ++i) {
    float input[3][8];
    for (auto& row : input)
      for (float& v : row) {
        v = std::copysign(std::exp2(exponent(random)), sign(random));
        if (i % 4 == 0) v = std::copysign(float(std::exp2(exponent(random) / 8)), sign(random));
        if (random() % 16 == 0) v = special[random() % 11];
      }
    LaneResults native, portable;
    native_results(input[0], input[1], input[2], native);
    portable_results(input[0], input[1], input[2], portable);
    for (int row = 0; row < lane_operations; ++row)
      for (int k = 0; k < 8; ++k) {
        if (std::isnan(native[row][k]) && std::isnan(portable[row][k])) continue;
        EXPECT_EQ(std::memcmp(&native[row][k], &portable[row][k], 4), 0)
            << "operation " << row << " of " << input[0][k] << ", " << input[1][k] << ", " << input[2][k] << ": "
            << native[row][k] << " and " << portable[row][k];
      }
  }
}

// Eight values of a float function at a time.
template <class F>
void over(double from, double to, int steps, F&& check) {
  for (int i = 0; i < steps; i += 8) {
    float x[8];
    for (int k = 0; k < 8; ++k) x[k] = float(from + (to - from) * (i + k) / (steps - 1));
    check(x);
  }
}

TEST(ExpNegative, IsExactToAQuarterOfAMillionth) {
  double worst = 0;
  over(-87.2, 0, 4000000, [&](const float* x) {
    float y[8];
    exp_negative(Lanes::load(x)).store(y);
    for (int k = 0; k < 8; ++k) worst = std::max(worst, std::abs(y[k] / std::exp(double(x[k])) - 1));
  });
  EXPECT_LT(worst, 2.5e-7);
  printf("exp_negative: relative error %.2e\n", worst);
  const float far[8] = {-87.4f, -88, -100, -1e4f, -1e30f, -3e38f, -0.0f, 0};
  float y[8];
  exp_negative(Lanes::load(far)).store(y);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(y[k], 0);
  EXPECT_EQ(y[6], 1);
  EXPECT_EQ(y[7], 1);
}

TEST(AtanMagnitude, StaysWithinItsStatedError) {
  double worst = 0, relative = 0;
  const auto check = [&](float y, float x) {
    float angle[8];
    atan_magnitude(Lanes(y), Lanes(x)).store(angle);
    const double truth = std::atan2(std::abs(double(y)), double(x));
    worst = std::max(worst, std::abs(angle[0] - truth));
    if (truth > 0) relative = std::max(relative, std::abs(angle[0] / truth - 1));
  };
  for (int i = 0; i <= 1000000; ++i) {
    const double a = M_PI / 2 * i / 1000000;
    check(float(std::sin(a)), float(std::max(std::cos(a), 0.0)));
    check(-float(std::sin(a) * 1e-3), float(std::max(std::cos(a), 0.0) * 1e-3));
  }
  for (double e = -30; e < 30; e += 0.01) check(float(std::exp2(e)), 1), check(1, float(std::exp2(e)));
  check(1, 0);
  check(0, 1);
  EXPECT_LT(worst, 1.8e-7);  // of which 1.2e-7 are rounding near pi / 2
  EXPECT_LT(relative, 1.8e-7);
  printf("atan_magnitude: absolute error %.2e, relative %.2e\n", worst, relative);
}

TEST(AtanSquared, IsTheSquareOfTheAngle) {
  double worst = 0;
  for (int i = 0; i <= 1000000; ++i) {
    const double a = M_PI / 2 * i / 1000000 * 0.9999;
    float out[8];
    const float y = float(std::sin(a)), x = float(std::cos(a));
    atan_squared(Lanes(-y), Lanes(x)).store(out);
    const double truth = std::pow(std::atan2(double(y), double(x)), 2);
    if (truth > 1e-30) worst = std::max(worst, std::abs(out[0] / truth - 1));
  }
  EXPECT_LT(worst, 1e-6);
  printf("atan_squared: relative error %.2e\n", worst);
}

TEST(HalfAngleSquared, IsExactToAMillionth) {
  double worst = 0;
  for (int i = 1; i <= 2000000; ++i) {
    const double a = M_PI / 2 * i / 2000000, s = std::sin(a), c = std::max(std::cos(a), 0.0);
    const float q = float(s * s), h2 = float(c * c), h = float(c);
    float out[8];
    half_angle_squared(Lanes(q), Lanes(h2), Lanes(h)).store(out);
    // The input's own rounding is not the function's error: the angle that its smaller part states.
    const double truth = s < c ? std::asin(std::sqrt(double(q))) : M_PI / 2 - std::asin(std::min(double(h), 1.0));
    worst = std::max(worst, std::abs(out[0] / (truth * truth) - 1));
  }
  EXPECT_LT(worst, 1e-6);
  printf("half_angle_squared: relative error %.2e\n", worst);
}

TEST(SineAndCosine, AreExactToAnEighthOfAMillionth) {
  double sine = 0, cosine = 0;
  over(-M_PI / 2, M_PI / 2, 2000000, [&](const float* x) {
    float s[8], c[8];
    sin_quarter(Lanes::load(x)).store(s);
    cos_quarter(Lanes::load(x)).store(c);
    for (int k = 0; k < 8; ++k) {
      sine = std::max(sine, std::abs(s[k] - std::sin(double(x[k]))));
      cosine = std::max(cosine, std::abs(c[k] - std::cos(double(x[k]))));
    }
  });
  EXPECT_LT(sine, 1.2e-7);
  EXPECT_LT(cosine, 1.2e-7);
  printf("sin_quarter: %.2e, cos_quarter: %.2e\n", sine, cosine);
}

TEST(DoubleLanes, AreLibm) {
  for (double x = -20; x <= 0; x += 0.37) EXPECT_EQ(exp_negative(x), std::exp(x));
  for (double a = 0.01; a < 1.57; a += 0.01) {
    EXPECT_NEAR(atan_squared(std::sin(a), std::cos(a)), a * a, 1e-15);
    EXPECT_NEAR(half_angle_squared(std::sin(a) * std::sin(a), std::cos(a) * std::cos(a), std::cos(a)), a * a, 1e-14);
    EXPECT_EQ(sin_quarter(a), std::sin(a));
    EXPECT_EQ(cos_quarter(a), std::cos(a));
  }
  EXPECT_EQ(select_less(1.0, 2.0, 3.0, 4.0), 3);
  EXPECT_EQ(select_less(2.0, 2.0, 3.0, 4.0), 4);
  EXPECT_EQ(min(1.0, 2.0), 1);
  EXPECT_EQ(max(1.0, 2.0), 2);
  EXPECT_EQ(fma(2.0, 3.0, 4.0), 10);
  EXPECT_EQ(fnma(2.0, 3.0, 4.0), -2);
}

}  // namespace
}  // namespace sateen::test
