#pragma once
#include <vector>

#include "math/vector.h"

namespace sateen {

/// Pixels in memory: row-major, top row first, channels interleaved.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;  ///< width * height * channels

  Image() = default;
  Image(int w, int h, int c) : width(w), height(h), channels(c), pixels(size_t(w) * size_t(h) * size_t(c)) {}
  float* at(int x, int y) { return pixels.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels); }
  const float* at(int x, int y) const {
    return pixels.data() + (size_t(y) * size_t(width) + size_t(x)) * size_t(channels);
  }
};

}  // namespace sateen
