#include "render/allocation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "render/error_scenes.h"

namespace sateen_test {
namespace {

using namespace sateen;

TEST(Barriers, GrowByAtLeastSixteenAndByAtMostASixteenthLater) {
  int samples = 0;
  for (int k = 0; k < 300; ++k) {
    const int next = next_barrier(samples);
    EXPECT_GE(next, samples + 16);
    EXPECT_EQ(next % 16, 0);
    EXPECT_LE(next, std::max(samples + 16, samples * 17 / 16));
    samples = next;
  }
  EXPECT_GT(samples, 100000);
}

/// 40 x 30 pixels with 16 samples each; the left half is empty, the right half noisy.
Film half_noisy_film() {
  Film film(40, 30, false);
  std::mt19937 random(3);
  std::normal_distribution<float> normal(1, 0.5f);
  for (int i = 0; i < 16; ++i)
    for (size_t k = 0; k < film.pixels.size(); ++k)
      add_sample(film.pixels[k], k % 40 < 20 ? Color(0) : Color(normal(random)), 1, film.grain);
  return film;
}

// A power of two, or one and a half times one.
bool is_even(std::uint32_t samples) {
  while (samples % 2 == 0 && samples > 3) samples /= 2;
  return samples == 1 || samples == 2 || samples == 3;
}

TEST(Allocation, OfEqualNoiseKeepsTheMeanThoughItTakesSteps) {
  Film film(40, 30, false);
  for (auto& pixel : film.pixels)
    for (int i = 0; i < 16; ++i) add_sample(pixel, Color(i / 4 % 2 ? 1.0f : i % 4 ? 0.5f : 0.7f), 1, film.grain);
  for (const int barrier : {32, 80, 112, 1056}) {
    const std::vector<std::uint32_t> targets = allocate(film, {}, barrier, true);
    EXPECT_NEAR(std::accumulate(targets.begin(), targets.end(), 0.0) / double(targets.size()), barrier,
                0.01 * barrier);
    for (const std::uint32_t target : targets) EXPECT_TRUE(is_even(target)) << target;
  }
}

// Weights over many orders, some pixels with far more samples than their share, strips of one kind that a coarse look
// at the picture meets too often or never.
TEST(Allocation, AddsUpToTheMeanHoweverUnlikeThePixelsAre) {
  for (const int kind : {0, 1, 2, 3}) {
    Film film(kind == 3 ? 1 : 183, kind == 3 ? 7 : 122, false);  // three times 61 pixels a row
    std::mt19937 random(7);
    std::lognormal_distribution<float> wide(0, 4);
    for (size_t k = 0; k < film.pixels.size(); ++k) {
      const float spread = kind == 1 ? (k % 61 == 0 ? 100.0f : 1.0f) : wide(random);
      const int samples = kind == 2 && k % 50 == 0 ? 400 : 16;
      for (int i = 0; i < samples; ++i)
        add_sample(film.pixels[k], Color(10 + spread * float((i + int(k)) % 4)), 1, film.grain);
    }
    for (const int barrier : {32, 48, 1024}) {
      const std::vector<std::uint32_t> targets = allocate(film, {}, barrier, true);
      const double wanted = double(barrier) * double(targets.size());
      const double sum = std::accumulate(targets.begin(), targets.end(), 0.0);
      EXPECT_LE(sum, wanted) << kind << " " << barrier;
      EXPECT_GT(sum, (kind == 3 ? 0.6 : 0.97) * wanted) << kind << " " << barrier;
    }
  }
}

TEST(Allocation, IsTheSameEverywhereWhereItIsUniform) {
  const Film film = half_noisy_film();
  for (const std::uint32_t target : allocate(film, {}, 48, false)) EXPECT_EQ(target, 48u);
  for (const std::uint32_t target : allocate(Film(8, 8, false), {}, 16, true)) EXPECT_EQ(target, 16u);
  const std::vector<std::uint32_t> cropped = allocate(film, {3, 4, 9, 8}, 48, true);
  for (size_t i = 0; i < cropped.size(); ++i) {
    const size_t x = i % 40, y = i / 40;
    EXPECT_EQ(cropped[i] > 0, x >= 3 && x < 9 && y >= 4 && y < 8);
  }
}

TEST(Allocation, GoesWhereTheNoiseIsAndAddsUpToTheMean) {
  const Film film = half_noisy_film();
  const std::vector<std::uint32_t> targets = allocate(film, {}, 48, true);
  const double sum = std::accumulate(targets.begin(), targets.end(), 0.0);
  EXPECT_NEAR(sum / double(targets.size()), 48, 1.5);
  for (size_t i = 0; i < targets.size(); ++i) {
    if (i % 40 < 17) {
      EXPECT_EQ(targets[i], 16u) << "an empty pixel stops at once";
    } else if (i % 40 > 22) {
      EXPECT_GT(targets[i], 40u);
    }
    EXPECT_TRUE(is_even(targets[i])) << targets[i];
  }
  // Even an empty pixel gets a sixteenth of the mean.
  for (const std::uint32_t target : allocate(film, {}, 1600, true)) EXPECT_GE(target, 100u - 4u);
}

TEST(Allocation, OfAPixelDoesNotDependOnItsOwnSamples) {
  const Film film = half_noisy_film();
  Film other = film;
  const size_t here = 15 * 40 + 30;
  add_sample(other.pixels[here], Color(50), 1, other.grain);
  other.pixels[here].samples = 16;
  const std::uint32_t before = allocate(film, {}, 64, true)[here], after = allocate(other, {}, 64, true)[here];
  // All together share what there is, so the scale moves by the neighbours' greater wants; it never goes up.
  EXPECT_LE(after, before);
  EXPECT_GT(allocate(other, {}, 64, true)[here + 1], allocate(film, {}, 64, true)[here + 1]);
}

TEST(Allocation, PartsOfATargetNeverPassItAndAreExactWhereItIsUniform) {
  for (int samples = 1; samples <= 112; ++samples)
    EXPECT_EQ(part_of_target(112, samples, 112), std::uint32_t(samples));
  EXPECT_EQ(part_of_target(40, 112, 112), 40u);
  EXPECT_LE(part_of_target(40, 56, 112), 40u);
}

/// Samples that a uniform render needs for the error of an adaptive one, over those it took.
double gain(const Scene& scene, int width, int height) {
  double log_gain = 0;
  const std::vector<int> counts{64, 128};  // powers of two, where the uniform one is at its best
  for (const int spp : counts) {
    double uniform[2], adaptive = 0;
    RenderSettings settings = samples(spp);
    for (int k = 0; k < 2; ++k) {
      settings.stop.spp = k == 0 ? spp : spp * 2;
      Film film(width, height, false);
      uniform[k] = render(scene, settings, film).error.error;
    }
    settings.stop.spp = spp;
    settings.adaptive = true;
    Film film(width, height, false);
    adaptive = render(scene, settings, film).error.error;
    const double slope = std::log(uniform[1] / uniform[0]) / std::log(2.0);
    log_gain += std::log(adaptive / uniform[0]) / slope;
  }
  return std::exp(log_gain / double(counts.size()));
}

TEST(Allocation, GainsOnFramesHalfEmptyAndCostsNothingOnFramesFullOfCloth) {
  const int width = 64, height = 48;
  const double half =
      gain(scene_of(ErrorScene{"emerald_satin", "skirt", "three_light_rig"}, width, height), width, height);
  SceneSettings close = scene_settings("shot_taffeta", width, height);
  close.mesh = "swatch";
  close.camera.zoom = 3;
  const double full = gain(scene_of(close), width, height);
  if (std::getenv("SATEEN_TEST_NUMBERS")) std::fprintf(stderr, "gain: half empty %.2f, full %.2f\n", half, full);
  EXPECT_GE(half, 1.5);
  EXPECT_GE(full, 0.95);
}

}  // namespace
}  // namespace sateen_test
