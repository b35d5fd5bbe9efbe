#include "render/render.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/develop.h"
#include "render/albedo_map.h"
#include "render/pictures.h"
#include "scene/mapped_looks.h"
#include "scene/near_weave.h"
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

// 24 lies between the barriers 16 and 32: pixels on the way to their targets have a few more in the mean.
TEST(StopRules, SamplesThatAreDealtOutCountAsTheyWereAskedFor) {
  RenderSettings settings = samples(24);
  settings.adaptive = true;
  Film film(48, 27, false);
  const RenderResult result = render(scene_of(scene_settings("champagne_silk_satin", 48, 27)), settings, film);
  EXPECT_EQ(result.reason, StopReason::samples);
  EXPECT_EQ(result.samples, 24);
  std::uint64_t all = 0;
  for (const FilmPixel& pixel : film.pixels) all += pixel.samples;
  EXPECT_GT(all, 24 * film.pixels.size());
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
  EXPECT_GE(result.samples, 8);
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
        const Vec3d variance = pixel_variance(films[0].pixels[i]) + pixel_variance(films[1].pixels[i]);
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
  const auto seen = [&](const Vec3& wo) {
    CameraSample sample;
    sample.fabric = &satin_scene().front;
    sample.A = satin_scene().front.A;
    sample.wo = wo;
    return sample_albedo(maps, sample);
  };
  for (int row = 0; row < AlbedoMap::cosines; ++row)
    for (int column = 0; column < AlbedoMap::azimuths; column += 5) {
      const float z = (float(row) + 0.5f) / AlbedoMap::cosines, r = std::sqrt(1 - z * z);
      const float angle = 2 * pi * float(column) / AlbedoMap::azimuths;
      const Vec3 wo(r * std::cos(angle), r * std::sin(angle), z);
      const Color expected = albedo_color(satin_scene().front, wo), found = seen(wo);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-2f * expected[c]);
    }
  // Between the nodes a tenth is near enough for a layer; across the seam of the azimuth too.
  for (const float angle : {0.1f, 1.3f, 3.13f, -3.13f, -0.05f}) {
    const Vec3 wo(0.6f * std::cos(angle), 0.6f * std::sin(angle), 0.8f);
    const Color expected = albedo_color(satin_scene().front, wo), found = seen(wo);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.1f * expected[c]) << angle;
  }
  EXPECT_EQ(sample_albedo({}, CameraSample()), Color(0));
}

/// The swatch, one UV unit a metre, of a look with textures.
Scene flat_scene(CompiledSide side) {
  SceneSettings settings = scene_settings("ivory_duchess_satin", 32, 32);
  settings.mesh = "swatch";
  settings.camera.elevation_deg = 60;
  Scene scene = scene_of(settings);
  set_sides(scene, std::move(side), std::nullopt);
  return scene;
}

/// Samples of the whole picture that met cloth.
std::vector<CameraSample> seen_samples(const Scene& scene) {
  const auto scratch = std::make_unique<PathScratch>();
  std::vector<CameraSample> seen;
  for (int i = 0; i < 32 * 32 * 4; ++i) {
    const CameraSample s = trace_sample(scene, {Strategy::table, 1, 0}, 3, {i / 4 % 32, i / 128, i % 4, 0}, *scratch);
    if (s.hit) seen.push_back(s);
  }
  return seen;
}

TEST(AlbedoLayer, ShowsTheColourAndTheCoverageOfThePoint) {
  const MappedLooks made;
  made.texture("halves.exr", 64, 64,
               [](int x, int) { return x < 32 ? Color(0.1f, 0.5f, 0.9f) : Color(0.7f, 0.3f, 0.2f); });
  const char* const look = R"({{"color_space": "lin_rec709",
    "warp": {{"A": {}, "coverage": {}, "gamma_s_deg": 20}}, "weft": {{"A": {}, "coverage": 0.4, "gamma_s_deg": 25}}}})";
  const std::string map = R"({"texture": "halves.exr", "space": "lin_rec709", "repeat_cm": [10, 10]})",
                    cover = R"({"texture": "halves.exr", "scale": 0.5, "repeat_cm": [10, 10]})";
  const Scene scene = flat_scene(made.compiled(fmt::format(fmt::runtime(look), map, cover, map)));
  const AlbedoMaps maps = map_albedos(scene, 2);
  const Fabric expected[2] = {
      made.compiled(fmt::format(fmt::runtime(look), "[0.1, 0.5, 0.9]", "0.05", "[0.1, 0.5, 0.9]"), false).fabric,
      made.compiled(fmt::format(fmt::runtime(look), "[0.7, 0.3, 0.2]", "0.35", "[0.7, 0.3, 0.2]"), false).fabric};
  int compared[2] = {0, 0};
  const std::vector<CameraSample> seen = seen_samples(scene);
  for (size_t i = 0; i < seen.size(); i += 4) {
    const CameraSample& s = seen[i];
    if (s.wo.z < 0.3f) continue;  // where the table's nodes are too far apart for the bar below
    const float u = s.uv.x * 10 - std::floor(s.uv.x * 10);
    if (std::abs(u - 0.25f) > 0.07f && std::abs(u - 0.75f) > 0.07f) continue;  // what a pixel filters of the edges
    const size_t half = u < 0.5f ? 0 : 1;
    const Color here = sample_albedo(maps, s), there = albedo_color(expected[half], s.wo, 72);
    // The nodes of the table are a tenth apart, and so is Q of the thinner threads from their mean's.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(here[c], there[c], 0.12f * there[c] + 0.01f);
    ++compared[half];
  }
  EXPECT_GT(compared[0], 10);
  EXPECT_GT(compared[1], 10);
}

TEST(AlbedoLayer, ShowsTheYarnsFromNearWithTheirMeanFromAfar) {
  const MappedLooks made;
  Scene scene = flat_scene(made.compiled(R"({"color_space": "lin_rec709",
    "warp": {"A": [0.9, 0.3, 0.1], "coverage": 0.4}, "weft": {"A": [0.1, 0.2, 0.8], "coverage": 0.4},
    "weave": {"draft": "plain", "warp_per_cm": 8, "weft_per_cm": 8}})"));
  const AlbedoMaps maps = map_albedos(scene, 2);
  const auto look = [&](float near) {
    scene.near_weave_pixel = near;
    Color mean(0);
    float reddest = 0;
    const std::vector<CameraSample> seen = seen_samples(scene);
    for (const CameraSample& s : seen) {
      const Color a = sample_albedo(maps, s);
      mean += a / float(seen.size());
      reddest = std::max(reddest, a.x / std::max(a.z, 1e-3f));
    }
    return std::pair(mean, reddest);
  };
  scene.camera.tan_x *= 0.03f;  // seven yarns across the picture
  scene.camera.tan_y *= 0.03f;
  const auto [far, far_red] = look(0);
  const auto [near, near_red] = look(near_weave_pixel(scene));
  // Seven yarns each way, the outer ones cut off.
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(near[c] / far[c], 1, 0.1f);
  EXPECT_GT(near_red, 1.7f * far_red) << "the warp alone";
}

}  // namespace
}  // namespace sateen_test
