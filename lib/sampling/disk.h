#pragma once
#include <array>
#include <cmath>

#include "math/vector.h"

namespace sateen {

/// From the unit square to the unit disk, uniform in area, neighbours stay neighbours: squares become circles
/// (Shirley and Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997).
inline Vec2 concentric_disk(const std::array<double, 2>& u) {
  const double a = 2 * u[0] - 1, b = 2 * u[1] - 1;
  if (a == 0 && b == 0) return {0, 0};
  constexpr double quarter = std::numbers::pi / 4;
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b, angle = wide ? quarter * (b / a) : 2 * quarter - quarter * (a / b);
  return {float(radius * std::cos(angle)), float(radius * std::sin(angle))};
}

/// Uniform over the regular polygon of `corners` (3 and more) whose corners lie on the unit circle, the first at
/// (0, 1): a slice by the first number, and a point of that triangle by what is left of both.
inline Vec2 regular_polygon(int corners, const std::array<double, 2>& u) {
  const double place = u[0] * corners, slice = std::min(std::floor(place), double(corners - 1));
  const double out = std::sqrt(u[1]), along = place - slice;
  const auto corner = [&](double k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    return std::array{std::sin(angle), std::cos(angle)};
  };
  const auto a = corner(slice), b = corner(slice + 1);
  return {float(out * (a[0] * (1 - along) + b[0] * along)), float(out * (a[1] * (1 - along) + b[1] * along))};
}

/// Unit direction about +Z, its density is z / pi.
inline Vec3 cosine_direction(const std::array<double, 2>& u) {
  const Vec2 d = concentric_disk(u);
  return {d.x, d.y, std::sqrt(std::max(1 - d.x * d.x - d.y * d.y, 1e-12f))};
}

}  // namespace sateen
