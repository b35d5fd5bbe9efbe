#include "fabric/direction_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "fabric/direction_grid.h"

namespace sateen {

namespace {

using namespace direction_grid;

constexpr double floor_share = 0.01;  // of the mean, so that every direction can be drawn; 2 % cost 0.001 of variance
constexpr double neighbour_share = 0.2;  // of the largest neighbour: a slice of another view is off by part of a cell
constexpr int half_s_nodes = 13, half_phi_nodes = 12;  // s of 12: crimson velvet has 0.061 of uniform's variance

struct Turn {
  double sine, cosine;
  explicit Turn(double angle = 0) : sine(std::sin(angle)), cosine(std::cos(angle)) {}
};

/// Where cells are looked at: a quarter and three quarters of a row; those and two places of the rim in a column.
struct CellPoints {
  std::array<std::array<Turn, 2>, theta_cells> theta;
  std::array<std::array<Turn, 2>, half_columns> height;
};

const CellPoints& cell_points() {
  static const CellPoints points = [] {
    CellPoints p;
    const ColumnGrid& grid = column_grid();
    for (size_t a = 0; a < theta_cells; ++a)
      for (const size_t i : {0, 1}) {
        const double d_theta = 2 * half_pi / theta_cells, theta = -half_pi + double(a) * d_theta;
        p.theta[a][i] = Turn(theta + (i == 0 ? 0.25 : 0.75) * d_theta);
      }
    for (size_t b = 0; b < half_columns; ++b) {
      // In the rim F falls like the inverse height: two heights that give a decade's mean.
      const double from = grid.edge[b], d_phi = double(grid.edge[b + 1]) - from;
      p.height[b] = {Turn(from + (b < rim_cells ? 0.12 : 0.25) * d_phi),
                     Turn(from + (b < rim_cells ? 0.6 : 0.75) * d_phi)};
    }
    return p;
  }();
  return points;
}

struct SliceMaker {
  const Threads<float>& threads;
  float volume_warp, volume_weft;
  ThreadView<float> view;

  double f_cos_theta(const Turn& theta, double side, const Turn& height) const {
    const double c = theta.cosine;
    const ThreadSums<float> s =
        scatter<float>(threads, view, float(theta.sine), float(side * c * height.cosine), float(c * height.sine));
    return c * (double(s.surface[0]) + s.surface[1] + volume_warp * s.volume[0] + volume_weft * s.volume[1]);
  }

  void make(double theta_r, double phi_r, std::uint32_t* cumulative) {
    const double c = std::cos(theta_r);
    prepare_view<float>(threads, float(std::sin(theta_r)), float(c * std::sin(phi_r)), float(c * std::cos(phi_r)),
                        view);
    const ColumnGrid& grid = column_grid();
    const CellPoints& points = cell_points();
    std::array<double, cells> value, mass;
    const double d_theta = 2 * half_pi / theta_cells;
    for (int a = 0; a < theta_cells; ++a)
      for (int column = 0; column < phi_cells; ++column) {
        const int b = std::min(column, phi_cells - 1 - column);
        const double side = column < half_columns ? -1 : 1;
        const auto at = [&](int i, int j) {
          return f_cos_theta(points.theta[size_t(a)][size_t(i)], side, points.height[size_t(b)][size_t(j)]);
        };
        // Two points on a diagonal, the other one in the next cell: the mean of 2 x 2 is no better, but in the rim.
        const int first = (a + column) % 2 ? 0 : 1;
        value[size_t(a * phi_cells + column)] =
            b < rim_cells ? (at(0, 0) + at(0, 1) + at(1, 0) + at(1, 1)) / 4 : (at(0, first) + at(1, 1 - first)) / 2;
      }
    const auto area = [&](size_t column) {
      const size_t b = std::min(column, phi_cells - 1 - column);
      return d_theta * (double(grid.edge[b + 1]) - grid.edge[b]);
    };
    double total = 0;
    for (size_t k = 0; k < cells; ++k) {
      const size_t column = k % phi_cells;
      const double neighbour =
          std::max({k >= phi_cells ? value[k - phi_cells] : 0, k + phi_cells < cells ? value[k + phi_cells] : 0,
                    column > 0 ? value[k - 1] : 0, column + 1 < phi_cells ? value[k + 1] : 0});
      mass[k] = std::max(value[k], neighbour_share * neighbour) * area(column);
      total += mass[k];
    }
    const double everywhere = total > 0 ? floor_share * total : 1.0;
    for (size_t k = 0; k < cells; ++k) mass[k] += everywhere * area(k % phi_cells) / (4 * half_pi * half_pi);
    double all = 0, sum = 0;
    for (const double m : mass) all += m;
    for (int k = 0; k < cells; ++k) {
      cumulative[k] = std::uint32_t(sum / all * 0x1p32);
      sum += mass[k];
    }
    cumulative[cells] = 0;
  }
};

/// Nodes of s from the middle to one end. The ridge of a weft lobe wanders over the warp's rows from view to view,
/// which no turn of a slice undoes: it must not pass its own width between two nodes. Those of `half_s_nodes` suit
/// lobes of 3 degrees; with them one of 1.6 that is tilted by 64 shows weights of 139 times the mean, with 24 nodes
/// of 9.7.
int half_s_nodes_of(const Threads<float>& t) {
  if (t.first[1] < 0) return half_s_nodes;
  const auto k = size_t(t.first[1]);
  const double surface = t.eta2_minus_1[k] > 0 ? double(t.surface_exponent[k]) : 0;
  const double volume = t.volume_norm[k] > 0 ? double(t.volume_exponent[k]) : 0;
  constexpr double wide_enough = 3.0 / 180 * 2 * half_pi;
  const double narrower = wide_enough * std::sqrt(2 * std::max(surface, volume));  // 1 / (2 gamma^2)
  return 1 + int(std::ceil((half_s_nodes - 1) * std::clamp(narrower, 1.0, 2.0)));
}

}  // namespace

DirectionTable tabulate_directions(const Threads<float>& threads, float volume_warp, float volume_weft, bool mirror_x,
                                   bool mirror_y, int threads_used, double size) {
  DirectionTable table;
  table.mirror_x = mirror_x;
  table.mirror_y = mirror_y;
  const auto half_of = [&](int usual) { return std::max(int(std::lround(usual * size)), 2); };
  const int half_s = half_of(half_s_nodes_of(threads)), half_phi = half_of(half_phi_nodes);
  table.s_nodes = mirror_x ? half_s : 2 * half_s - 1;
  table.phi_nodes = mirror_y ? half_phi : 2 * half_phi - 1;
  const int nodes = table.s_nodes * table.phi_nodes;
  table.node_theta.resize(nodes);
  table.cumulative.resize(size_t(nodes) * (cells + 1));
  table.row_start.resize(size_t(nodes) * theta_cells);
  parallel_for(nodes, threads_used, [&](int node) {
    const double phi = view_phi(node_place(node % table.phi_nodes, table.phi_nodes, mirror_y));
    const double theta = view_theta(node_place(node / table.phi_nodes, table.s_nodes, mirror_x), phi);
    table.node_theta[node] = float(theta);
    SliceMaker maker{threads, volume_warp, volume_weft, {}};
    std::uint32_t* cumulative = &table.cumulative[size_t(node) * (cells + 1)];
    maker.make(theta, phi, cumulative);
    for (int a = 0; a < theta_cells; ++a)
      table.row_start[size_t(node) * theta_cells + size_t(a)] = cumulative[a * phi_cells];
  });
  return table;
}

}  // namespace sateen
