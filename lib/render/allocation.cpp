#include "render/allocation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "film/bands.h"
#include "film/neighbours.h"

namespace sateen {

namespace {

constexpr int first_barrier = 16;  // fewer know too little of the error to deal by it
constexpr double least_share = 1.0 / 16;
constexpr double root_1_5 = 1.2247448713915890, root_3 = 1.7320508075688772;
constexpr int radius = 2;  // of the neighbourhood: 24 pixels of 3 degrees of freedom each

double squared(double x) {
  return x * x;
}

/// For every pixel what the pixels around it say of E squared that one sample there is worth: mean variance of a
/// sample over mean value squared, times mean coverage, over the backing that shows more of it.
std::vector<double> noise_around(const Film& film, const ErrorScale& scale) {
  std::vector<double> noise(film.pixels.size());
  for_each_band(film, radius, scale.threads, [&](const Film& part, int skip, int y0, int y1) {
    const size_t size = part.pixels.size(), width = size_t(film.width);
    std::vector<double> present(size), coverage(size);
    for (size_t i = 0; i < size; ++i) {
      present[i] = part.pixels[i].samples >= 2;
      coverage[i] = pixel_coverage(part.pixels[i]);
    }
    const auto around = [&](const auto& values) {
      return mean_of_neighbours(values, present, part.width, part.height, radius);
    };
    coverage = around(coverage);
    for (const double backing : backings(film, scale)) {
      std::vector<Vec3d> variance(size), value(size);
      for (size_t i = 0; i < size; ++i) {
        const FilmPixel over = laid_over(part.pixels[i], backing);
        variance[i] = pixel_variance(over) * double(over.samples);
        value[i] = Vec3d(pixel_mean(over));
      }
      variance = around(variance);
      value = around(value);
      for (size_t i = 0; i < size_t(y1 - y0) * width; ++i) {
        const size_t there = i + size_t(skip) * width;
        double sum = 0;
        for (int c = 0; c < 3; ++c) sum += variance[there][c] / (squared(value[there][c]) + squared(scale.floor));
        double& most = noise[i + size_t(y0) * width];
        most = std::max(most, sum / 3 * coverage[there]);
      }
    }
  });
  return noise;
}

// The number next to it, by ratio, that is a power of two or one and a half times one: there sequences are even, in
// between E is up to a tenth larger than the number of samples says.
double even_number(double samples) {
  if (samples < 6) return 4;
  constexpr std::uint64_t digits = (std::uint64_t(1) << 52) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(samples);
  const double power = std::bit_cast<double>(bits & ~digits), ratio = samples / power;
  return ratio < root_1_5 ? power : ratio < root_3 ? 1.5 * power : 2 * power;
}

/// Pixels among which samples are dealt out in proportion to their weights.
struct Shares {
  std::vector<double> weights;
  std::vector<double> before;  ///< samples that they have
  double least = 0;            ///< and that each shall have

  size_t size() const { return weights.size(); }
  /// Samples of pixel i when a weight of 1 gets `scale`: a whole number that grows with it, so that sums are exact.
  double of(size_t i, double scale) const {
    return std::max(even_number(std::max(weights[i] * scale, least)), before[i]);
  }
  double sum(double scale) const {
    double total = 0;
    for (size_t i = 0; i < size(); ++i) total += of(i, scale);
    return total;
  }
  void add(const Shares& from, size_t i) {
    weights.push_back(from.weights[i]);
    before.push_back(from.before[i]);
  }
};

/// The largest scale found by halving [0, most] sixty times of which `is_less` says that it deals out too little.
template <class Less>
double halved(double most, const Less& is_less) {
  double low = 0, high = most;
  for (int step = 0; step < 60; ++step) {
    const double scale = (low + high) / 2;
    (is_less(scale) ? low : high) = scale;
  }
  return low;
}

/// The scale at which the shares add up to what is wanted, or just below. A sixty-fourth of the pixels says about
/// where it lies; there few shares change, and only these are added up again and again.
double scale_for(const Shares& shares, double wanted) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const double weight : shares.weights)
    if (weight > 0) smallest = std::min(smallest, weight);
  const double most = 2 * wanted / smallest;
  constexpr size_t stride = 61;
  Shares few{{}, {}, shares.least};
  for (size_t i = 0; i < shares.size(); i += stride) few.add(shares, i);
  const double part = wanted * double(few.size()) / double(shares.size());
  const double about = halved(most, [&](double scale) { return few.sum(scale) < part; });
  const double tiny = most * 1e-18;  // below what sixty halvings tell apart
  double low = about, high = std::max(about, tiny);
  double margin = 1.01;
  do low = low / margin, margin *= margin;
  while (low > tiny && shares.sum(low) >= wanted);
  margin = 1.01;
  do high = high * margin, margin *= margin;
  while (high < most && shares.sum(high) < wanted);
  if (!(low > tiny)) low = 0;
  Shares open{{}, {}, shares.least};
  double settled = 0;
  for (size_t i = 0; i < shares.size(); ++i) {
    const double at_low = shares.of(i, low);
    if (at_low == shares.of(i, high))
      settled += at_low;
    else
      open.add(shares, i);
  }
  return halved(most,
                [&](double scale) { return scale <= low || (scale < high && settled + open.sum(scale) < wanted); });
}

