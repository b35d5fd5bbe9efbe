#include "maps.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <cmath>
#include <limits>
#include <random>

#include "image/file.h"

namespace sateen_test {

using sateen::Color;
using sateen::Image;

void write_map(const std::filesystem::path& path, const Image& image,
               const sateen::ColorManager::Chromaticities& chromaticities) {
  sateen::ImageLayer layer;
  layer.channels = image.channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  layer.image = image;
  sateen::write_exr(path, {layer}, {}, chromaticities);
}

std::vector<NamedMap> torture_maps() {
  std::vector<NamedMap> maps;
  const auto add = [&](const char* name, int width, int height, const std::function<Color(int, int)>& color) {
    maps.push_back({name, make_map(width, height, color)});
  };
  const auto lit = [&](const char* name, int width, int height, int lx, int ly, float value, float rest = 0) {
    add(name, width, height,
        [=](int x, int y) { return x == lx && y == ly ? Color(value, value, value) : Color(rest, rest, rest); });
  };
  const auto noise = [](int x, int y) {
    std::mt19937 random(unsigned(x * 7919 + y * 104729));
    const auto r = [&] { return std::pow(float(random() % 10000) / 10000, 4.0f); };
    return Color(r(), r(), r());
  };
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  add("1x1", 1, 1, [](int, int) { return Color(0.5f, 1, 2); });
  add("1xN", 1, 37, noise);
  add("Nx1", 41, 1, noise);
  add("2x1", 2, 1, [](int x, int) { return Color(float(x), 1, 0); });
  add("odd sizes", 33, 17, noise);
  add("tall", 8, 64, noise);
  add("constant", 64, 32, [](int, int) { return Color(1, 1, 1); });
  add("constant in one channel", 16, 8, [](int, int) { return Color(0, 0, 3); });
  add("black", 32, 16, [](int, int) { return Color(0, 0, 0); });
  add("black rows", 32, 16, [&](int x, int y) { return y % 3 ? Color(0, 0, 0) : noise(x, y); });
  add("black columns", 32, 16, [&](int x, int y) { return x % 5 ? Color(0, 0, 0) : noise(x, y); });
  add("black lower half", 64, 32, [&](int x, int y) { return y >= 16 ? Color(0, 0, 0) : noise(x, y); });
  lit("north pole", 64, 32, 5, 0, 1);
  lit("south pole", 64, 32, 60, 31, 1);
  lit("left of the seam", 64, 32, 63, 16, 1);
  lit("right of the seam", 64, 32, 0, 16, 1);
  lit("middle", 64, 32, 32, 16, 1);
  add("two suns across the seam", 64, 32, [](int x, int y) {
    return (x == 0 || x == 63) && y == 12 ? Color(1e4f, 9e3f, 8e3f) : Color(0.1f, 0.1f, 0.2f);
  });
  lit("sun of 1e6", 128, 64, 40, 20, 1e6f, 0.3f);
  lit("sun of 1e9", 128, 64, 40, 20, 1e9f, 0.3f);
  lit("sun of 1e30", 128, 64, 40, 20, 1e30f, 0.3f);
  lit("sun of the largest float", 16, 8, 4, 2, std::numeric_limits<float>::max(), 0.3f);
  lit("one infinite", 32, 16, 3, 3, inf, 0.5f);
  lit("all infinite but black", 32, 16, 3, 3, inf);
  lit("one not a number", 32, 16, 3, 3, nan, 0.5f);
  lit("all not a number", 4, 2, 0, 0, nan, nan);
  lit("one negative", 32, 16, 3, 3, -5, 0.5f);
  lit("all negative", 32, 16, 3, 3, -5, -1);
  lit("minus infinity", 32, 16, 3, 3, -inf, 0.5f);
  add("spike in one channel", 32, 16,
      [](int x, int y) { return x == 9 && y == 4 ? Color(0.1f, 0.2f, 1e4f) : Color(0.1f, 0.2f, 0.2f); });
  add("denormals", 32, 16, [](int x, int) { return Color(1e-40f, 2e-41f, x % 2 ? 1e-39f : 0.0f); });
  lit("denormals and a light", 32, 16, 7, 7, 1, 1e-40f);
  add("smallest floats", 16, 8, [](int, int) { return Color(1.2e-38f, 1.2e-38f, 2e-38f); });
  add("noise", 128, 64, noise);
  return maps;
}

void write_banded_exr(const std::filesystem::path& path, int width, int height) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::HALF));
  Imf::OutputFile file(path.c_str(), header);
  std::vector<Imath::half> row(size_t(3 * width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool sun = std::hypot(float(x - width / 3), float(y - height / 4)) < float(width) / 700;
      for (int c = 0; c < 3; ++c)
        row[size_t(3 * x + c)] = Imath::half(
            sun ? 20000.0f : 0.5f + 0.25f * std::sin(float(x * (c + 1)) * 0.01f) + float(y) / float(4 * height));
    }
    Imf::FrameBuffer frame;
    const char* names[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c)
      frame.insert(names[c],
                   Imf::Slice(Imf::HALF, reinterpret_cast<char*>(row.data() + c), 3 * sizeof(Imath::half), 0));
    file.setFrameBuffer(frame);
    file.writePixels(1);
  }
}

}  // namespace sateen_test
