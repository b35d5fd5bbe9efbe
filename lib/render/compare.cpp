#include "render/compare.h"

#include <algorithm>

namespace sateen {

GridPicture blank_picture(const Scene& scene, const PixelGrid& grid) {
  return {grid, std::vector<FilmPixel>(size_t(grid.pixels())), scene.backdrop != Backdrop::none, {}};
}

GridPicture trace_picture(const Scene& scene, const LightSettings& light, std::uint32_t seed, const PixelGrid& grid,
                          int threads) {
  GridPicture picture = blank_picture(scene, grid);
  picture.grid.samples = 0;
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
    for (const CameraSample& s : all) add_sample(pixel, s.total(), s.coverage, no_grain);
  });
  picture.grid.samples = samples;
  picture.work.rays.add(work.rays);
  picture.work.hits += work.hits;
  picture.work.cpu_seconds += work.cpu_seconds;
}

std::vector<PixelLoss> differences(const GridPicture& less, const GridPicture& whole, double error_floor) {
  std::vector<PixelLoss> all(less.pixels.size());
  const double share = double(replicates) / less.grid.samples;
  const double card = whole.opaque ? 0 : mid_grey_of(error_floor);
  for (size_t i = 0; i < all.size(); ++i) {
    const double alpha = pixel_coverage(whole.pixels[i]), less_alpha = pixel_coverage(less.pixels[i]);
    for (size_t r = 0; r < size_t(replicates); ++r)
      all[i].lost[r] =
          (whole.pixels[i].beauty[r] - less.pixels[i].beauty[r]) * share + Vec3d((less_alpha - alpha) * card);
    all[i].value = Vec3d(pixel_mean(whole.pixels[i]));
    all[i].weight = std::clamp(std::max(alpha, less_alpha), 0.0, 1.0);
  }
  return all;
}

double relative_variance(const GridPicture& picture, double error_floor) {
  return relative_variance(picture, {&picture, 1}, error_floor);
}

double relative_variance(const GridPicture& picture, std::span<const GridPicture> judges, double error_floor) {
  double sum = 0, weights = 0;
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    double coverage = 0;
    Vec3d value(0);
    for (const GridPicture& judge : judges) {
      coverage += pixel_coverage(judge.pixels[i]) / double(judges.size());
      value += Vec3d(pixel_mean(judge.pixels[i])) / double(judges.size());
    }
    sum += coverage * relative_square(pixel_variance(picture.pixels[i]), value, error_floor);
    weights += coverage;
  }
  return weights > 0 ? sum / weights : 0;
}

Image grid_image(const GridPicture& picture) {
  Image image(picture.grid.columns, picture.grid.rows, 4);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    const Color mean = pixel_mean(picture.pixels[i]);
    for (int c = 0; c < 3; ++c) image.pixels[4 * i + size_t(c)] = mean[c];
    image.pixels[4 * i + 3] = picture.opaque ? 1 : float(pixel_coverage(picture.pixels[i]));
  }
  return image;
}

}  // namespace sateen
