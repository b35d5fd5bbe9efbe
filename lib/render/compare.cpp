#include "render/compare.h"

namespace sateen {

GridPicture trace_picture(const Scene& scene, const LightSettings& light, std::uint32_t seed, const PixelGrid& grid,
                          int threads) {
  GridPicture picture;
  picture.grid = grid;
  picture.grid.samples = 0;
  picture.pixels.resize(size_t(grid.pixels()));
  trace_more(picture, scene, light, seed, grid.samples, threads);
  return picture;
}

void trace_more(GridPicture& picture, const Scene& scene, const LightSettings& light, std::uint32_t seed, int samples,
                int threads) {
  PixelGrid more = picture.grid;
  more.first += picture.grid.samples;
  more.samples = samples - picture.grid.samples;
  const GridWork work = trace_grid(scene, light, seed, more, threads, [&](int i, std::span<const CameraSample> all) {
    FilmPixel& pixel = picture.pixels[size_t(i)];
    for (const CameraSample& s : all) add_sample(pixel, s.total(), s.coverage, 0x1p-33);
  });
  picture.grid.samples = samples;
  picture.work.rays.add(work.rays);
  picture.work.hits += work.hits;
  picture.work.cpu_seconds += work.cpu_seconds;
}

std::vector<PixelLoss> differences(const GridPicture& less, const GridPicture& whole) {
  std::vector<PixelLoss> all(less.pixels.size());
  const double share = double(replicates) / less.grid.samples;
  for (size_t i = 0; i < all.size(); ++i) {
    for (size_t r = 0; r < size_t(replicates); ++r)
      all[i].lost[r] = (whole.pixels[i].beauty[r] - less.pixels[i].beauty[r]) * share;
    all[i].value = Vec3d(pixel_mean(whole.pixels[i]));
  }
  return all;
}

double relative_variance(const GridPicture& picture) {
  double sum = 0;
  for (const FilmPixel& pixel : picture.pixels) {
    const Color mean = pixel_mean(pixel);
    const Vec3d variance = pixel_variance(pixel);
    for (int c = 0; c < 3; ++c) sum += double(variance[c]) / (3 * (double(mean[c]) * double(mean[c]) + 0.01));
  }
  return sum / double(picture.pixels.size());
}

Image grid_image(const GridPicture& picture) {
  Image image(picture.grid.columns, picture.grid.rows, 4);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const Color mean = pixel_mean(picture.pixels[i]);
    for (int c = 0; c < 3; ++c) image.pixels[4 * i + size_t(c)] = mean[c];
    image.pixels[4 * i + 3] = float(pixel_coverage(picture.pixels[i]));
  }
  return image;
}

}  // namespace sateen
