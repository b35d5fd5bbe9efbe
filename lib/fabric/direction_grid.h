#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "fabric/direction_table.h"

// Where the direction table's view nodes and cells lie (fabric/direction_table.h), for making and for drawing.

namespace sateen::direction_grid {

inline constexpr int theta_cells = DirectionTable::theta_cells, phi_cells = DirectionTable::phi_cells;
inline constexpr int cells = DirectionTable::cells, half_columns = phi_cells / 2;
inline constexpr int rim_cells = 3;  // narrow columns at the horizon
inline constexpr double half_pi = 1.57079632679489662;
inline constexpr double crowding_s = 0.15;    // of s towards the ends; without it weights of 33 times the mean
inline constexpr double crowding_view = 0.1;  // of phi_r towards the horizon; variance of grazing views, measured
inline constexpr double outermost =
    0.99;  // of t: nodes stay off the horizon, next to which F is another one than here

// phi_r from t in [-1, 1] with steps that shrink towards the horizon, and back.
double crowded_angle(double t, double crowding);
inline double view_phi(double place) {
  return crowded_angle(place, crowding_view);
}
inline float place_of_phi(float phi) {
  constexpr auto crowding = float(crowding_view);
  const float e = std::max(1 - std::abs(phi) * float(1 / half_pi), 0.0f);
  const float tau = 0.5f * (std::sqrt(crowding * crowding + 4 * e * (1 + crowding)) - crowding);
  return std::copysign(1 - tau, phi);
}

// s in [-1, 1] to t in [-1, 1]: even but for the last 15 degrees, where nodes lie up to four times as close. Where a
// view grazes the ends of the warp F turns with the ratio of heights over the horizon; even nodes 8 degrees apart saw
// nothing of it.
template <class Real>
Real place_of_s(Real s) {
  const Real s2 = s * s, s4 = s2 * s2, s8 = s4 * s4;
  return s * (Real(1 - crowding_s) + Real(crowding_s) * s8 * s8);
}
double view_theta(double place, double phi);  // its inverse: theta_r of that s and phi_r

inline double node_place(int i, int nodes, bool mirrored) {
  const double t = double(i) / (nodes - 1);
  return outermost * (mirrored ? t : 2 * t - 1);
}
inline float node_index(float place, int nodes, bool mirrored) {
  const float t = place * float(1 / outermost);
  const float index = (mirrored ? t : 0.5f * (t + 1)) * float(nodes - 1);
  return std::clamp(index, 0.0f, float(nodes - 1));
}

inline constexpr int guides = 128;  // shares of the height; behind the rim no column is narrower

}  // namespace sateen::direction_grid

namespace sateen {

/// Columns of every slice in the height pi/2 - |phi|, which a float states exactly where it matters, at the horizon.
/// Column b of y < 0 lies between the heights edge[b] and edge[b + 1]; the columns of y > 0 follow from the zenith
/// down.
struct ColumnGrid {
  std::array<float, direction_grid::half_columns + 1> edge;
  std::array<float, direction_grid::half_columns> ceiling;       ///< edge[b + 1]; above every height for the last
  std::array<float, direction_grid::half_columns> inverse_area;  ///< 1 / (d theta d phi) of a cell times 2^-32
  std::array<std::uint8_t, direction_grid::guides + 1>
      guide;  ///< first column that an equal share of the height meets

  /// The edges as stored decide, so that the density is exactly the one drawn from. No share meets more than two
  /// edges.
  int cell(float height) const {
    int b = guide[size_t(
        std::min(int(height * float(direction_grid::guides / direction_grid::half_pi)), direction_grid::guides))];
    b += height >= ceiling[size_t(b)] ? 1 : 0;
    return b + (height >= ceiling[size_t(b)] ? 1 : 0);
  }
};

/// The same for every table.
const ColumnGrid& column_grid();

}  // namespace sateen
