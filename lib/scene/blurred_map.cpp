#include "scene/blurred_map.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "scene/environment_texel.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;

// Weights below this share of the kernel's middle are left out: together less than a thousandth.
constexpr double least_weight = 1e-4;

/// Overlap of cell `i` of `coarse` with the texels of `fine`, in texels: first, last, and the shares of both.
struct Overlap {
  double from, to;
  int first, last;
  double share(int x) const { return std::min(to, x + 1.0) - std::max(from, double(x)); }
};
Overlap overlap(int i, int coarse, int fine) {
  Overlap o{};
  o.from = double(i) * fine / coarse;
  o.to = double(i + 1) * fine / coarse;
  o.first = int(o.from);
  o.last = std::min(int(std::ceil(o.to)), fine) - 1;
  return o;
}
}  // namespace

Image average_environment(const Environment& e, int width) {
  Image out(width, std::max(width / 2, 1), 3);
  for (int y = 0; y < out.height; ++y) {
    const Overlap rows = overlap(y, out.height, e.height);
    for (int x = 0; x < width; ++x) {
      const Overlap columns = overlap(x, width, e.width);
      Vec3d sum(0);
      double weights = 0;
      for (int row = rows.first; row <= rows.last; ++row)
        for (int column = columns.first; column <= columns.last; ++column) {
          const double weight = rows.share(row) * columns.share(column) * environment_row_weight(row, e.height);
          sum += Vec3d(e.radiance_at(column, row)) * weight;
          weights += weight;
        }
      for (int c = 0; c < 3; ++c) out.at(x, y)[c] = float(sum[c] / weights);
    }
  }
  return out;
}

BlurredMap blur_environment(const Environment& e, float width_deg, int threads) {
  const double half = double(width_deg) * pi_d / 360, sharpness = std::log(2.0) / (1 - std::cos(half));
  const int width = std::clamp(int(std::lround(8 * 360 / double(width_deg))) / 2 * 2, 32, 1024), height = width / 2;
  const Image map = average_environment(e, width);
  // exp(sharpness (cos - 1)) falls to the least weight here.
  const double furthest = std::acos(std::max(1 + std::log(least_weight) / sharpness, -1.0));
  BlurredMap blurred;
  blurred.radiance = Image(width, height, 3);
  std::vector<double> cosines;
  for (int dx = 0; dx < width; ++dx) cosines.push_back(std::cos(2 * pi_d * dx / width));
  parallel_for(height, threads, [&](int y) {
    const double here = pi_d * (y + 0.5) / height;
    std::vector<Vec3d> sums(size_t(width), Vec3d(0));
    std::vector<double> kernel;
    double weights = 0;
    for (int row = 0; row < height; ++row) {
      const double there = pi_d * (row + 0.5) / height;
      if (std::abs(there - here) > furthest) continue;
      const double upright = std::cos(here) * std::cos(there), level = std::sin(here) * std::sin(there);
      // One row of kernel serves every column.
      kernel.clear();
      for (int dx = 0; dx <= width / 2; ++dx) {
        const double weight = std::exp(sharpness * (upright + level * cosines[size_t(dx)] - 1));
        if (dx > 0 && weight < least_weight) break;
        kernel.push_back(weight * environment_row_weight(row, height));
      }
      const int reach = int(kernel.size()) - 1;
      for (int x = 0; x < width; ++x)
        for (int dx = -reach; dx <= reach; ++dx) {
          // Half a turn away both ways meet.
          if (2 * dx == -width) continue;
          const float* from = map.at((x + dx + width) % width, row);
          sums[size_t(x)] += Vec3d(double(from[0]), double(from[1]), double(from[2])) * kernel[size_t(std::abs(dx))];
        }
      for (int dx = -reach; dx <= reach; ++dx) weights += 2 * dx == -width ? 0 : kernel[size_t(std::abs(dx))];
    }
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) blurred.radiance.at(x, y)[c] = float(sums[size_t(x)][c] / weights);
  });
  return blurred;
}

Color blurred_radiance(const BlurredMap& blurred, const Environment& e, const Vec3& direction) {
  const Image& map = blurred.radiance;
  const MapPlace place = environment_place(e, direction);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return Color(0);
  const double x = place.x / e.width * map.width - 0.5, y = place.y / e.height * map.height - 0.5;
  const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
  const auto weights = [](float t) {
    const float s = 1 - t;
    return std::array{s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * s * s + 3 * s * s * s) / 6,
                      t * t * t / 6};
  };
  const auto across = weights(float(x - x0)), down = weights(float(y - y0));
  Color sum(0);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      // Over a pole the row goes on half a turn away.
      int row = y0 - 1 + j, column = x0 - 1 + i;
      if (row < 0 || row >= map.height) column += map.width / 2;
      row = row < 0 ? -1 - row : row >= map.height ? 2 * map.height - 1 - row : row;
      const float* from = map.at((column % map.width + map.width) % map.width, row);
      sum += Color(from[0], from[1], from[2]) * (across[size_t(i)] * down[size_t(j)]);
    }
  return sum;
}

}  // namespace sateen
