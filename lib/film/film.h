#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "image/image.h"
#include "math/vector.h"

namespace sateen {

/// Independent randomised replicates of the picture: sample i of a pixel belongs to replicate i mod this. Their
/// scatter is the error; more of them estimate it better and cost some of the low-discrepancy sequence's gain.
inline constexpr int replicates = 4;

/// Sums of one pixel. A pixel owns its sums and its sample sequence, so bits do not depend on who computes.
struct FilmPixel {
  std::array<Color, replicates> beauty{Color(0), Color(0), Color(0), Color(0)};
  float alpha = 0;
  std::uint32_t samples = 0;
};

/// Sums of the layers beside the beauty; kept only where asked for.
struct LayerPixel {
  Color surface[2] = {Color(0), Color(0)}, volume[2] = {Color(0), Color(0)}, indirect{0, 0, 0}, backdrop{0, 0, 0};
  Color albedo{0, 0, 0};
  Vec3 normal{0, 0, 0}, position{0, 0, 0}, warp{0, 0, 0};
  Vec2 uv{0, 0};
  std::uint32_t hits = 0;  ///< samples that met cloth: what the geometric layers are averaged over
};

struct Film {
  int width = 0, height = 0;
  std::vector<FilmPixel> pixels;
  std::vector<LayerPixel> layers;  ///< empty, or one a pixel

  Film(int w, int h, bool with_layers)
      : width(w), height(h), pixels(size_t(w) * size_t(h)), layers(with_layers ? pixels.size() : 0) {}
};

/// Mean of all samples of a pixel; black where it has none.
Color pixel_mean(const FilmPixel& pixel);

/// Variance of that mean in every channel, from the scatter of the replicates; 0 while fewer than two have samples.
Color pixel_variance(const FilmPixel& pixel);

/// Error of a picture: E = sqrt(mean over pixels and channels of variance / (value^2 + 0.01)), values at exposure 0,
/// and the ends of its 95 % interval from the scatter over blocks of pixels. Pixels with fewer than 2 samples do not
/// count; `known` is false where there are no others.
struct PictureError {
  bool known = false;
  double error = 0, low = 0, high = 0;
};
PictureError picture_error(const Film& film);

}  // namespace sateen
