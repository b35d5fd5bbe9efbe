#include "film/film.h"

#include <algorithm>
#include <cmath>

namespace sateen {

std::uint64_t replicate_count(std::uint64_t n, int r) {
  return (n + replicates - 1 - std::uint64_t(r)) / replicates;
}

void add_sample(FilmPixel& pixel, const Color& value, float coverage, double grain) {
  const size_t r = pixel.samples % replicates;
  for (int c = 0; c < 3; ++c) pixel.beauty[r][c] += std::nearbyint(double(value[c]) / grain) * grain;
  pixel.coverage[r] += std::nearbyint(double(coverage) * 0x1p33) * 0x1p-33;
  ++pixel.samples;
}

Color pixel_mean(const FilmPixel& pixel) {
  if (pixel.samples == 0) return Color(0);
  Vec3d sum(0);
  for (const Vec3d& v : pixel.beauty) sum += v;
  sum /= double(pixel.samples);
  return {float(sum.x), float(sum.y), float(sum.z)};
}

double pixel_coverage(const FilmPixel& pixel) {
  if (pixel.samples == 0) return 0;
  double sum = 0;
  for (const double c : pixel.coverage) sum += c;
  return sum / double(pixel.samples);
}

Vec3d pixel_variance(const FilmPixel& pixel) {
  const int used = int(std::min<std::uint64_t>(pixel.samples, replicates));
  if (used < 2) return Vec3d(0);
  // Replicate r weighs n_r / n and its mean varies as 1 / n_r: then the weighted scatter has the expectation
  // (replicates - 1) times the variance of the mean of all, also where the last round is not whole.
  Vec3d mean(0), scatter(0);
  for (const Vec3d& v : pixel.beauty) mean += v;
  mean /= double(pixel.samples);
  for (int r = 0; r < used; ++r) {
    const double count = double(replicate_count(pixel.samples, r));
    const Vec3d off = pixel.beauty[size_t(r)] / count - mean;
    scatter += off * off * (count / double(pixel.samples));
  }
  return scatter / double(used - 1);
}

void add_film(Film& film, const Film& other) {
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    FilmPixel& to = film.pixels[i];
    const FilmPixel& from = other.pixels[i];
    for (size_t r = 0; r < replicates; ++r) to.beauty[r] += from.beauty[r];
    for (size_t r = 0; r < replicates; ++r) to.coverage[r] += from.coverage[r];
    to.samples += from.samples;
  }
  for (size_t i = 0; i < film.layers.size() && i < other.layers.size(); ++i) {
    LayerPixel& to = film.layers[i];
    const LayerPixel& from = other.layers[i];
    for (int family = 0; family < 2; ++family) {
      to.surface[family] += from.surface[family];
      to.volume[family] += from.volume[family];
    }
    for (int b = 0; b < tracked_bounces; ++b) to.indirect.bounce[b] += from.indirect.bounce[b];
    to.through_gaps += from.through_gaps;
    to.backdrop += from.backdrop;
    to.albedo += from.albedo;
    to.normal += from.normal;
    to.position += from.position;
    to.warp += from.warp;
    to.uv += from.uv;
    to.hits += from.hits;
  }
  film.opaque = film.opaque || other.opaque;
  film.first_sample = std::min(film.first_sample, other.first_sample);
}

}  // namespace sateen
