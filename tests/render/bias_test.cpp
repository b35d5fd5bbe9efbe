#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "render/error_scenes.h"
#include "statistics/z_test.h"

// The mean of many short renders is the reference: for every strategy, with samples dealt out by error, stopped by
// the error, gone on with and merged. Every pixel and channel and the whole picture are compared, no variance is
// floored, and all comparisons of a test together raise a false alarm in 1e-4 of seeds; seeds are fixed.
//
// Tried by hand: the weights of one strategy times 1.02 (8.6 and 12.1 standard deviations of a bound of 5.6); pixels
// dealt samples by their own scatter instead of their neighbours' (17 of 5.4: pixels on an edge lose half their
// light).

namespace sateen_test {
namespace {

using namespace sateen;

constexpr int width = 12, height = 9, pixels = width * height;

struct Means {
  std::vector<Batches> values = std::vector<Batches>(size_t(pixels) * 3 + 3);  ///< pixels, then the whole picture

  void add(const Film& film) {
    Vec3d sum(0);
    for (size_t i = 0; i < film.pixels.size(); ++i) {
      const Color mean = pixel_mean(film.pixels[i]);
      for (int c = 0; c < 3; ++c) {
        values[3 * i + size_t(c)].add(double(mean[c]));
        sum[c] += double(mean[c]);
      }
    }
    for (int c = 0; c < 3; ++c) values[size_t(pixels) * 3 + size_t(c)].add(sum[c] / pixels);
  }
};

using Way = std::function<void(const Scene&, const RenderSettings&, Film&)>;

Means means_of(const Scene& scene, RenderSettings settings, int renders, std::uint32_t first_seed, const Way& way) {
  Means means;
  settings.threads = 1;
  for (int k = 0; k < renders; ++k) {
    settings.seed = first_seed + std::uint32_t(k);
    Film film(width, height, false);
    way(scene, settings, film);
    means.add(film);
  }
  return means;
}

void at_once(const Scene& scene, const RenderSettings& settings, Film& film) {
  render(scene, settings, film);
}

RenderSettings settings_of(Strategy strategy, int spp, bool adaptive) {
  RenderSettings settings = samples(spp);
  settings.light.strategy = strategy;
  settings.adaptive = adaptive;
  return settings;
}

// The short run takes about 20 CPU-seconds.
int renders() {
  return std::getenv("SATEEN_LONG_TESTS") ? 600 : 120;
}

const Means& lamps_reference(const Scene& scene) {
  static const Means reference =
      means_of(scene, settings_of(Strategy::mis_compensated, 512, false), renders() / 4, 5000, at_once);
  return reference;
}

void expect_same(const Means& found, const Means& reference, const std::string& what, double tests) {
  const double bound = sidak_deviate(1e-4, tests * double(found.values.size()));
  double worst = 0;
  size_t place = 0;
  for (size_t i = 0; i < found.values.size(); ++i) {
    const double deviate = std::abs(difference_deviate(found.values[i], reference.values[i]));
    if (deviate > worst) worst = deviate, place = i;
  }
  if (std::getenv("SATEEN_TEST_NUMBERS")) std::fprintf(stderr, "%-44s %.2f of %.2f\n", what.c_str(), worst, bound);
  EXPECT_LT(worst, bound) << what << ": " << (place < size_t(pixels) * 3 ? "pixel " : "picture ") << place / 3
                          << ", channel " << place % 3 << ": " << found.values[place].mean << " against "
                          << reference.values[place].mean;
}

// A soft light that every strategy finds: all of them, uniform and adaptive.
TEST(Bias, OfNoStrategyWithSamplesDealtOutByErrorOrNot) {
  const Scene scene = scene_of(ErrorScene{"velvet_red", "sphere", "overcast"}, width, height);
  const Means reference =
      means_of(scene, settings_of(Strategy::mis_compensated, 256, false), renders() / 3, 5000, at_once);
  const double tests = 2 * double(strategy_names().size());
  for (const std::string& name : strategy_names())
    for (const bool adaptive : {false, true}) {
      const RenderSettings settings = settings_of(strategy_from_name(name), adaptive ? 48 : 16, adaptive);
      expect_same(means_of(scene, settings, renders(), 100, at_once), reference,
                  name + (adaptive ? ", adaptive" : ""), tests);
    }
}

// Satin under small lamps, half of it in shadow: here samples are dealt out most unevenly.
TEST(Bias, OfNoWayToRenderAPicture) {
  const Scene scene = scene_of(ErrorScene{"emerald_satin", "sphere", "three_light_rig"}, width, height);
  const Means& reference = lamps_reference(scene);
  RenderSettings settings = settings_of(Strategy::mis_compensated, 64, true);
  const double tests = 5;
  expect_same(means_of(scene, settings, renders(), 100, at_once), reference, "adaptive", tests);

  const Way stopped = [](const Scene& s, const RenderSettings& asked, Film& film) {
    RenderSettings how = asked;
    Course course;
    for (const int spp : {3, 20, 41, 64}) {
      how.stop.spp = spp;
      render(s, how, film, course, {});
    }
  };
  expect_same(means_of(scene, settings, renders(), 1100, stopped), reference, "stopped and gone on with", tests);

  // The error at which about half of the renders stop a barrier early.
  RenderSettings by_error = settings;
  Film probe(width, height, false);
  by_error.stop.error = render(scene, settings, probe).error.high;
  by_error.stop.spp = 0;
  expect_same(means_of(scene, by_error, renders(), 2100, at_once), reference, "stopped by the error", tests);

  const Way merged = [](const Scene& s, const RenderSettings& asked, Film& film) {
    RenderSettings how = asked;
    how.adaptive = false;
    for (const auto& [first, count] : {std::pair(12, 20), std::pair(0, 12)}) {
      Film part(width, height, false);
      part.first_sample = std::uint32_t(first);
      how.stop.spp = count;
      render(s, how, part);
      add_film(film, part);
    }
  };
  expect_same(means_of(scene, settings, renders(), 3100, merged), reference, "merged", tests);
  settings.light.strategy = Strategy::resampled;
  expect_same(means_of(scene, settings, renders(), 4100, at_once), reference, "resampled, adaptive", tests);
}

// What the tests above can see: a weight that is two percent off.
TEST(Bias, OfTwoPercentWouldBeSeen) {
  const Scene scene = scene_of(ErrorScene{"emerald_satin", "sphere", "three_light_rig"}, width, height);
  const Way heavy = [](const Scene& s, const RenderSettings& asked, Film& film) {
    render(s, asked, film);
    for (FilmPixel& pixel : film.pixels)
      for (Vec3d& sum : pixel.beauty) sum *= 1.02;
  };
  const Means found = means_of(scene, settings_of(Strategy::mis_compensated, 64, true), renders(), 100, heavy);
  double worst = 0;
  for (size_t i = 0; i < found.values.size(); ++i)
    worst = std::max(worst, std::abs(difference_deviate(found.values[i], lamps_reference(scene).values[i])));
  EXPECT_GT(worst, sidak_deviate(1e-4, 5.0 * double(found.values.size())));
}

}  // namespace
}  // namespace sateen_test
