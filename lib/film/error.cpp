#include "film/error.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

// Student's t that 2.5 % lie above (Cornish and Fisher's expansion; 1 % off at 3 degrees of freedom).
double student_95(double freedom) {
  constexpr double z = 1.96, z3 = z * z * z, z5 = z3 * z * z;
  const double f = std::max(freedom, 2.0);
  return z + (z3 + z) / (4 * f) + (5 * z5 + 16 * z3 + 3 * z) / (96 * f * f);
}

// What a pixel adds to E squared, mean over channels; below 0 where it does not count.
double relative_variance(const FilmPixel& pixel) {
  if (pixel.samples < 2) return -1;
  const Color mean = pixel_mean(pixel), variance = pixel_variance(pixel);
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += double(variance[c]) / (double(mean[c]) * double(mean[c]) + 0.01);
  return sum / 3;
}

}  // namespace

PictureError picture_error(const Film& film) {
  double total = 0, pixels = 0, spread = 0, spread_squares = 0;
  // How uncertain the sum is shows in the scatter within cells of 2 x 2 pixels: they are independent and see about
  // the same. What they differ by in truth makes the interval wider, never narrower.
  for (int y = 0; y < film.height; y += 2)
    for (int x = 0; x < film.width; x += 2) {
      double sum = 0, squares = 0, count = 0;
      for (int k = 0; k < 4; ++k) {
        const int px = x + k % 2, py = y + k / 2;
        if (px >= film.width || py >= film.height) continue;
        const double v = relative_variance(film.pixels[size_t(py) * size_t(film.width) + size_t(px)]);
        // Outside a crop, or after an interrupted first pass, there is nothing to be wrong.
        if (v < 0) continue;
        sum += v;
        squares += v * v;
        ++count;
      }
      const double scatter = count > 1 ? std::max(squares - sum * sum / count, 0.0) * count / (count - 1) : squares;
      total += sum;
      pixels += count;
      spread += scatter;
      spread_squares += scatter * scatter;
    }
  PictureError result;
  if (pixels == 0) return result;
  result.known = true;
  result.error = result.low = result.high = std::sqrt(total / pixels);
  if (total == 0) return result;
  // The estimate scatters by `spread`; what the picture really is off by scatters by up to three times that (of a
  // normal deviate's square the variance is 2, of the mean of three 2/3). Logarithms: sums of squares are skew.
  const double freedom = spread_squares > 0 ? 3 * spread * spread / spread_squares : 1e9;
  const double half = student_95(freedom) * std::sqrt(4 * spread) / total / 2;
  result.low = result.error * std::exp(-half);
  result.high = result.error * std::exp(half);
  return result;
}

std::vector<Color> pooled_variances(const Film& film) {
  std::vector<Color> own(film.pixels.size()), pooled(film.pixels.size());
  for (size_t i = 0; i < own.size(); ++i) own[i] = pixel_variance(film.pixels[i]);
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const size_t here = size_t(y) * size_t(film.width) + size_t(x);
      Color sum(0);
      float count = 0;
      for (int py = std::max(y - 1, 0); py <= std::min(y + 1, film.height - 1); ++py)
        for (int px = std::max(x - 1, 0); px <= std::min(x + 1, film.width - 1); ++px) {
          const size_t i = size_t(py) * size_t(film.width) + size_t(px);
          if (i == here || film.pixels[i].samples < 2) continue;
          // Of the same samples: where a neighbour has more, its variance is smaller for no reason of this pixel.
          sum += own[i] * (float(film.pixels[i].samples) / std::max(float(film.pixels[here].samples), 1.0f));
          ++count;
        }
      pooled[here] = film.pixels[here].samples < 2 ? Color(0)
                     : count > 0                   ? (own[here] + sum / count) * 0.5f
                                                   : own[here];
    }
  return pooled;
}

double deviation_of_share(const Film& film, double share) {
  const std::vector<Color> pooled = pooled_variances(film);
  std::vector<double> deviations;
  for (size_t i = 0; i < pooled.size(); ++i) {
    if (film.pixels[i].samples < 2) continue;
    const Color mean = pixel_mean(film.pixels[i]);
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += double(pooled[i][c]) / (double(mean[c]) * double(mean[c]) + 0.01);
    deviations.push_back(std::sqrt(sum / 3));
  }
  if (deviations.empty()) return 0;
  double low = 0, high = 10 * *std::max_element(deviations.begin(), deviations.end());
  for (int k = 0; k < 40; ++k) {
    const double x = (low + high) / 2;
    double inside = 0;
    for (const double d : deviations) inside += d > 0 ? std::erf(x / d / std::sqrt(2.0)) : 1;
    (inside < share * double(deviations.size()) ? low : high) = x;
  }
  return high;
}

}  // namespace sateen
