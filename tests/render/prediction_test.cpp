#include "render/prediction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "render/allocation.h"
#include "render/pictures.h"

namespace sateen_test {
namespace {

using namespace sateen;

// A run as a model has it: E = 0.8 n^slope with a little noise, 10 ms of wall clock and 20 ms of CPU a sample.
std::vector<ErrorPoint> made_run(double slope, int until, std::mt19937& random) {
  std::normal_distribution<double> noise(0, 0.015);
  std::vector<ErrorPoint> points;
  for (int n = 16; n <= until; n = next_barrier(n)) {
    const double error = 0.8 * std::pow(n, slope) * std::exp(noise(random));
    points.push_back({double(n), double(n), double(n), 1, error, error * 1.02, 0.3 + 0.01 * n, 0.5 + 0.02 * n});
  }
  return points;
}

TEST(Prediction, FindsTheSlopeOfALongRun) {
  std::mt19937 random(1);
  for (const double slope : {-0.48, -0.58, -0.72}) {
    const ErrorSlope s = fit_slope(made_run(slope, 1000, random));
    EXPECT_NEAR(s.slope, slope, 0.02);
    EXPECT_LT(s.deviation, 0.02);
  }
  const ErrorSlope early = fit_slope(made_run(-0.6, 16, random));
  EXPECT_GT(early.deviation, 0.03) << "one point says nothing of a slope";
}

TEST(Prediction, HoldsWhatItPromisesInNineOfTenRuns) {
  std::mt19937 random(2);
  std::normal_distribution<double> slopes(-0.575, 0.045);
  int held = 0, runs = 400;
  std::vector<double> off;
  for (int run = 0; run < runs; ++run) {
    const std::vector<ErrorPoint> whole = made_run(slopes(random), 3000, random);
    const double target = whole[25 + size_t(run) % 60].high;
    const std::vector<ErrorPoint> pilot(whole.begin(), whole.begin() + 3);
    const Promise promise = promise_for_error(pilot, target);
    ASSERT_TRUE(promise.made);
    double real = 0;
    for (const ErrorPoint& p : whole)
      if (p.high <= target) {
        real = p.cpu_seconds;
        break;
      }
    held += promise.cpu_seconds.low <= real && real <= promise.cpu_seconds.high;
    off.push_back(std::abs(promise.cpu_seconds.value / real - 1));
  }
  // The model's own noise is a little below what is allowed for: 88 to 99 %.
  EXPECT_GE(held, runs * 0.88);
  EXPECT_LE(held, runs * 0.99);
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 0.15);
}

TEST(Prediction, OfSamplesAndOfTimeAgree) {
  std::mt19937 random(3);
  const std::vector<ErrorPoint> points = made_run(-0.6, 64, random);
  const Promise at = promise_at(points, 640);
  EXPECT_NEAR(at.seconds.value, 0.3 + 6.4, 1e-6);
  EXPECT_NEAR(at.cpu_seconds.value, 0.5 + 12.8, 1e-6);
  const Promise in = promise_in_time(points, at.seconds.value);
  EXPECT_NEAR(in.error.value, at.error.value, 1e-9);
  EXPECT_NEAR(in.samples.value, 640, 1e-6);
  EXPECT_FALSE(promise_for_error({}, 0.1).made);
  EXPECT_FALSE(promise_at({}, 10).made);
}

TEST(Prediction, IsMadeOnceAndToldWithTheResult) {
  const Scene scene = scene_of(scene_settings("ivory_duchess_satin", 32, 24));
  RenderSettings settings = samples(160);
  Film film(32, 24, false);
  Promise told;
  const RenderResult result = render(scene, settings, film, [&](const RenderState& state) {
    if (!state.promise.made) return;
    if (told.made) {
      EXPECT_EQ(told.samples.value, state.promise.samples.value);
    }
    told = state.promise;
  });
  ASSERT_TRUE(told.made);
  EXPECT_EQ(told.samples.value, 160);
  EXPECT_EQ(result.promise.error.value, told.error.value);
  // E at the end is known to a few percent; three intervals are never left.
  EXPECT_NEAR(std::log(result.error.error / told.error.value), 0, 3 * std::log(told.error.high / told.error.value));
}

}  // namespace
}  // namespace sateen_test
