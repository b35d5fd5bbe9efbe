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

TEST(SameBits, WhetherAskedForAtOnceOrInTwoParts) {
  Film once(width, height, false), twice(width, height, false);
  RenderSettings settings = quick();
  settings.stop.spp = 12;
  render(sheer_scene(), settings, once);
  settings.stop.spp = 7;
  render(sheer_scene(), settings, twice);
  settings.stop.spp = 5;
  render(sheer_scene(), settings, twice);
  EXPECT_EQ(film_hash(once), film_hash(twice));
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
