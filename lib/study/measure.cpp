#include "study/measure.h"

#include <array>
#include <cmath>

namespace sateen {

namespace {
constexpr double floor_squared = 0.01;  // of E, film/film.h
}

Reference make_reference(const Film& film, int samples) {
  Reference reference;
  reference.samples = samples;
  for (const FilmPixel& pixel : film.pixels) {
    const Color mean = pixel_mean(pixel), variance = pixel_variance(pixel);
    reference.values.push_back(mean);
    for (int c = 0; c < 3; ++c) {
      reference.own.absolute += double(variance[c]);
      reference.own.relative += double(variance[c]) / (double(mean[c]) * double(mean[c]) + floor_squared);
    }
  }
  const double count = 3 * double(film.pixels.size());
  reference.own.absolute /= count;
  reference.own.relative /= count;
  return reference;
}

PictureMse mse_against(const Film& film, const Reference& reference) {
  PictureMse mse;
  for (size_t i = 0; i < film.pixels.size(); ++i) {
    const Color mean = pixel_mean(film.pixels[i]), truth = reference.values[i];
    for (int c = 0; c < 3; ++c) {
      const double off = double(mean[c]) - double(truth[c]);
      mse.absolute += off * off;
      mse.relative += off * off / (double(truth[c]) * double(truth[c]) + floor_squared);
    }
  }
  const double count = 3 * double(film.pixels.size());
  return {mse.absolute / count, mse.relative / count};
}

double student_t(int degrees) {
  static constexpr std::array<double, 30> table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                                                2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086,
                                                2.080,  2.074, 2.069, 2.064, 2.060, 2.056, 2.052, 2.048, 2.045, 2.042};
  if (degrees <= int(table.size())) return table[size_t(degrees < 1 ? 0 : degrees - 1)];
  return 1.96 + 2.5 / degrees;
}

Interval mean_interval(const std::vector<double>& values) {
  const double n = double(values.size());
  double sum = 0, scatter = 0;
  for (const double v : values) sum += v;
  const double mean = sum / n;
  for (const double v : values) scatter += (v - mean) * (v - mean);
  if (values.size() < 2) return {mean, mean, mean};
  const double half = student_t(int(values.size()) - 1) * std::sqrt(scatter / (n - 1) / n);
  return {mean, mean - half, mean + half};
}

Interval geometric_interval(const std::vector<double>& values) {
  std::vector<double> logs;
  for (const double v : values) logs.push_back(std::log(v));
  const Interval of_logs = mean_interval(logs);
  return {std::exp(of_logs.value), std::exp(of_logs.low), std::exp(of_logs.high)};
}

}  // namespace sateen
