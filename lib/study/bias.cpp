#include "study/bias.h"

#include <algorithm>
#include <cmath>

#include "film/develop.h"

namespace sateen {

namespace {

// Differences of code values, averaged over blocks so that a single noisy pixel is not called visible.
std::vector<double> block_differences(const Image& cheap, const Image& fine) {
  constexpr int block = 4;
  std::vector<double> all;
  for (int by = 0; by < fine.height; by += block)
    for (int bx = 0; bx < fine.width; bx += block) {
      double sum[3] = {0, 0, 0};
      int count = 0;
      for (int y = by; y < std::min(by + block, fine.height); ++y)
        for (int x = bx; x < std::min(bx + block, fine.width); ++x, ++count)
          for (int c = 0; c < 3; ++c) sum[c] += double(cheap.at(x, y)[c]) - double(fine.at(x, y)[c]);
      for (const double s : sum) all.push_back(255 * s / count);
    }
  return all;
}

double agreed_difference(const FilmPair& cheap, const FilmPair& fine, const ColorManager& colors,
                         const DisplaySettings& display, float exposure_ev) {
  const auto shown = [&](const Film& film) {
    return develop_display(develop_beauty(film), colors, display, exposure_ev);
  };
  const std::vector<double> a = block_differences(shown(cheap.a), shown(fine.a));
  const std::vector<double> b = block_differences(shown(cheap.b), shown(fine.b));
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i)
    if (a[i] * b[i] > 0) largest = std::max(largest, std::min(std::abs(a[i]), std::abs(b[i])));
  return largest;
}

}  // namespace

Bias measure_bias(const FilmPair& cheap, const FilmPair& fine, const ColorManager& colors,
                  const DisplaySettings& display, float exposure_ev) {
  // The interval comes from whole blocks: neighbouring pixels are off alike.
  constexpr int block = 8;
  const double floor = error_floor_at(double(exposure_ev));
  const int width = fine.a.width, height = fine.a.height;
  std::vector<double> blocks;
  double total = 0, covered = 0;
  for (int by = 0; by < height; by += block)
    for (int bx = 0; bx < width; bx += block) {
      double sum = 0;
      for (int y = by; y < std::min(by + block, height); ++y)
        for (int x = bx; x < std::min(bx + block, width); ++x) {
          const size_t i = size_t(y) * size_t(width) + size_t(x);
          const Color fine_a = pixel_mean(fine.a.pixels[i]), fine_b = pixel_mean(fine.b.pixels[i]);
          const Color off_a = pixel_mean(cheap.a.pixels[i]) - fine_a, off_b = pixel_mean(cheap.b.pixels[i]) - fine_b;
          const double coverage = pixel_coverage(fine.a.pixels[i]);
          covered += coverage;
          for (int c = 0; c < 3; ++c) {
            const double value = (double(fine_a[c]) + double(fine_b[c])) / 2;
            sum += coverage * double(off_a[c]) * double(off_b[c]) / (value * value + floor * floor);
          }
        }
      blocks.push_back(sum);
      total += sum;
    }
  const double n = double(blocks.size()), count = std::max(3 * covered, 1e-9);
  double scatter = 0;
  for (const double sum : blocks) scatter += (sum - total / n) * (sum - total / n);
  const double half = n > 1 ? 1.96 * std::sqrt(scatter * n / (n - 1)) / count : 0, mean = total / count;
  const auto root = [](double square) { return std::sqrt(std::max(square, 0.0)); };
  return {{root(mean), root(mean - half), root(mean + half)},
          agreed_difference(cheap, fine, colors, display, exposure_ev)};
}

bool same_bits(const Film& a, const Film& b) {
  return std::equal(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), b.pixels.end(),
                    [](const FilmPixel& p, const FilmPixel& q) { return p.beauty == q.beauty; });
}

}  // namespace sateen
