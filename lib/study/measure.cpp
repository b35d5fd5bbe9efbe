#include "study/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sateen {

namespace {
// Errors of independent pictures add up in their squares. Where a picture is as good as the reference the difference
// is chance: half is left, so that logarithms can be taken.
double without_own(double between, double own) {
  return std::max(between - own, between / 2);
}
}  // namespace

Reference make_reference(const Film& film, int samples, double error_floor) {
  Reference reference;
  reference.error_floor = error_floor;
  const double floor_squared = error_floor * error_floor;
  reference.samples = samples;
  double covered = 0;
  for (const FilmPixel& pixel : film.pixels) {
    const double coverage = pixel_coverage(pixel);
    reference.coverage.push_back(coverage);
    covered += coverage;
    const Color mean = pixel_mean(pixel);
    const Vec3d variance = pixel_variance(pixel);
    reference.values.push_back(mean);
    for (int c = 0; c < 3; ++c) {
      reference.own.absolute += variance[c];
      reference.own.relative += coverage * variance[c] / (double(mean[c]) * double(mean[c]) + floor_squared);
    }
  }
  const double count = 3 * double(film.pixels.size());
  reference.own.absolute /= count;
  reference.own.relative /= std::max(3 * covered, 1e-9);
  return reference;
}

PictureMse mse_against(const Film& film, const Reference& reference) {
  PictureMse mse;
  double covered = 0;
  const double floor_squared = reference.error_floor * reference.error_floor;
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    const Color mean = pixel_mean(film.pixels[i]), truth = reference.values[i];
    covered += reference.coverage[i];
    for (int c = 0; c < 3; ++c) {
      const double off = double(mean[c]) - double(truth[c]);
      mse.absolute += off * off;
      mse.relative += reference.coverage[i] * off * off / (double(truth[c]) * double(truth[c]) + floor_squared);
    }
  }
  const double count = 3 * double(film.pixels.size());
  return {without_own(mse.absolute / count, reference.own.absolute),
          without_own(mse.relative / std::max(3 * covered, 1e-9), reference.own.relative)};
}

namespace {
double log_scatter(const std::vector<double>& values) {
  double mean = 0, scatter = 0;
  for (const double v : values) mean += std::log(v) / double(values.size());
  for (const double v : values) scatter += std::pow(std::log(v) - mean, 2);
  return scatter;
}

Interval about_median(std::vector<double> values, double half) {
  std::sort(values.begin(), values.end());
  const size_t count = values.size();
  const double middle = std::sqrt(values[(count - 1) / 2] * values[count / 2]);
  return {middle, middle * std::exp(-half), middle * std::exp(half)};
}
}  // namespace

Interval repeated_interval(const std::vector<double>& values) {
  const int count = int(values.size());
  return about_median(values,
                      count < 2 ? 0 : student_t(count - 1) * std::sqrt(log_scatter(values) / (count - 1) / count));
}

std::vector<Interval> pooled_intervals(const std::vector<std::vector<double>>& sets) {
  double scatter = 0;
  int degrees = 0;
  for (const std::vector<double>& set : sets) scatter += log_scatter(set), degrees += int(set.size()) - 1;
  std::vector<Interval> all;
  for (const std::vector<double>& set : sets)
    all.push_back(
        about_median(set, degrees < 1 ? 0 : student_t(degrees) * std::sqrt(scatter / degrees / double(set.size()))));
  return all;
}

double student_t(int degrees) {
  static constexpr std::array<double, 30> table{
      12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.160, 2.145, 2.131,
      2.120,  2.110, 2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
  if (degrees <= int(table.size())) return table[size_t(degrees < 1 ? 0 : degrees - 1)];
  return 1.96 + 2.5 / degrees;
}

Interval jackknife_interval(int count, const std::function<double(int without)>& log_value) {
  const double value = log_value(0);
  if (count < 2) return {std::exp(value), std::exp(value), std::exp(value)};
  std::vector<double> left;
  double mean = 0, scatter = 0;
  for (int k = 1; k <= count; ++k) {
    left.push_back(log_value(k));
    mean += left.back() / count;
  }
  for (const double v : left) scatter += (v - mean) * (v - mean);
  const double half = student_t(count - 1) * std::sqrt(scatter * (count - 1) / count);
  return {std::exp(value), std::exp(value - half), std::exp(value + half)};
}

Interval error_interval(const std::vector<double>& squares) {
  const int count = int(squares.size());
  return jackknife_interval(count, [&](int without) {
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += k + 1 == without ? 0 : squares[size_t(k)];
    return std::log(sum / (count - (without > 0 ? 1 : 0))) / 2;
  });
}

}  // namespace sateen
