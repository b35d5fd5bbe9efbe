#include "film/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "render/candidates.h"
#include "render/error_scenes.h"

// Claimed errors against real ones: short renders and references of 64 times their samples from another seed. What is
// fixed here are seeds, so these tests pass always or never; the bars are those of docs/error.md, whose table the
// long run prints with SATEEN_TEST_NUMBERS.

namespace sateen_test {
namespace {

using namespace sateen;

constexpr int spp = 64, times = 64;

/// What a picture is off by, relative as E is, without the reference's own share.
double real_error(const Film& film, const Film& reference) {
  double sum = 0;
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    const Color a = pixel_mean(film.pixels[i]), b = pixel_mean(reference.pixels[i]);
    const Color own = pixel_variance(reference.pixels[i]);
    for (int c = 0; c < 3; ++c) {
      const double off = double(a[c]) - double(b[c]);
      sum += (off * off - double(own[c])) / (double(b[c]) * double(b[c]) + 0.01);
    }
  }
  return std::sqrt(std::max(sum, 0.0) / (3.0 * double(film.pixels.size())));
}

struct Coverage {
  double inside = 0, all = 0;              ///< values of pixels within their 95 % intervals
  double share_inside = 0, share_all = 0;  ///< pixels within the deviation that 95 % are said to keep
  void add(const Film& film, double deviation, const Film& reference) {
    const std::vector<Color> variances = pooled_variances(film);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
      const Color a = pixel_mean(film.pixels[i]), b = pixel_mean(reference.pixels[i]);
      const Color own = pixel_variance(reference.pixels[i]);
      double squares = 0;
      for (int c = 0; c < 3; ++c) {
        const double off = double(a[c]) - double(b[c]);
        squares += off * off / (double(b[c]) * double(b[c]) + 0.01) / 3;
        // Where nothing was ever seen there is no interval.
        if (variances[i][c] == 0 && off == 0) continue;
        ++all;
        inside += std::abs(off) <= interval_factor * std::sqrt(double(variances[i][c]) + double(own[c]));
      }
      ++share_all;
      share_inside += std::sqrt(squares) <= deviation;
    }
  }
};

struct Tally {
  int runs = 0, near = 0, in_interval = 0, met = 0, met_of = 0, scenes = 0, covered = 0;
};

/// As the program renders it: with as many candidates as its pilot chooses.
RenderSettings settings_for(const ErrorScene& scene, const CandidateCounts& candidates, std::uint32_t seed,
                            bool adaptive) {
  RenderSettings settings = samples(spp, seed);
  settings.light.bounces = scene.bounces;
  settings.light.candidates = candidates;
  settings.adaptive = adaptive;
  return settings;
}

void judge(const ErrorScene& which, int width, int height, int seeds, Tally& tally) {
  const Scene scene = scene_of(which, width, height);
  const CandidateCounts candidates = choose_candidates(scene, {}, default_error_floor, 1, 0).candidates;
  RenderSettings settings = settings_for(which, candidates, 777, false);
  settings.stop.spp = spp * times;
  Film reference(width, height, false);
  render(scene, settings, reference);
  // A target that is met at about 64 samples.
  Film pilot(width, height, false);
  const double target = render(scene, settings_for(which, candidates, 900, true), pilot).error.high;

  double worst = 1, mean_error = 0, samples_taken = 0;
  Coverage coverage;
  int near = 0, in_interval = 0, met = 0;
  for (int run = 0; run < 2 * seeds; ++run) {
    const bool adaptive = run >= seeds;
    settings = settings_for(which, candidates, 10 + std::uint32_t(run), adaptive);
    if (adaptive) {
      settings.stop.spp = 0;
      settings.stop.error = target;
    }
    Film film(width, height, false);
    const RenderResult result = render(scene, settings, film);
    const double real = real_error(film, reference), ratio = result.error.error / real;
    if (std::abs(std::log(ratio)) > std::abs(std::log(worst))) worst = ratio;
    near += std::abs(ratio - 1) <= 0.1;
    in_interval += result.error.low <= real && real <= result.error.high;
    if (adaptive) met += real <= target, samples_taken += result.samples, mean_error += result.error.error;
    coverage.add(film, result.deviation, reference);
  }
  const double share = coverage.inside / coverage.all;
  tally.runs += 2 * seeds, tally.near += near, tally.in_interval += in_interval;
  tally.met += met, tally.met_of += seeds;
  ++tally.scenes, tally.covered += share >= 0.93 && share <= 0.97;
  if (std::getenv("SATEEN_TEST_NUMBERS"))
    std::fprintf(stderr, "| %s | %s | %.3f | %.0f | %.2f | %d/%d | %d/%d | %.1f | %.1f | %d/%d |\n",
                 name_of(which).c_str(), candidates_text(candidates).c_str(), mean_error / seeds,
                 samples_taken / seeds, worst, near, 2 * seeds, in_interval, 2 * seeds, 100 * share,
                 100 * coverage.share_inside / coverage.share_all, met, seeds);
}

