#include "render/allocation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sateen {

namespace {

constexpr int first_barrier = 16;  // fewer know too little of the error to deal by it
constexpr double least_share = 1.0 / 16;
constexpr int radius = 2;  // of the neighbourhood: 24 pixels of 3 degrees of freedom each

double squared(double x) {
  return x * x;
}

// Relative variance of one sample, as E weighs it.
double sample_variance(const FilmPixel& pixel) {
  if (pixel.samples < 2) return 0;
  const Color mean = pixel_mean(pixel), variance = pixel_variance(pixel);
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += double(variance[c]) / (squared(double(mean[c])) + 0.01);
  return sum * double(pixel.samples) / 3;
}

// Mean over the neighbourhood without its middle. Sums run along rows, then down columns, always in this order.
std::vector<double> pooled_without_own(const std::vector<double>& values, int width, int height) {
  std::vector<double> rows(values.size()), out(values.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int k = std::max(x - radius, 0); k <= std::min(x + radius, width - 1); ++k)
        sum += values[size_t(y) * size_t(width) + size_t(k)];
      rows[size_t(y) * size_t(width) + size_t(x)] = sum;
    }
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int y0 = std::max(y - radius, 0), y1 = std::min(y + radius, height - 1);
      const int across = std::min(x + radius, width - 1) - std::max(x - radius, 0) + 1;
      const size_t here = size_t(y) * size_t(width) + size_t(x);
      double sum = 0;
      for (int k = y0; k <= y1; ++k)
        // Left out, not taken off again: a difference would keep a rounding of the pixel's own value.
        if (k != y) sum += rows[size_t(k) * size_t(width) + size_t(x)];
      for (int k = std::max(x - radius, 0); k <= std::min(x + radius, width - 1); ++k)
        if (k != x) sum += values[size_t(y) * size_t(width) + size_t(k)];
      const int count = across * (y1 - y0 + 1) - 1;
      out[here] = count > 0 ? sum / count : values[here];
    }
  return out;
}

// The number next to it, by ratio, that is a power of two or one and a half times one: there sequences are even, in
// between E is up to a tenth larger than the number of samples says.
double even_number(double samples) {
  if (samples < 6) return 4;
  const double power = std::exp2(std::floor(std::log2(samples))), ratio = samples / power;
  return ratio < std::sqrt(1.5) ? power : ratio < std::sqrt(3.0) ? 1.5 * power : 2 * power;
}

// Samples of a pixel of that weight when a weight of 1 gets `scale`.
double share(double weight, double scale, double before, double least) {
  return std::max(even_number(std::max(weight * scale, least)), before);
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

std::vector<std::uint32_t> allocate(const Film& film, const Crop& crop, int barrier, bool adaptive) {
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

  std::vector<double> weights(count);
  for (size_t i = 0; i < count; ++i) weights[i] = sample_variance(film.pixels[pixel_at(i)]);
  weights = pooled_without_own(weights, width, height);
  for (double& weight : weights) weight = std::sqrt(weight);
  // No noise anywhere: all the same.
  if (*std::max_element(weights.begin(), weights.end()) == 0) std::fill(weights.begin(), weights.end(), 1.0);
  for (size_t i = 0; i < count; ++i) weights[i] = dithered(weights[i], i, width);
  const double wanted = double(barrier) * double(count), least = double(barrier) * least_share;
  double smallest = std::numeric_limits<double>::infinity();
  for (const double weight : weights)
    if (weight > 0) smallest = std::min(smallest, weight);
  // The scale at which the shares add up to what is wanted lies between these two.
  double low = 0, high = 2 * wanted / smallest;
  for (int step = 0; step < 60; ++step) {
    const double scale = (low + high) / 2;
    double sum = 0;
    for (size_t i = 0; i < count; ++i)
      sum += share(weights[i], scale, double(film.pixels[pixel_at(i)].samples), least);
    (sum < wanted ? low : high) = scale;
  }
  for (size_t i = 0; i < count; ++i) {
    targets[pixel_at(i)] = std::uint32_t(share(weights[i], low, double(film.pixels[pixel_at(i)].samples), least));
  }
  return targets;
}

double useful_samples(const Film& film) {
  constexpr double noisy = 1e-3;
  std::vector<double> variances(film.pixels.size());
  double total = 0, pixels = 0, useful = 0;
  for (size_t i = 0; i < variances.size(); ++i) {
    if (film.pixels[i].samples < 2) continue;
    variances[i] = sample_variance(film.pixels[i]);
    total += variances[i];
    ++pixels;
  }
  for (size_t i = 0; i < variances.size(); ++i)
    if (film.pixels[i].samples >= 2 && variances[i] * pixels > noisy * total)
      useful += double(film.pixels[i].samples);
  return pixels > 0 ? useful / pixels : 0;
}

std::uint32_t part_of_target(std::uint32_t target, int samples, int barrier) {
  if (samples >= barrier) return target;
  const std::uint64_t part =
      (std::uint64_t(target) * std::uint64_t(samples) + std::uint64_t(barrier) - 1) / std::uint64_t(barrier);
  return std::uint32_t(part);
}

}  // namespace sateen
