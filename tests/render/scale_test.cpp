#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "pictures.h"

using namespace sateen;
using namespace sateen_test;

namespace {

struct Placed {
  double scale = 1;
  Vec3d offset{0, 0, 0};
};

/// A bent sheet on a grid of 2^-7, so that powers of two and offsets up to 2^16 lose nothing.
std::filesystem::path placed_sheet(const Placed& placed) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("sateen_scale_{}_{}.obj", placed.scale, placed.offset.x);
  std::ofstream file(path);
  file.precision(17);
  for (int j = 0; j <= 6; ++j)
    for (int i = 0; i <= 6; ++i) {
      const Vec3d p = Vec3d(i / 4.0 - 0.75, std::round(32 * std::sin(i * 0.9 + j * 0.4)) / 128, j / 4.0 - 0.75);
      const Vec3d q = (p + placed.offset) * placed.scale;
      file << "v " << q.x << ' ' << q.y << ' ' << q.z << "\nvt " << i / 6.0 << ' ' << j / 6.0 << '\n';
    }
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) {
      const int v = 7 * j + i + 1;
      file << fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", v, v + 7, v + 8, v + 1);
    }
  return path;
}

/// With floor, lens and layers: everything that has a length.
Film film_of(const Placed& placed, bool with_stage = true) {
  SceneSettings settings = scene_settings("champagne_silk_satin", 64, 48);
  const std::filesystem::path path = placed_sheet(placed);
  settings.mesh = path.string();
  settings.level = -1;
  settings.uv_metres = 1;
  if (with_stage) {
    GroundSettings ground;
    ground.height = float((placed.offset.y - 1) * placed.scale);
    settings.stage.ground = ground;
    settings.stage.lens = LensSettings{4, std::nullopt, 0, float(0.25 / placed.scale)};
  }
  const Scene scene = scene_of(settings);
  RenderSettings how = samples(4);
  how.light.bounces = 2;
  Film film(settings.width, settings.height, true);
  render(scene, how, film);
  std::filesystem::remove(path);
  return film;
}

std::string pixels_hash(const Film& film) {
  return Hash().add_bytes(film.pixels.data(), film.pixels.size() * sizeof(FilmPixel)).hex();
}

}  // namespace

// No length in the renderer is absolute: a power of two changes exponents alone. The automatic level takes part.
TEST(Scale, ClothAnyPowerOfTwoSmallerOrLargerHasTheSameBits) {
  const Film one = film_of({});
  for (const double scale : {0x1p-50, 0x1p-33, 0x1p-13, 0x1p-7, 0x1p9, 0x1p13, 0x1p43}) {
    const Film other = film_of({scale});
    EXPECT_EQ(pixels_hash(other), pixels_hash(one)) << scale;
    // Positions are told in the author's units.
    for (size_t i = 0; i < one.layers.size(); ++i)
      ASSERT_EQ(other.layers[i].position, one.layers[i].position * float(scale)) << scale << ", pixel " << i;
  }
}

TEST(Scale, OtherFactorsChangeNoMoreThanTheRoundingOfVertices) {
  const Film one = film_of({});
  for (const double scale : {1e-15, 1e-10, 1e-5, 1e5, 1e10, 1e13}) {
    const Film other = film_of({scale});
    double difference = 0, light = 0;
    for (size_t i = 0; i < one.pixels.size(); ++i) {
      for (size_t k = 0; k < replicates; ++k) {
        const Vec3d &a = one.pixels[i].beauty[k], &b = other.pixels[i].beauty[k];
        difference += (a - b).length();
        light += a.length();
      }
    }
    // A speckle of self-shadowing in one of a thousand samples would be 1e-3.
    EXPECT_LT(difference, 3e-4 * light) << scale;
    EXPECT_GT(light, 0);
  }
}

TEST(Scale, ClothFarFromTheOriginHasTheBitsOfClothThatIsNear) {
  // Both are moved to the origin, in double; where they stand shows in their positions alone.
  const Film near = film_of({1, {128, 128, -128}});
  for (const double away : {1024.0, 65536.0}) {
    const Film far = film_of({1, {away, away, -away}});
    EXPECT_EQ(pixels_hash(far), pixels_hash(near)) << away;
    for (size_t i = 0; i < far.layers.size(); ++i) {
      if (far.layers[i].hits == 0) continue;
      const Vec3 mean = far.layers[i].position / float(far.layers[i].hits);
      ASSERT_NEAR(mean.x, away, 1.5);
      ASSERT_NEAR(mean.z, -away, 1.5);
    }
  }
  // And against the same cloth at the origin: the same picture to the rounding of the camera's place.
  const Film origin = film_of({});
  double difference = 0, light = 0;
  for (size_t i = 0; i < origin.pixels.size(); ++i)
    for (size_t k = 0; k < replicates; ++k) {
      difference += (origin.pixels[i].beauty[k] - near.pixels[i].beauty[k]).length();
      light += origin.pixels[i].beauty[k].length();
    }
  EXPECT_LT(difference, 3e-4 * light);
}
