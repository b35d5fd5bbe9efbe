#include "render/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/develop.h"
#include "render/albedo_map.h"
#include "render/pictures.h"
#include "statistics/z_test.h"

namespace sateen_test {
namespace {

using namespace sateen;

const Scene& satin_scene() {
  static const Scene scene = scene_of(scene_settings("ivory_duchess_satin", 24, 16));
  return scene;
}

TEST(StopRules, EndAtTheSamplesAskedFor) {
  for (const int spp : {1, 2, 4, 7, 33}) {
    Film film(24, 16, false);
    const RenderResult result = render(satin_scene(), samples(spp), film);
    EXPECT_EQ(result.reason, StopReason::samples);
    EXPECT_EQ(result.samples, spp);
    for (const FilmPixel& pixel : film.pixels) EXPECT_EQ(pixel.samples, std::uint32_t(spp));
  }
}

TEST(StopRules, EndOnceTheUpperEndOfTheErrorIsBelowTheTarget) {
  for (const double target : {0.2, 0.05, 0.04}) {
    RenderSettings settings = samples(0);
    settings.stop.error = target;
    Film film(24, 16, false);
    const RenderResult result = render(satin_scene(), settings, film);
    EXPECT_EQ(result.reason, StopReason::error);
    EXPECT_LE(result.error.high, target);
    int barrier = 0;
    while (barrier < result.samples) barrier = next_barrier(barrier);
    if (result.samples >= next_barrier(0)) {
      EXPECT_EQ(barrier, result.samples) << "it is looked at at barriers";
    } else {
      EXPECT_EQ(result.samples % replicates, 0) << "or before the first, with as many samples in every replicate";
    }
  }
}

TEST(StopRules, ACoarseErrorEndsBeforeTheFirstBarrierAndWhatFollowsIsTheSame) {
  RenderSettings settings = samples(0);
  settings.adaptive = true;
  settings.stop.error = 2;  // far above what so few pixels need
  Film film(24, 16, false);
  Course course;
  const RenderResult coarse = render(satin_scene(), settings, film, course, {});
  EXPECT_EQ(coarse.reason, StopReason::error);
  EXPECT_LT(coarse.samples, next_barrier(0));
  EXPECT_EQ(coarse.samples % replicates, 0);
  EXPECT_LE(coarse.error.high, 2);
  EXPECT_EQ(render(satin_scene(), settings, film, course, {}).samples, coarse.samples) << "it is met already";

  settings.stop.error = 0.03;
  EXPECT_GT(render(satin_scene(), settings, film, course, {}).samples, next_barrier(0));
  Film at_once(24, 16, false);
  render(satin_scene(), settings, at_once);
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    EXPECT_EQ(film.pixels[i].samples, at_once.pixels[i].samples);
    EXPECT_EQ(film.pixels[i].beauty, at_once.pixels[i].beauty);
  }
}

TEST(StopRules, TheFirstOfSeveralCounts) {
  RenderSettings settings = samples(8);
  settings.stop.error = 1e-6;
  settings.stop.seconds = 1000;
  Film film(24, 16, false);
  EXPECT_EQ(render(satin_scene(), settings, film).reason, StopReason::samples);
  settings.stop.spp = 1 << 30;
  settings.stop.seconds = 0.05;
  Film timed(24, 16, false);
  const RenderResult result = render(satin_scene(), settings, timed);
  EXPECT_EQ(result.reason, StopReason::time);
  EXPECT_GT(result.samples, 0);
}

TEST(StopRules, AnInterruptLeavesWholeSamples) {
  const std::atomic<bool> at_once = true;
  Film untouched(24, 16, false);
  EXPECT_EQ(render(satin_scene(), samples(4), untouched, {}, &at_once).reason, StopReason::interrupted);
  for (const FilmPixel& pixel : untouched.pixels) EXPECT_EQ(pixel.samples, 0u);

  std::atomic<bool> later = false;
  Film film(24, 16, false);
  const RenderResult result = render(
      satin_scene(), samples(1 << 30), film, [&](const RenderState& state) { later = state.samples >= 8; }, &later);
  EXPECT_EQ(result.reason, StopReason::interrupted);
  EXPECT_GE(result.samples, 16);
  for (const FilmPixel& pixel : film.pixels) EXPECT_GE(pixel.samples, std::uint32_t(result.samples));
}

TEST(RenderProgress, NeverFallsAndTellsEveryPass) {
  RenderSettings settings = samples(64);
  double fraction = 0;
  int told_samples = 0;
  Film film(24, 16, false);
  render(satin_scene(), settings, film, [&](const RenderState& state) {
    EXPECT_GE(state.fraction, fraction);
    EXPECT_LE(state.fraction, 1);
    EXPECT_GE(state.samples, told_samples);
    fraction = state.fraction;
    told_samples = state.samples;
  });
  EXPECT_EQ(told_samples, 64);
}

// The variance that a film claims is the variance that seeds show: each pair of seeds gives one difference whose mean
// is 0 only if the replicates of a pixel are independent. False alarms 1e-4 over both strategies.
TEST(Replicates, ShowTheVarianceThatSeedsHave) {
  const double bound = sidak_deviate(1e-4, 2);
  for (const Strategy strategy : {Strategy::mis_compensated, Strategy::resampled}) {
    Batches excess;
    double claimed = 0, found = 0;
    for (std::uint32_t pair = 0; pair < 64; ++pair) {
      Film films[2] = {Film(24, 16, false), Film(24, 16, false)};
      for (std::uint32_t k = 0; k < 2; ++k) {
        RenderSettings settings = samples(8, 100 + 2 * pair + k);
        settings.light.strategy = strategy;
        render(satin_scene(), settings, films[k]);
      }
      double seen = 0, said = 0;
      for (size_t i = 0; i < films[0].pixels.size(); ++i) {
        const Color off = pixel_mean(films[0].pixels[i]) - pixel_mean(films[1].pixels[i]);
        const Color variance = pixel_variance(films[0].pixels[i]) + pixel_variance(films[1].pixels[i]);
        for (int c = 0; c < 3; ++c) {
          // As E weighs it, so that a few bright pixels do not decide.
          const double mean = double(pixel_mean(films[0].pixels[i])[c] + pixel_mean(films[1].pixels[i])[c]) / 2;
          seen += double(off[c]) * off[c] / (mean * mean + 0.01);
          said += double(variance[c]) / (mean * mean + 0.01);
        }
      }
      excess.add(seen - said);
      claimed += said;
      found += seen;
    }
    EXPECT_LT(std::abs(difference_deviate(excess, 0.0)), bound)
        << strategy_name(strategy) << ": claimed " << claimed << ", found " << found;
  }
}

TEST(RenderedLayers, AddUpToTheBeauty) {
  SceneSettings settings = scene_settings("linen_plain", 32, 24);
  settings.backdrop = Backdrop::environment;
  const Scene scene = scene_of(settings);
  RenderSettings how = samples(8);
  how.light.bounces = 2;
  Film film(32, 24, true);
  render(scene, how, film);
  double indirect = 0, later = 0, through_gaps = 0;
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    const LayerPixel& l = film.layers[i];
    const Color light =
        l.surface[0] + l.surface[1] + l.volume[0] + l.volume[1] + l.indirect.total() + l.through_gaps + l.backdrop;
    Vec3d beauty(0);
    for (const Vec3d& c : film.pixels[i].beauty) beauty += c;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(light[c]), beauty[c], 1e-5 * (1 + beauty[c])) << i;
    indirect += double(mean_component(l.indirect.bounce[0]));
    later += double(mean_component(l.indirect.bounce[1]));
    EXPECT_EQ(l.indirect.bounce[2], Color(0)) << "two bounces were asked for";
    through_gaps += double(mean_component(l.through_gaps));
    if (l.hits == film.pixels[i].samples) through_gaps += double(mean_component(l.backdrop));
    EXPECT_LE(l.hits, film.pixels[i].samples);
  }
  EXPECT_GT(indirect, later);
  EXPECT_GT(later, 0);
  EXPECT_GT(through_gaps, 0) << "linen has gaps";
}

