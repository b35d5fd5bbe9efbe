#include "render/memory.h"

#include <algorithm>

#include "film/film.h"
#include "image/bands.h"
#include "integrator/direct.h"
#include "render/picture.h"

namespace sateen {

namespace {

/// While samples are dealt out and the error is looked at: variances of all pixels, pooled ones, and what is sorted
/// of them (film/error.cpp, render/allocation.cpp), as measured.
constexpr std::int64_t looking_per_pixel = 90;

std::int64_t writing_bytes(const PictureSize& size) {
  std::int64_t bytes = 0;
  for (const std::string& output : size.outputs) {
    if (is_exr(output)) {
      // As developed and as rounded, then as meant and as read back, and what is being packed.
      const std::int64_t row = size.exr_channels * size.width * std::int64_t(sizeof(float));
      bytes += 3 * row * std::min<std::int64_t>(exr_band_rows(row, size.threads), size.height);
    } else {
      // Beauty, cloth on the display, with its ground, and its codes twice.
      const std::int64_t row = 4 * size.width * std::int64_t(sizeof(float));
      bytes += 4 * row * std::min<std::int64_t>(band_rows(row), size.height);
    }
  }
  return bytes;
}

}  // namespace

std::int64_t film_bytes(const PictureSize& size) {
  return size.width * size.height * std::int64_t(sizeof(FilmPixel) + (size.layers ? sizeof(LayerPixel) : 0));
}

std::int64_t picture_bytes(const PictureSize& size) {
  const std::int64_t pixels = size.width * size.height;
  const std::int64_t targets = pixels * std::int64_t(sizeof(std::uint32_t));
  const std::int64_t overlay = size.references ? pixels * 4 * std::int64_t(sizeof(float)) : 0;
  const std::int64_t scratch = size.threads * std::int64_t(sizeof(PathScratch));
  return film_bytes(size) + targets + overlay + scratch + std::max(pixels * looking_per_pixel, writing_bytes(size));
}

}  // namespace sateen
