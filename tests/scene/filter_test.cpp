#include "scene/filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace sateen {
namespace {

constexpr double tau = 2 * std::numbers::pi;

// Integral of the four-term Blackman-Harris window of width 3 from -1.5 to x, over its whole, in closed form.
double share_below(double x) {
  const double t = tau * (x + 1.5) / 3;
  const double a0 = 0.35875, a1 = 0.48829, a2 = 0.14128, a3 = 0.01168;
  return (a0 * t - a1 * std::sin(t) + a2 / 2 * std::sin(2 * t) - a3 / 3 * std::sin(3 * t)) / (a0 * tau);
}

constexpr int many = 1 << 16;

// Evenly spaced numbers instead of random ones: nothing here is left to chance. A step of the inverse table holds
// 1/1024 of all samples; the tests ask for half of that.
TEST(Filter, SamplesAreDistributedAsBlackmanHarris) {
  double largest = 0;
  for (int i = 0; i < many; ++i) {
    const double u = (i + 0.5) / many;
    largest = std::max(largest, std::abs(share_below(double(sample_filter(*compile_filter(), {u, 0.5}).x)) - u));
    largest = std::max(largest, std::abs(share_below(double(sample_filter(*compile_filter(), {0.5, u}).y)) - u));
  }
  EXPECT_LT(largest, 5e-4);
}

TEST(Filter, HistogramFollowsTheCurve) {
  constexpr int bins = 30;
  std::vector<double> counts(bins);
  for (int i = 0; i < many; ++i)
    counts[size_t((double(sample_filter(*compile_filter(), {(i + 0.5) / many, 0.5}).x) + 1.5) / 3 * bins)] +=
        1.0 / many;
  for (int b = 0; b < bins; ++b) {
    const double expected = share_below(-1.5 + 3.0 * (b + 1) / bins) - share_below(-1.5 + 3.0 * b / bins);
    EXPECT_NEAR(counts[size_t(b)], expected, 4e-4) << "bin " << b;
  }
}

TEST(Filter, IsCentredSymmetricAndAsWideAsItsCurve) {
  double sum = 0, squares = 0, variance = 0;
  for (int i = 0; i < many; ++i) {
    const double u = (i + 0.5) / many;
    const auto x = double(sample_filter(*compile_filter(), {u, 0}).x);
    EXPECT_NEAR(x, -double(sample_filter(*compile_filter(), {1 - u, 0}).x), 2e-5) << u;
    sum += x;
    squares += x * x;
    const double at = -1.5 + 3 * u;
    variance += at * at * (share_below(at + 1.5 / many) - share_below(at - 1.5 / many));
  }
  EXPECT_NEAR(sum / many, 0, 1e-6);
  EXPECT_NEAR(squares / many, variance, 6e-4);
}

TEST(Filter, StaysInsideThreePixelsForEveryNumberThatASequenceGives) {
  for (const double u : {0.0, 0x1p-32, 0.5, 1 - 0x1p-24, 1 - 0x1p-32, 1 - 0x1p-53}) {
    const Vec2 p = sample_filter(*compile_filter(), {u, 1 - u < 1 ? 1 - u : 0});
    EXPECT_TRUE(std::abs(p.x) <= 1.5f && std::abs(p.y) <= 1.5f) << u;
  }
}

TEST(Filter, AxesAreIndependentOfOneAnother) {
  EXPECT_EQ(sample_filter(*compile_filter(), {0.3, 0.1}).x, sample_filter(*compile_filter(), {0.3, 0.9}).x);
  EXPECT_EQ(sample_filter(*compile_filter(), {0.3, 0.1}).y, sample_filter(*compile_filter(), {0.8, 0.1}).y);
}

// Midpoints of equal shares: the variance that is sampled, to the steps of the table.
double sampled_variance(const FilterSettings& settings) {
  const std::shared_ptr<const PixelFilter> filter = compile_filter(settings);
  double squares = 0;
  for (int i = 0; i < many; ++i) {
    const auto x = double(sample_filter(*filter, {(i + 0.5) / many, 0}).x);
    EXPECT_LE(std::abs(x), double(settings.radius));
    EXPECT_NEAR(x, -double(sample_filter(*filter, {1 - (i + 0.5) / many, 0}).x), 4e-5);
    squares += x * x / many;
  }
  return squares;
}

TEST(Filter, EveryShapeIsAsWideAsItsCurve) {
  EXPECT_NEAR(sampled_variance({FilterShape::box, 0.5f}), 0.25 / 3, 1e-5);
  EXPECT_NEAR(sampled_variance({FilterShape::triangle, 1}), 1.0 / 6, 2e-4);
  // A normal distribution cut off at three deviations keeps 0.9733 of its variance.
  EXPECT_NEAR(sampled_variance({FilterShape::gaussian, 1.5f}), 0.25 * 0.9733, 8e-4);
  const double one = sampled_variance({FilterShape::blackman_harris, 1});
  EXPECT_NEAR(sampled_variance({FilterShape::blackman_harris, 3}), 9 * one, 1e-4);
}

TEST(Filter, IsReadAsItIsWritten) {
  for (const std::string& name : filter_names()) {
    const FilterSettings usual = read_filter("--filter", name);
    EXPECT_EQ(read_filter("--filter", filter_text(usual)), usual);
    EXPECT_EQ(read_filter("--filter", name + ":2").radius, 2);
  }
  EXPECT_EQ(read_filter("--filter", "blackman-harris"), FilterSettings());
}

}  // namespace
}  // namespace sateen
