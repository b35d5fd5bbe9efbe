#include "image/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <thread>

namespace sateen {
namespace {

Image noise(int width, int height, int channels) {
  Image image(width, height, channels);
  std::uint32_t state = 7;
  for (float& value : image.pixels) {
    state = state * 1664525u + 1013904223u;
    value = float(state >> 8) * 0x1p-24f;
  }
  return image;
}

double mean(const Image& image, int channel) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += double(image.at(x, y)[channel]);
  return sum / image.width / image.height;
}

TEST(Texture, HalvingKeepsTheMeanOfAnySize) {
  for (const auto& [width, height] : {std::pair(64, 64), {63, 5}, {7, 1}, {1, 9}, {3, 3}, {131, 67}}) {
    Image image = noise(width, height, 2);
    const double expected[2] = {mean(image, 0), mean(image, 1)};
    while (image.width > 1 || image.height > 1) {
      image = halve_image(image);
      for (int c = 0; c < 2; ++c) EXPECT_NEAR(mean(image, c), expected[c], 2e-6) << width << " x " << height;
    }
  }
}

TEST(Texture, OfAWideAreaIsTheMean) {
  for (const auto& [width, height] : {std::pair(64, 64), {200, 30}, {17, 131}}) {
    const Image image = noise(width, height, 3);
    const Texture texture(image, TextureWrap::repeat, false);
    float found[3];
    texture.look_up({Vec2(0.3f, 0.8f), Vec2(4, 0), Vec2(0, 4)}, found);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], mean(image, c), 1e-5) << width << " x " << height;
  }
}

TEST(Texture, OfAnAreaInBetweenComesNearTheMeanThere) {
  // A cosine of 4 periods: over one period nothing of it is left, over a 32nd nearly all.
  Image image(256, 256, 1);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) *image.at(x, y) = 0.5f + 0.5f * std::cos(2 * pi * 4 * (float(x) + 0.5f) / 256);
  const Texture texture(image, TextureWrap::repeat, false);
  float wide = 0, narrow = 0, slanted = 0;
  texture.look_up({Vec2(0.5f, 0.5f), Vec2(0.25f, 0), Vec2(0, 0.25f)}, &wide);
  texture.look_up({Vec2(0.5f, 0.5f), Vec2(1 / 128.0f, 0), Vec2(0, 1 / 128.0f)}, &narrow);
  texture.look_up({Vec2(0.5f, 0.5f), Vec2(1 / 128.0f, 0), Vec2(0, 0.1f)}, &slanted);
  EXPECT_NEAR(wide, 0.5f, 0.12f);
  EXPECT_GT(narrow, 0.98f);
  EXPECT_GT(slanted, 0.95f) << "an area that is long along the stripes must not blur across them";
}

TEST(Texture, HasItsPixelsWhereTheyBelong) {
  // Top row 1 2, bottom row 3 4: v runs up.
  Image image(2, 2, 1);
  image.pixels = {1, 2, 3, 4};
  const Texture texture(image, TextureWrap::clamp, false);
  const auto at = [&](float u, float v) {
    float value = 0;
    texture.look_up({Vec2(u, v)}, &value);
    return value;
  };
  EXPECT_FLOAT_EQ(at(0.25f, 0.75f), 1);
  EXPECT_FLOAT_EQ(at(0.75f, 0.75f), 2);
  EXPECT_FLOAT_EQ(at(0.25f, 0.25f), 3);
  EXPECT_FLOAT_EQ(at(0.75f, 0.25f), 4);
  EXPECT_FLOAT_EQ(at(0.5f, 0.5f), 2.5f);
}

TEST(Texture, WrapsAsAsked) {
  Image image(4, 1, 1);
  image.pixels = {0, 1, 2, 3};
  const auto at = [&](TextureWrap wrap, float u) {
    float value = 0;
    Texture(image, wrap, false).look_up({Vec2(u, 0.5f)}, &value);
    return value;
  };
  EXPECT_FLOAT_EQ(at(TextureWrap::repeat, 1.375f), 1);
  EXPECT_FLOAT_EQ(at(TextureWrap::clamp, 1.375f), 3);
  EXPECT_FLOAT_EQ(at(TextureWrap::mirror, 1.375f), 2);
  EXPECT_FLOAT_EQ(at(TextureWrap::repeat, -0.125f), 3);
  EXPECT_FLOAT_EQ(at(TextureWrap::clamp, -3), 0);
}

TEST(Texture, HasTheSameBitsOnAnyThreadAndInAnyOrder) {
  const Image image = noise(300, 200, 3);
  const Texture texture(image, TextureWrap::repeat, true);
  constexpr int count = 4096;
  const auto point = [](int i) {
    const float a = float(i) * 0.618034f, b = float(i) * 0.754878f, size = std::exp2(-float(i % 11));
    return TexturePoint{Vec2(a, b), Vec2(size, 0.3f * size), Vec2(-0.1f * size, size * 0.05f)};
  };
  std::vector<Color> forward(count), again(count);
  for (int i = 0; i < count; ++i) texture.look_up(point(i), &forward[size_t(i)].x);
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      for (int i = count - 1 - t; i >= 0; i -= 3) texture.look_up(point(i), &again[size_t(i)].x);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::memcmp(forward.data(), again.data(), count * sizeof(Color)), 0);
  const Texture twin(image, TextureWrap::repeat, true);
  for (int i = 0; i < count; ++i) twin.look_up(point(i), &again[size_t(i)].x);
  EXPECT_EQ(std::memcmp(forward.data(), again.data(), count * sizeof(Color)), 0);
}

}  // namespace
}  // namespace sateen
