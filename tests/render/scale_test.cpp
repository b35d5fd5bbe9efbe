#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mesh/shapes.h"
#include "pictures.h"

using namespace sateen;
using namespace sateen_test;

namespace {

std::filesystem::path scaled_swatch(float scale) {
  const ControlMesh cage = built_in_shape("swatch");
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("sateen_scale_" + std::to_string(scale) + ".obj");
  std::ofstream file(path);
  file.precision(9);
  for (const Vec3& p : cage.positions)
    file << "v " << p.x * scale << ' ' << p.y * scale << ' ' << p.z * scale << '\n';
  for (const Vec2& uv : cage.uvs) file << "vt " << uv.x << ' ' << uv.y << '\n';
  size_t at = 0;
  for (const int size : cage.face_sizes) {
    file << 'f';
    for (int k = 0; k < size; ++k, ++at)
      file << ' ' << cage.position_indices[at] + 1 << '/' << cage.uv_indices[at] + 1;
    file << '\n';
  }
  return path;
}

Film film_of(float scale) {
  SceneSettings settings = scene_settings("champagne_silk_satin", 64, 48);
  const std::filesystem::path path = scaled_swatch(scale);
  settings.mesh = path.string();
  settings.level = -1;
  settings.uv_metres = 1;
  const Scene scene = scene_of(settings);
  RenderSettings how = samples(4);
  how.light.bounces = 2;
  Film film(settings.width, settings.height, false);
  render(scene, how, film);
  std::filesystem::remove(path);
  return film;
}

}  // namespace

// No length in the renderer is absolute: a power of two changes exponents alone. The automatic level takes part.
TEST(Scale, ClothAThousandTimesSmallerOrLargerHasTheSameBits) {
  const Film one = film_of(1);
  for (const float scale : {0x1p-13f, 0x1p13f}) EXPECT_EQ(film_hash(film_of(scale)), film_hash(one)) << scale;
}

TEST(Scale, OtherFactorsChangeNoMoreThanTheRoundingOfVertices) {
  const Film one = film_of(1);
  for (const float scale : {1e-4f, 1e4f}) {
    const Film other = film_of(scale);
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
