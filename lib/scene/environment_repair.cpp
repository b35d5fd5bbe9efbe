#include <algorithm>
#include <cmath>

#include "scene/environment.h"

namespace sateen {

namespace {
void count(EnvironmentRepairs::Kind& kind, int x, int y) {
  if (kind.count++ > 0) return;
  kind.first_x = x;
  kind.first_y = y;
}

// A spike is more likely a damaged number than a light: one channel this many times above the pixel's other two and
// above the mean of the map. Lamps and suns are bright in at least two channels; a real laser would be reported too,
// which is why a spike is named and left alone.
constexpr float spike_ratio = 100;

bool spike_at(const Image& map, int x, int y, float mean) {
  const float* p = map.at(x, y);
  const int c = p[0] >= p[1] && p[0] >= p[2] ? 0 : p[1] >= p[2] ? 1 : 2;
  const float limit = p[c] / spike_ratio;
  return p[(c + 1) % 3] < limit && p[(c + 2) % 3] < limit && mean < limit;
}

// Over the sphere and the three channels.
float mean_of(const Image& map) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y) {
    double row = 0;
    for (int x = 0; x < map.width; ++x) {
      const float* p = map.at(x, y);
      row += double(p[0]) + double(p[1]) + double(p[2]);
    }
    sum += row / (3.0 * map.width) * environment_row_weight(y, map.height) / 2;
  }
  return float(sum);
}
}  // namespace

EnvironmentRepairs repair_radiance(Image& map) {
  EnvironmentRepairs repairs;
  const int colours = map.channels < 3 ? 1 : 3;
  const size_t pixels = size_t(map.width) * size_t(map.height);
  float largest = 0;
  for (size_t i = 0; i < pixels; ++i)
    for (int c = 0; c < colours; ++c) {
      const float value = map.pixels[i * size_t(map.channels) + size_t(c)];
      if (std::isfinite(value)) largest = std::max(largest, value);
    }
  // A map of nothing but Inf and black was clipped by half's range.
  if (largest == 0) largest = 65504;

  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x) {
      float* p = map.at(x, y);
      bool nan = false, infinite = false, negative = false;
      for (int c = 0; c < colours; ++c) {
        nan = nan || std::isnan(p[c]);
        infinite = infinite || std::isinf(p[c]);
        negative = negative || (std::isfinite(p[c]) && p[c] < 0);
        p[c] = std::isnan(p[c]) || p[c] < 0 ? 0.0f : std::isinf(p[c]) ? largest : p[c];
      }
      if (nan) count(repairs.not_a_number, x, y);
      if (infinite) count(repairs.infinite, x, y);
      if (negative) count(repairs.negative, x, y);
    }
  if (colours == 3) {
    const float mean = mean_of(map);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        if (spike_at(map, x, y, mean)) count(repairs.spike, x, y);
  }
  return repairs;
}

}  // namespace sateen
