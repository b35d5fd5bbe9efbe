#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "image/color.h"
#include "image/image.h"

namespace sateen_test {

struct NamedMap {
  std::string name;
  sateen::Image image;
};

inline sateen::Image make_map(int width, int height, const std::function<sateen::Color(int, int)>& color) {
  sateen::Image map(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = color(x, y)[c];
  return map;
}

/// An OpenEXR map of floats: Y of one channel, R, G, B of three.
void write_map(const std::filesystem::path& path, const sateen::Image& image,
               const sateen::ColorManager::Chromaticities& chromaticities);

/// The torture list of hard-cases.md that fits in memory: every map an artist, a broken exporter or a test may bring.
std::vector<NamedMap> torture_maps();

/// An OpenEXR map of any size in half floats, written a few rows at a time: soft waves and a sun.
void write_banded_exr(const std::filesystem::path& path, int width, int height);

}  // namespace sateen_test
