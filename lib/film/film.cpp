#include "film/film.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {
// Samples of replicate r among the first n of a pixel.
int replicate_count(std::uint32_t n, int r) {
  return int((n + replicates - 1 - std::uint32_t(r)) / replicates);
}
}  // namespace

Color pixel_mean(const FilmPixel& pixel) {
  if (pixel.samples == 0) return Color(0);
  Color sum(0);
  for (const Color& c : pixel.beauty) sum += c;
  return sum / float(pixel.samples);
}

Color pixel_variance(const FilmPixel& pixel) {
  const int used = int(std::min<std::uint32_t>(pixel.samples, replicates));
  if (used < 2) return Color(0);
  // Replicate r weighs n_r / n and its mean varies as 1 / n_r: then the weighted scatter has the expectation
  // (replicates - 1) times the variance of the mean of all, also where the last round is not whole.
  const Color mean = pixel_mean(pixel);
  Color scatter(0);
  for (int r = 0; r < used; ++r) {
    const float share = float(replicate_count(pixel.samples, r)) / float(pixel.samples);
    const Color off = pixel.beauty[r] / float(replicate_count(pixel.samples, r)) - mean;
    scatter += off * off * share;
  }
  return scatter / float(used - 1);
}

PictureError picture_error(const Film& film) {
  PictureError result;
  // Neighbouring pixels share geometry and so the size of their variance: the interval comes from whole blocks.
  constexpr int block = 16;
  std::vector<double> sums, counts;
  for (int by = 0; by < film.height; by += block)
    for (int bx = 0; bx < film.width; bx += block) {
      double sum = 0, count = 0;
      const int y1 = std::min(by + block, film.height), x1 = std::min(bx + block, film.width);
      for (int y = by; y < y1; ++y)
        for (int x = bx; x < x1; ++x) {
          const FilmPixel& pixel = film.pixels[size_t(y) * size_t(film.width) + size_t(x)];
          // Outside a crop, or after an interrupted first pass, there is nothing to be wrong.
          if (pixel.samples < 2) continue;
          ++count;
          const Color mean = pixel_mean(pixel), variance = pixel_variance(pixel);
          for (int c = 0; c < 3; ++c) sum += double(variance[c]) / (double(mean[c]) * mean[c] + 0.01);
        }
      if (count == 0) continue;
      sums.push_back(sum / 3);
      counts.push_back(count);
    }
  if (sums.empty()) return result;
  double total = 0, pixels = 0;
  for (size_t i = 0; i < sums.size(); ++i) total += sums[i], pixels += counts[i];
  const double mean = total / pixels;
  double spread = 0;
  for (size_t i = 0; i < sums.size(); ++i) spread += (sums[i] - mean * counts[i]) * (sums[i] - mean * counts[i]);
  const double n = double(sums.size());
  const double deviation = n > 1 ? std::sqrt(spread * n / (n - 1)) / pixels : mean;
  result.known = true;
  result.error = std::sqrt(mean);
  result.low = std::sqrt(std::max(mean - 1.96 * deviation, 0.0));
  result.high = std::sqrt(mean + 1.96 * deviation);
  return result;
}

}  // namespace sateen
