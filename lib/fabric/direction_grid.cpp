#include "fabric/direction_grid.h"

namespace sateen::direction_grid {

namespace {

constexpr double crowding_cell = 0.5;  // of phi towards the horizon; an even pile wants 1, grazing velvet 0.15
// Edges over the horizon; without them weights of 25 times the mean.
constexpr double rim_deg[rim_cells + 1] = {0, 0.005, 0.08, 0.8};

double view_s(double theta, double phi) {
  const double x = std::sin(theta), z = std::cos(theta) * std::cos(phi);
  return (theta + std::atan2(x, z)) / (2 * half_pi);
}

// Edge b of a column as its height over the horizon; the cells of the rim get ever narrower.
double height_edge(int b) {
  const double rim = rim_deg[rim_cells] / 90;
  if (b <= rim_cells) return rim_deg[b] / 90 * half_pi;
  const double tau = double(b - rim_cells) / (half_columns - rim_cells);
  return (rim + (1 - rim) * tau * (tau + crowding_cell) / (1 + crowding_cell)) * half_pi;
}

}  // namespace

double crowded_angle(double t, double crowding) {
  const double tau = 1 - std::abs(t);
  return std::copysign((1 - tau * (tau + crowding) / (1 + crowding)) * half_pi, t);
}

// Place and s are monotone in theta for a given phi.
double view_theta(double place, double phi) {
  double low = -half_pi, high = half_pi;
  for (int k = 0; k < 60; ++k) (place_of_s(view_s((low + high) / 2, phi)) < place ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

}  // namespace sateen::direction_grid

namespace sateen {

const ColumnGrid& column_grid() {
  using namespace direction_grid;
  static const ColumnGrid grid = [] {
    ColumnGrid g;
    for (int b = 0; b <= half_columns; ++b) g.edge[size_t(b)] = float(height_edge(b));
    std::copy(g.edge.begin() + 1, g.edge.end(), g.ceiling.begin());
    g.ceiling.back() = 10;
    for (size_t b = 0; b < half_columns; ++b)
      g.inverse_area[b] = float(theta_cells / (2 * half_pi) / (double(g.edge[b + 1]) - g.edge[b]) * 0x1p-32);
    for (int i = 0, b = 0; i <= guides; ++i) {
      // A little earlier than exact, so that rounding of the place never starts behind the column.
      const double from = half_pi * (i - 0.01) / guides;
      while (b < half_columns - 1 && double(g.edge[size_t(b) + 1]) <= from) ++b;
      g.guide[size_t(i)] = std::uint8_t(b);
    }
    return g;
  }();
  return grid;
}

std::vector<float> column_heights() {
  const ColumnGrid& grid = column_grid();
  return {grid.edge.begin(), grid.edge.end()};
}

}  // namespace sateen
