#include "scene/environment_repair.h"

#include <algorithm>
#include <cmath>

#include "scene/environment_build.h"

namespace sateen {

namespace {
// A spike is more likely a damaged number than a light: one channel this many times above the pixel's other two and
// above the mean of the map. Lamps and suns are bright in at least two channels; a real laser would be reported too,
// which is why a spike is named and left alone.
constexpr float spike_ratio = 100;

// A map of nothing but Inf and black was clipped by half's range.
constexpr float largest_half = 65504;

// Room for the matrix of a conversion; what is above 1e35 in the end is held there and counted.
constexpr float convertible = 1e37f;

// A conversion leaves this much of the brightest channel where another should be 0: no colour to speak of.
constexpr float rounding = 1e-6f;
}  // namespace

void RadianceMender::look(const Image& band) {
  for (const float value : band.pixels)
    if (std::isfinite(value)) largest_ = std::max(largest_, value);
  infinite_is_ = largest_ > 0 ? largest_ : largest_half;
}

bool RadianceMender::again() {
  const bool unknown = infinite_is_ == 0 && repairs_.infinite.count > 0;
  infinite_is_ = largest_ > 0 ? largest_ : largest_half;
  if (unknown) {
    mean_ = 0;
    spikes_.clear();
    repairs_ = {};
  }
  return unknown;
}

void RadianceMender::mend_in_file_space(Image& band, int y0) {
  negative_.assign(size_t(band.width) * size_t(band.height), 0);
  for (int y = 0; y < band.height; ++y)
    for (int x = 0; x < band.width; ++x) {
      float* p = band.at(x, y);
      bool nan = false, infinite = false, negative = false;
      for (int c = 0; c < 3; ++c) {
        nan = nan || std::isnan(p[c]);
        infinite = infinite || std::isinf(p[c]);
        negative = negative || (std::isfinite(p[c]) && p[c] < 0);
        if (std::isfinite(p[c])) {
          largest_ = std::max(largest_, p[c]);
          p[c] = std::clamp(p[c], -convertible, convertible);
        } else {
          p[c] = p[c] > 0 ? infinite_is_ : 0.0f;
        }
      }
      if (nan) count_repair(repairs_.not_a_number, x, y0 + y);
      if (infinite) count_repair(repairs_.infinite, x, y0 + y);
      negative_[size_t(y) * size_t(band.width) + size_t(x)] = negative;
    }
  gather_spikes(band, y0);
}

void RadianceMender::gather_spikes(const Image& band, int y0) {
  for (int y = 0; y < band.height; ++y) {
    double row = 0;
    for (int x = 0; x < band.width; ++x) {
      const float* p = band.at(x, y);
      row += double(std::max(p[0], 0.0f)) + double(std::max(p[1], 0.0f)) + double(std::max(p[2], 0.0f));
      const int c = p[0] >= p[1] && p[0] >= p[2] ? 0 : p[1] >= p[2] ? 1 : 2;
      const float limit = p[c] / spike_ratio;
      if (std::abs(p[(c + 1) % 3]) < limit && std::abs(p[(c + 2) % 3]) < limit && float(mean_) < limit)
        spikes_.push_back({p[c], x, y0 + y});
    }
    mean_ += row / (3.0 * band.width) * environment_row_weight(y0 + y, height_) / 2;
    // The mean only grows with the rows: what it has overtaken is no spike.
    if (spikes_.size() > many_spikes_) {
      std::erase_if(spikes_, [&](const Spike& s) { return !(float(mean_) < s.value / spike_ratio); });
      many_spikes_ = std::max(many_spikes_, 2 * spikes_.size());
    }
  }
}

void RadianceMender::mend_in_working_space(Image& band, int y0) {
  for (int y = 0; y < band.height; ++y)
    for (int x = 0; x < band.width; ++x) {
      float* p = band.at(x, y);
      const float brightest = std::max({p[0], p[1], p[2]});
      bool nan = false, negative = false;
      for (int c = 0; c < 3; ++c) {
        nan = nan || std::isnan(p[c]);
        negative = negative || p[c] < -rounding * brightest;
        p[c] = p[c] >= 0 ? p[c] : 0.0f;
      }
      const bool before = negative_[size_t(y) * size_t(band.width) + size_t(x)] != 0;
      if (nan) count_repair(repairs_.not_a_number, x, y0 + y);
      if (negative || before)
        count_repair(!before ? repairs_.out_of_gamut : negative ? repairs_.negative : repairs_.wide, x, y0 + y);
    }
}

EnvironmentRepairs RadianceMender::repairs() const {
  EnvironmentRepairs all = repairs_;
  for (const Spike& s : spikes_)
    if (float(mean_) < s.value / spike_ratio) count_repair(all.spike, s.x, s.y);
  return all;
}

}  // namespace sateen