// Up to a hundredth more for some pixels, evenly mixed, so that not all of one weight take a step at once.
double dithered(double weight, size_t pixel, int width) {
  const double place = 0.7548776662 * double(pixel % size_t(width)) + 0.5698402910 * double(pixel / size_t(width));
  return weight * (1 + 0.01 * (place - std::floor(place)));
}

}  // namespace

Crop clipped(const Crop& c, int width, int height) {
  if (c.x1 <= c.x0 || c.y1 <= c.y0) return {0, 0, width, height};
  return {std::max(c.x0, 0), std::max(c.y0, 0), std::min(c.x1, width), std::min(c.y1, height)};
}

int next_barrier(int samples) {
  if (samples < first_barrier) return first_barrier;
  return samples / first_barrier * first_barrier + first_barrier * std::max(samples / 32 / first_barrier, 1);
}

std::vector<std::uint32_t> allocate(const Film& film, const Crop& crop, int barrier, bool adaptive,
                                    const ErrorScale& scale) {
  const Crop w = clipped(crop, film.width, film.height);
  std::vector<std::uint32_t> targets(film.pixels.size(), 0);
  const int width = w.x1 - w.x0, height = w.y1 - w.y0;
  if (width <= 0 || height <= 0) return targets;
  const auto pixel_at = [&](size_t i) {
    return size_t(w.y0 + int(i) / width) * size_t(film.width) + size_t(w.x0 + int(i) % width);
  };
  const size_t count = size_t(width) * size_t(height);
  if (!adaptive || barrier <= first_barrier) {
    for (size_t i = 0; i < count; ++i) targets[pixel_at(i)] = std::uint32_t(barrier);
    return targets;
  }

  Shares shares{std::vector<double>(count), std::vector<double>(count), double(barrier) * least_share};
  const std::vector<double> noise = noise_around(film, scale);
  for (size_t i = 0; i < count; ++i) {
    shares.weights[i] = std::sqrt(noise[pixel_at(i)]);
    shares.before[i] = double(film.pixels[pixel_at(i)].samples);
  }
  // No noise anywhere: all the same.
  std::vector<double>& weights = shares.weights;
  if (*std::max_element(weights.begin(), weights.end()) == 0) std::fill(weights.begin(), weights.end(), 1.0);
  for (size_t i = 0; i < count; ++i) weights[i] = dithered(weights[i], i, width);
  const double factor = scale_for(shares, double(barrier) * double(count));
  for (size_t i = 0; i < count; ++i) targets[pixel_at(i)] = std::uint32_t(shares.of(i, factor));
  return targets;
}

double useful_samples(const Film& film, const std::vector<PixelError>& errors) {
  constexpr double noisy = 1e-3;
  double total = 0, pixels = 0, useful = 0;
  const auto of_sample = [&](size_t i) { return errors[i].weighted * double(film.pixels[i].samples); };
  for (size_t i = 0; i < errors.size(); ++i)
    if (errors[i].known) total += of_sample(i), ++pixels;
  for (size_t i = 0; i < errors.size(); ++i)
    if (errors[i].known && of_sample(i) * pixels > noisy * total) useful += double(film.pixels[i].samples);
  return pixels > 0 ? useful / pixels : 0;
}

std::uint32_t part_of_target(std::uint32_t target, int samples, int barrier) {
  if (samples >= barrier) return target;
  const std::uint64_t part =
      (std::uint64_t(target) * std::uint64_t(samples) + std::uint64_t(barrier) - 1) / std::uint64_t(barrier);
  return std::uint32_t(part);
}

}  // namespace sateen