TEST(RenderedLayers, GeometryIsThatOfTheCloth) {
  SceneSettings settings = scene_settings("ivory_duchess_satin", 48, 32);
  settings.mesh = "sphere";
  settings.level = 3;
  const Scene scene = scene_of(settings);
  Film film(48, 32, true);
  render(scene, samples(4), film);
  int hits = 0;
  for (const LayerPixel& l : film.layers) {
    // Over a silhouette or a seam the means of four samples need not be at right angles.
    if (l.hits != 4 || length(l.normal) < 3.98f || length(l.warp) < 3.98f) continue;
    ++hits;
    // A ball of 0.15 m that stands on the ground.
    const Vec3 position = l.position / 4, normal = normalize(l.normal), warp = normalize(l.warp);
    EXPECT_NEAR(length(position - Vec3(0, 0.15f, 0)), 0.15f, 3e-3f);
    EXPECT_GT(dot(normal, normalize(position - Vec3(0, 0.15f, 0))), 0.999f);
    EXPECT_NEAR(dot(normal, warp), 0, 0.05f);
    EXPECT_GT(max_component(l.albedo), 0.2f);
  }
  EXPECT_GT(hits, 300);
}

TEST(AlbedoMaps, FollowTheAlbedoOfEveryView) {
  const AlbedoMaps maps = map_albedos(satin_scene(), 2);
  for (int row = 0; row < AlbedoMap::cosines; ++row)
    for (int column = 0; column < AlbedoMap::azimuths; column += 5) {
      const float z = (float(row) + 0.5f) / AlbedoMap::cosines, r = std::sqrt(1 - z * z);
      const float angle = 2 * pi * float(column) / AlbedoMap::azimuths;
      const Vec3 wo(r * std::cos(angle), r * std::sin(angle), z);
      const Color expected = albedo_color(satin_scene().front, wo), found = look_up(maps.front, wo);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-2f * expected[c]);
    }
  // Between the nodes a tenth is near enough for a layer; across the seam of the azimuth too.
  for (const float angle : {0.1f, 1.3f, 3.13f, -3.13f, -0.05f}) {
    const Vec3 wo(0.6f * std::cos(angle), 0.6f * std::sin(angle), 0.8f);
    const Color expected = albedo_color(satin_scene().front, wo), found = look_up(maps.front, wo);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.1f * expected[c]) << angle;
  }
  EXPECT_EQ(look_up(AlbedoMap(), Vec3(0, 0, 1)), Color(0));
}

}  // namespace
}  // namespace sateen_test