void expect_bars(const Tally& t) {
  EXPECT_GE(t.near, 0.95 * t.runs) << "claimed E within 10 % of what it really is";
  EXPECT_GE(t.met, 0.95 * t.met_of) << "asked errors that are met";
  EXPECT_GE(t.in_interval, 0.92 * t.runs) << "real errors in their 95 % interval";
  EXPECT_GE(t.covered, 0.9 * t.scenes) << "scenes whose pixels are in their 95 % interval in 93 to 97 %";
}

// A studio, a small sun on a thin lobe, and a sky: 48 x 36 pixels, about 20 CPU-seconds.
TEST(ClaimedError, IsTheRealOneInThreeScenes) {
  Tally tally;
  for (const size_t i : {0u, 3u, 6u}) judge(error_scenes()[i], 48, 36, 2, tally);
  // Of 12 and 6 runs 95 % are all.
  EXPECT_GE(tally.near, 11);
  EXPECT_EQ(tally.met, 6);
  EXPECT_GE(tally.in_interval, 10);
  EXPECT_EQ(tally.covered, 3);
}

TEST(ClaimedError, IsTheRealOneInEveryScene) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "long: set SATEEN_LONG_TESTS";
  ASSERT_GE(error_scenes().size(), 24u);
  Tally tally;
  for (const ErrorScene& scene : error_scenes()) judge(scene, 64, 48, 5, tally);
  std::fprintf(stderr,
               "within 10 %%: %d of %d; in the interval: %d; targets met: %d of %d; coverage: %d of %d scenes\n",
               tally.near, tally.runs, tally.in_interval, tally.met, tally.met_of, tally.covered, tally.scenes);
  expect_bars(tally);
}

/// Errors so coarse that renders end before the first barrier.
struct CoarseTally {
  int runs = 0, met = 0;
  double log_ratio = 0;  ///< sum over runs, of the claimed over the real error
};

void judge_coarse(const ErrorScene& which, int width, int height, int seeds, CoarseTally& tally) {
  const Scene scene = scene_of(which, width, height);
  const CandidateCounts candidates = choose_candidates(scene, {}, default_error_floor, 1, 0).candidates;
  RenderSettings settings = settings_for(which, candidates, 777, false);
  settings.stop.spp = 1024;
  Film reference(width, height, false);
  render(scene, settings, reference);
  for (const double target : {0.3, 0.2, 0.1, 0.07, 0.05, 0.035}) {
    int met = 0, early = 0;
    double ratio = 0, taken = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      settings = settings_for(which, candidates, 10 + std::uint32_t(seed), true);
      settings.stop.spp = 0;
      settings.stop.error = target;
      Film film(width, height, false);
      const RenderResult result = render(scene, settings, film);
      const double real = real_error(film, reference);
      if (result.samples >= 16) continue;  // what is looked at at barriers is judged above
      ++early;
      met += real <= target;
      ratio += std::log(result.error.error / real);
      taken += result.samples;
    }
    tally.runs += early, tally.met += met, tally.log_ratio += ratio;
    if (std::getenv("SATEEN_TEST_NUMBERS") && early > 0)
      std::fprintf(stderr, "| %s | %.3g | %d/%d | %.1f | %.2f | %d/%d |\n", name_of(which).c_str(), target, early,
                   seeds, taken / early, std::exp(ratio / early), met, early);
  }
}

// A studio, a small sun on a thin lobe, and a sky: 48 x 36 pixels, about 5 CPU-seconds.
TEST(ClaimedError, IsMetWhereItIsCoarseInThreeScenes) {
  CoarseTally tally;
  for (const size_t i : {0u, 3u, 6u}) judge_coarse(error_scenes()[i], 48, 36, 4, tally);
  EXPECT_GE(tally.runs, 12);
  EXPECT_GE(tally.met, 0.95 * tally.runs);
  EXPECT_NEAR(tally.log_ratio / tally.runs, 0, 0.1);
}

TEST(ClaimedError, IsMetWhereItIsCoarseInEveryScene) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "long: set SATEEN_LONG_TESTS";
  CoarseTally tally;
  for (const ErrorScene& scene : error_scenes()) judge_coarse(scene, 64, 48, 5, tally);
  std::fprintf(stderr, "ended before the first barrier: %d; met: %d; claimed over real: %.3f\n", tally.runs,
               tally.met, std::exp(tally.log_ratio / tally.runs));
  EXPECT_GE(tally.met, 0.95 * tally.runs);
  EXPECT_NEAR(tally.log_ratio / tally.runs, 0, 0.05);
}

}  // namespace
}  // namespace sateen_test
