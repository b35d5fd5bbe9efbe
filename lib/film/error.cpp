#include "film/error.h"

#include <algorithm>
#include <cmath>

#include "film/neighbours.h"

namespace sateen {

namespace {

constexpr double unsure_factor = 1.5, most_unsure = 20;
// Share of the covered cells that E comes from where it rests on rare samples.
constexpr double few_cells = 0.01;

// Student's t that 2.5 % lie above (Cornish and Fisher's expansion; 1 % off at 3 degrees of freedom).
double student_95(double freedom) {
  constexpr double z = 1.96, z3 = z * z * z, z5 = z3 * z * z;
  const double f = std::max(freedom, 2.0);
  return z + (z3 + z) / (4 * f) + (5 * z5 + 16 * z3 + 3 * z) / (96 * f * f);
}

/// `own` of every pixel, half of it replaced by its neighbours'. Of the same samples: where a neighbour has more, its
/// variance is smaller for no reason of this pixel.
template <class T>
std::vector<T> half_from_neighbours(const Film& film, const std::vector<T>& own) {
  std::vector<T> of_sample(own.size(), T(0));
  std::vector<double> present(own.size()), counts;
  for (size_t i = 0; i < own.size(); ++i) {
    present[i] = film.pixels[i].samples >= 2;
    of_sample[i] = own[i] * double(film.pixels[i].samples);
  }
  std::vector<T> out = mean_of_neighbours(of_sample, present, film.width, film.height, 1, &counts);
  for (size_t i = 0; i < own.size(); ++i) {
    const double samples = double(film.pixels[i].samples);
    out[i] = present[i] == 0 ? T(0) : counts[i] > 0 ? (own[i] + out[i] / samples) * 0.5 : own[i];
  }
  return out;
}

}  // namespace

PictureError picture_error(const Film& film, const std::vector<PixelError>& errors) {
  double total = 0, at_most = 0, weight = 0, spread = 0, spread_squares = 0, covered_cells = 0;
  bool known = false;
  // How uncertain the sum is shows in the scatter within cells of 2 x 2 pixels: they are independent and see about
  // the same. What they differ by in truth makes the interval wider, never narrower.
  for (int y = 0; y < film.height; y += 2)
    for (int x = 0; x < film.width; x += 2) {
      double sum = 0, squares = 0, count = 0, covered = 0;
      for (int k = 0; k < 4; ++k) {
        const int px = x + k % 2, py = y + k / 2;
        if (px >= film.width || py >= film.height) continue;
        const PixelError& e = errors[size_t(py) * size_t(film.width) + size_t(px)];
        // Outside a crop, or after an interrupted first pass, there is nothing to be wrong.
        if (!e.known) continue;
        sum += e.weighted;
        squares += e.weighted * e.weighted;
        at_most += e.at_most;
        covered += double(e.coverage);
        ++count;
      }
      const double scatter = count > 1 ? std::max(squares - sum * sum / count, 0.0) * count / (count - 1) : squares;
      total += sum;
      weight += covered;
      covered_cells += covered > 0;
      known = known || count > 0;
      spread += scatter;
      spread_squares += scatter * scatter;
    }
  PictureError result;
  result.known = known;
  if (!(weight > 0)) return result;
  result.error = result.low = result.high = std::sqrt(total / weight);
  if (!(total > 0)) return result;
  // The estimate scatters by `spread`; what the picture really is off by scatters by up to three times that (of a
  // normal deviate's square the variance is 2, of the mean of three 2/3). Logarithms: sums of squares are skew.
  const double cells = spread_squares > 0 ? spread * spread / spread_squares : 1e9;
  const double student = student_95(3 * cells);
  const double chance = student * std::sqrt(4 * spread) / total / 2;
  // Few samples are not sure of what the variances are divided by: E scatters from scene to scene about as far as
  // that would move it.
  const double unsure = unsure_factor * std::log(std::clamp(at_most / total, 1.0, most_unsure)) / 2;
  const double half = std::hypot(chance, unsure);
  result.low = result.error * std::exp(-half);
  // However few pixels it is: of a single one the real error over the stated is a Student's t.
  result.high = result.error * std::exp(std::hypot(std::min(chance, std::log(student)), unsure));
  result.rests_on_rare_samples = cells < std::max(few_cells * std::min(covered_cells, 10000.0), 2.5) && half > 0.1;
  return result;
}

PictureError picture_error(const Film& film, const ErrorScale& scale) {
  return picture_error(film, pixel_errors(film, scale));
}

std::vector<Vec3d> pooled_variances(const Film& film) {
  std::vector<Vec3d> own(film.pixels.size());
  for (size_t i = 0; i < own.size(); ++i) own[i] = pixel_variance(film.pixels[i]);
  return half_from_neighbours(film, own);
}

double deviation_of_share(const Film& film, const std::vector<PixelError>& errors, double share) {
  std::vector<double> own(errors.size());
  for (size_t i = 0; i < own.size(); ++i) own[i] = errors[i].relative;
  const std::vector<double> squares = half_from_neighbours(film, own);
  double all = 0, largest = 0;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i].known) continue;
    all += double(errors[i].coverage);
    largest = std::max(largest, std::sqrt(squares[i]));
  }
  if (!(all > 0) || !(largest > 0)) return 0;
  // Deviations are counted in steps of a two-hundredth of an octave; what is below 2^-40 of the largest is none.
  constexpr int steps = 200, octaves = 40;
  std::vector<double> count(steps * octaves + 1);
  for (size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i].known) continue;
    const double below = squares[i] > 0 ? -std::log2(std::sqrt(squares[i]) / largest) * steps : steps * octaves;
    count[size_t(std::clamp(below, 0.0, double(steps * octaves)))] += double(errors[i].coverage);
  }
  double low = 0, high = 10 * largest;
  for (int k = 0; k < 40; ++k) {
    const double x = (low + high) / 2;
    double inside = count.back();
    for (int step = 0; step < steps * octaves; ++step) {
      const double deviation = largest * std::exp2(-(step + 0.5) / steps);
      if (count[size_t(step)] > 0) inside += count[size_t(step)] * std::erf(x / deviation / std::sqrt(2.0));
    }
    (inside < share * all ? low : high) = x;
  }
  return high;
}

}  // namespace sateen
