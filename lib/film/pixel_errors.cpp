#include <cmath>

#include "film/bands.h"
#include "film/error.h"
#include "film/neighbours.h"

namespace sateen {

namespace {

constexpr double most_calmer = 25;  // that a pixel may be than its neighbours, by variance

/// A pixel's replicates: their means, how many samples each holds, and the sum of their coverage.
struct Replicates {
  std::array<Vec3d, replicates> value;
  std::array<double, replicates> count, coverage;
  int used = 0;

  explicit Replicates(const FilmPixel& pixel) {
    used = int(std::min<std::uint64_t>(pixel.samples, replicates));
    coverage = pixel.coverage;
    for (size_t r = 0; r < size_t(used); ++r) {
      count[r] = double(replicate_count(pixel.samples, int(r)));
      value[r] = pixel.beauty[r] / count[r];
    }
  }
};

/// What the neighbours tell of every pixel.
struct Surroundings {
  std::vector<Vec3d> mean;             ///< of their values
  std::vector<Vec3d> mean_variance;    ///< of that mean
  std::vector<Vec3d> sample_variance;  ///< mean over them, of one sample
  std::vector<Vec3d> spread;           ///< variance of a pixel's true value about their mean
  std::vector<double> coverage;
};

Vec3d at_least_0(Vec3d v) {
  for (int c = 0; c < 3; ++c) v[c] = std::max(v[c], 0.0);
  return v;
}

Surroundings look_around(const Film& film, double backing) {
  const size_t size = film.pixels.size();
  std::vector<double> present(size), covered(size), neighbours;
  std::vector<Vec3d> mean(size, Vec3d(0)), variance(size, Vec3d(0)), of_sample(size, Vec3d(0)), apart(size, Vec3d(0));
  for (size_t i = 0; i < size; ++i) {
    const FilmPixel& pixel = film.pixels[i];
    if (pixel.samples < 2) continue;
    present[i] = 1;
    covered[i] = pixel_coverage(pixel);
    const FilmPixel over = laid_over(pixel, backing);
    mean[i] = Vec3d(pixel_mean(over));
    variance[i] = pixel_variance(over);
    of_sample[i] = variance[i] * double(over.samples);
  }
  const auto around = [&](const auto& values, int radius, std::vector<double>* counts = nullptr) {
    return mean_of_neighbours(values, present, film.width, film.height, radius, counts);
  };
  Surroundings s;
  s.mean = around(mean, 1, &neighbours);
  s.coverage = around(covered, 1);
  // Eight pixels of few samples may all have missed what is rare, and then would say that they are sure.
  s.mean_variance = around(variance, 2);
  s.sample_variance = around(of_sample, 2);
  for (size_t i = 0; i < size; ++i) {
    s.mean_variance[i] /= std::max(neighbours[i], 1.0);
    const Vec3d off = mean[i] - s.mean[i];
    apart[i] = off * off - variance[i] - s.mean_variance[i];
  }
  s.spread = around(apart, 2);
  for (Vec3d& v : s.spread) v = at_least_0(v);
  return s;
}

/// One pixel: every pair of replicates is compared, and the others and the neighbours say what with.
PixelError error_of(const FilmPixel& pixel, const Surroundings& s, size_t i, double backing, double floor) {
  PixelError e;
  if (pixel.samples < 2) return e;
  e.known = true;
  e.coverage = float(pixel_coverage(pixel));
  const FilmPixel over = laid_over(pixel, backing);
  const Replicates r(over);
  const Vec3d own_variance = pixel_variance(over) * double(over.samples);
  const auto n = double(pixel.samples);
  const Vec3d prior = s.spread[i] + s.mean_variance[i];
  for (size_t a = 1; a < size_t(r.used); ++a)
    for (size_t b = 0; b < a; ++b) {
      Vec3d others(0);
      double count = 0, coverage = 0;
      for (size_t k = 0; k < size_t(r.used); ++k) {
        if (k == a || k == b) continue;
        others += r.value[k] * r.count[k];
        count += r.count[k];
        coverage += r.coverage[k];
      }
      const Vec3d apart = r.value[a] - r.value[b];
      double relative = 0, at_most = 0;
      for (int c = 0; c < 3; ++c) {
        if (apart[c] == 0) continue;
        // Of two or three samples nothing is left beside the pair, and half is what came out right (docs/error.md).
        double value = s.mean[i][c], unsure = prior[c] / 2;
        if (count > 0) {
          // Two independent accounts of one value: the better known counts for more.
          // Beside a sun's reflection neighbours know nothing of a pixel's noise.
          const double own = std::min(s.sample_variance[i][c], most_calmer * own_variance[c]) / count;
          const double both = prior[c] + own;
          const double trust = both > 0 ? prior[c] / both : 1;
          value += trust * (others[c] / count - value);
          unsure = trust * own;
        }
        const double known = value * value + floor * floor;
        relative += apart[c] * apart[c] / (known + unsure);
        at_most += apart[c] * apart[c] / known;
      }
      const double share = r.count[a] * r.count[b] / (n * n * (r.used - 1) * 3);
      const double covered = count > 0 ? coverage / count : s.coverage[i];
      e.relative += share * relative;
      e.weighted += share * relative * covered;
      e.at_most += share * at_most * covered;
    }
  return e;
}

std::vector<PixelError> errors_over(const Film& film, const ErrorScale& scale, double backing) {
  constexpr int margin = 4;  // rows that look_around() sees: two of two
  std::vector<PixelError> errors(film.pixels.size());
  const auto width = size_t(film.width);
  for_each_band(film, margin, scale.threads, [&](const Film& part, int skip, int y0, int y1) {
    const Surroundings around = look_around(part, backing);
    for (size_t i = 0; i < size_t(y1 - y0) * width; ++i) {
      const size_t there = i + size_t(skip) * width;
      errors[i + size_t(y0) * width] = error_of(part.pixels[there], around, there, backing, scale.floor);
    }
  });
  return errors;
}

double sum_of(const std::vector<PixelError>& errors) {
  double sum = 0;
  for (const PixelError& e : errors) sum += e.weighted;
  return sum;
}

}  // namespace

std::vector<double> backings(const Film& film, const ErrorScale& scale) {
  return film.opaque ? std::vector<double>{0} : std::vector<double>{0, mid_grey_of(scale.floor)};
}

FilmPixel laid_over(const FilmPixel& pixel, double backing) {
  FilmPixel over = pixel;
  for (size_t r = 0; r < size_t(replicates); ++r)
    over.beauty[r] += Vec3d(backing * (double(replicate_count(pixel.samples, int(r))) - pixel.coverage[r]));
  return over;
}

std::vector<PixelError> pixel_errors(const Film& film, const ErrorScale& scale) {
  std::vector<PixelError> worst;
  double most = -1;
  for (const double backing : backings(film, scale)) {
    std::vector<PixelError> errors = errors_over(film, scale, backing);
    const double sum = sum_of(errors);
    // Of sums that are no numbers, as a checkpoint may hold them, the first will do.
    if (worst.empty() || sum > most) most = sum, worst = std::move(errors);
  }
  return worst;
}

}  // namespace sateen
