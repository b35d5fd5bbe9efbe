#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "math/vector.h"

namespace sateen {

/// Pixel filter by importance sampling (Ernst, Stamminger, Greiner 2006): every sample belongs to one pixel and
/// weighs 1, so pixels stay independent. Only filters without negative parts can be drawn from.

enum class FilterShape {
  blackman_harris,  ///< the minimum four-term window (1978); at radius 1.5 nearly a Gaussian of 0.44 pixels
  gaussian,         ///< standard deviation radius / 3, cut off at the radius
  triangle,
  box
};
const std::vector<std::string>& filter_names();  ///< in the order of the enum: "blackman-harris" ...

/// As authored. Separable, the same in either axis.
struct FilterSettings {
  FilterShape shape = FilterShape::blackman_harris;
  float radius = 1.5f;  ///< where it ends [pixels], 0.05 to 8; 0.5 of a box is the pixel itself
  bool operator==(const FilterSettings&) const = default;
};
/// "box", "gaussian:2": a shape and, unless it is the usual one (1.5; triangle 1, box 0.5), a radius. InputError with
/// the nearest name, named after `what`.
FilterSettings read_filter(const std::string& what, const std::string& text);
std::string filter_text(const FilterSettings& settings);  ///< the same, always with the radius

/// Compiled: the inverse of the filter's integral at 1,025 places; between them it is linear, so the filter sampled
/// is the histogram of these steps. Of Blackman-Harris the share of samples below any place is off by less than 5e-4,
/// the variance by 0.3 %.
struct PixelFilter {
  static constexpr int steps = 1024;
  std::array<float, steps + 1> inverse{};
};
std::shared_ptr<const PixelFilter> compile_filter(const FilterSettings& settings = {});  ///< the usual is made once

/// Offset from the pixel's centre in pixels, each coordinate within the radius. `u` in [0, 1).
Vec2 sample_filter(const PixelFilter& filter, const std::array<double, 2>& u);

}  // namespace sateen
