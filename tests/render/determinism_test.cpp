#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "render/pictures.h"

namespace sateen_test {
namespace {

using namespace sateen;

// A sheer look with bounces uses every kind of ray; 100 x 70 pixels are 12 tiles, the last ones cut.
constexpr int width = 100, height = 70;
const Scene& sheer_scene() {
  static const Scene scene = [] {
    SceneSettings settings = scene_settings("linen_plain", width, height);
    settings.backdrop = Backdrop::environment;
    return scene_of(settings);
  }();
  return scene;
}

RenderSettings quick(std::uint32_t seed = 1) {
  RenderSettings settings = samples(5, seed);
  settings.light.bounces = 1;
  return settings;
}

// Many samples of a window over four tiles.
RenderSettings deep() {
  RenderSettings settings = quick();
  settings.crop = {40, 20, 76, 44};
  return settings;
}

std::string rendered(const RenderSettings& settings, bool with_layers = false) {
  Film film(width, height, with_layers);
  const RenderResult result = render(sheer_scene(), settings, film);
  EXPECT_EQ(result.rays.non_finite, 0);
  EXPECT_GT(result.rays.bounce, 0);
  return film_hash(film);
}

TEST(SameBits, ForAnyNumberOfThreads) {
  RenderSettings settings = quick();
  settings.threads = 1;
  const std::string one = rendered(settings), one_with_layers = rendered(settings, true);
  for (const int threads : {2, 3, 8, 1}) {
    settings.threads = threads;
    EXPECT_EQ(rendered(settings), one) << threads << " threads";
  }
  settings.threads = 3;
  EXPECT_EQ(rendered(settings, true), one_with_layers);
}

// Textures are read, tile by tile, by whichever thread comes first.
TEST(SameBits, OfTexturesAndPatternsForAnyNumberOfThreads) {
  for (const char* look : {"printed_silk", "silk_damask"}) {
    std::string one;
    for (const int threads : {1, 2, 3, 8}) {
      const Scene scene = scene_of(scene_settings(look, width, height));  // and a new texture each time
      ASSERT_TRUE(scene.has_maps);
      RenderSettings settings = quick();
      settings.threads = threads;
      Film film(width, height, true);
      EXPECT_EQ(render(scene, settings, film).rays.non_finite, 0);
      if (one.empty()) one = film_hash(film);
      EXPECT_EQ(film_hash(film), one) << look << ", " << threads << " threads";
    }
  }
}

// A ray tracer that is alive bounds the threads of render() to the processors: here the callers are eight.
TEST(SameBits, ForEightCallersAtOnce) {
  Film whole(width, height, false);
  render(sheer_scene(), quick(), whole);
  std::vector<Film> parts(8, Film(width, height, false));
  std::vector<std::thread> callers;
  for (int k = 0; k < 8; ++k)
    callers.emplace_back([&, k] {
      RenderSettings settings = quick();
      settings.threads = 1;
      settings.crop = {0, k * height / 8, width, (k + 1) * height / 8};
      render(sheer_scene(), settings, parts[size_t(k)]);
    });
  for (std::thread& caller : callers) caller.join();
  Film stitched(width, height, false);
  for (const Film& part : parts)
    for (size_t i = 0; i < part.pixels.size(); ++i)
      if (part.pixels[i].samples > 0) stitched.pixels[i] = part.pixels[i];
  EXPECT_EQ(film_hash(stitched), film_hash(whole));
}

TEST(SameBits, DifferForAnotherSeed) {
  EXPECT_NE(rendered(quick(1)), rendered(quick(2)));
}

TEST(SameBits, ForWindowsThatAreStitched) {
  Film whole(width, height, false), stitched(width, height, false);
  render(sheer_scene(), quick(), whole);
  // Edges that are no tiles', one window of a single pixel, one that reaches beyond the picture.
  const Crop windows[] = {{0, 0, 37, 41}, {37, 0, 100, 41}, {0, 41, 1, 42}, {1, 41, 100, 42}, {0, 42, 400, 300}};
  for (const Crop& window : windows) {
    RenderSettings settings = quick();
    settings.crop = window;
    Film part(width, height, false);
    render(sheer_scene(), settings, part);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const size_t i = size_t(y * width + x);
        const bool inside = x >= window.x0 && x < window.x1 && y >= window.y0 && y < window.y1;
        EXPECT_EQ(part.pixels[i].samples, inside ? 5u : 0u);
        if (inside) stitched.pixels[i] = part.pixels[i];
      }
  }
  EXPECT_EQ(film_hash(stitched), film_hash(whole));
}

// Stopped by samples, by an error and by a signal in the middle of a pass, gone on with each time, on other numbers
// of threads: the same bits as a render that was never stopped. With samples dealt out by error and without.
TEST(SameBits, HoweverOftenStoppedAndGoneOnWith) {
  for (const bool adaptive : {false, true}) {
    RenderSettings settings = deep();
    settings.adaptive = adaptive;
    settings.stop.spp = 64;
    Film once(width, height, true), often(width, height, true);
    EXPECT_EQ(render(sheer_scene(), settings, once).samples, 64);

    Course course;
    settings.threads = 1;
    settings.stop.spp = 7;
    EXPECT_EQ(render(sheer_scene(), settings, often, course, {}).reason, StopReason::samples);
    settings.threads = 3;
    settings.stop.spp = 64;
    settings.stop.error = 3.0;
    EXPECT_EQ(render(sheer_scene(), settings, often, course, {}).reason, StopReason::error);
    settings.stop.error = 0;
    std::atomic<bool> stop = false;
    RenderHooks hooks;
    hooks.interrupt = &stop;
    int calls = 0;
    hooks.observe = [&](const RenderState& state) { stop = state.samples >= 32 && ++calls >= 2; };
    EXPECT_EQ(render(sheer_scene(), settings, often, course, hooks).reason, StopReason::interrupted);
    EXPECT_LT(course.samples, 64);
    settings.threads = 2;
    EXPECT_EQ(render(sheer_scene(), settings, often, course, {}).samples, 64);
    EXPECT_EQ(film_hash(once), film_hash(often)) << (adaptive ? "adaptive" : "uniform");
  }
}

TEST(SameBits, AdaptiveForAnyNumberOfThreads) {
  RenderSettings settings = deep();
  settings.adaptive = true;
  settings.stop.spp = 48;
  settings.threads = 1;
  const std::string one = rendered(settings);
  settings.threads = 3;
  EXPECT_EQ(rendered(settings), one);
  settings.adaptive = false;
  EXPECT_NE(rendered(settings), one);
}

TEST(SameBits, WhetherOrNotAPictureIsAskedForOnTheWay) {
  RenderSettings settings = deep();
  settings.stop.spp = 48;
  Film plain(width, height, false), watched(width, height, false);
  render(sheer_scene(), settings, plain);
  std::atomic<bool> wanted = true;
  int shown = 0;
  RenderHooks hooks;
  hooks.snapshot_wanted = &wanted;
  hooks.snapshot = [&](const RenderResult&, bool asked) {
    EXPECT_TRUE(asked);
    ++shown;
  };
  hooks.observe = [&](const RenderState& state) {
    if (state.samples == 16 && shown == 1) wanted = true;
  };
  Course course;
  render(sheer_scene(), settings, watched, course, hooks);
  EXPECT_EQ(shown, 2);
  EXPECT_EQ(film_hash(plain), film_hash(watched));
}

TEST(SameBits, OfRangesOfSamplesThatAreAddedUp) {
  Film whole(width, height, false), sum(width, height, false);
  RenderSettings settings = deep();
  settings.stop.spp = 40;
  render(sheer_scene(), settings, whole);
  for (const auto& [first, count] : {std::pair(24, 16), std::pair(0, 8), std::pair(8, 16)}) {
    Film part(width, height, false);
    part.first_sample = std::uint32_t(first);
    settings.stop.spp = count;
    render(sheer_scene(), settings, part);
    add_film(sum, part);
  }
  EXPECT_EQ(film_hash(whole), film_hash(sum));
}

TEST(SameBits, WithLayersAndWithout) {
  Film with(width, height, true), without(width, height, false);
  render(sheer_scene(), quick(), with);
  render(sheer_scene(), quick(), without);
  with.layers.clear();
  EXPECT_EQ(film_hash(with), film_hash(without));
}

}  // namespace
}  // namespace sateen_test
