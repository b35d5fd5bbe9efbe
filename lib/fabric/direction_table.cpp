#include "fabric/direction_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "math/lane_functions.h"

namespace sateen {

namespace {

constexpr int theta_cells = DirectionTable::theta_cells, phi_cells = DirectionTable::phi_cells;
constexpr int cells = DirectionTable::cells;
constexpr double half_pi = 1.57079632679489662;
constexpr double floor_share = 0.02;   // of the mean, so that every direction can be drawn; 5 % cost 0.009 of variance
constexpr double crowding_view = 0.08;  // of phi_r towards the horizon; variance of grazing views, measured
constexpr double crowding_cell = 0.15;  // of phi towards the horizon
constexpr double rim_share = 0.8;      // a rim cell is worth at least this share of its largest value: the weight's bound
constexpr int half_s_nodes = 12, half_phi_nodes = 11;  // s of 11: velvet at 89 degrees has 1.6 times the variance
constexpr int guides = 256;            // shares of phi's half turn, each narrower than the narrowest cell
constexpr double outermost = 0.998;    // of t: nodes stay off the horizon itself, where F is 0

// t in [-1, 1] to an angle in [-pi/2, pi/2] with steps that shrink towards the ends, and back.
double crowded_angle(double t, double crowding) {
  const double tau = 1 - std::abs(t);
  return std::copysign((1 - tau * (tau + crowding) / (1 + crowding)) * half_pi, t);
}
float crowded_place(float angle, float crowding) {
  const float e = std::max(1 - std::abs(angle) * float(1 / half_pi), 0.0f);
  const float tau = 0.5f * (std::sqrt(crowding * crowding + 4 * e * (1 + crowding)) - crowding);
  return std::copysign(1 - tau, angle);
}

double view_s(double theta, double phi) {
  const double x = std::sin(theta), z = std::cos(theta) * std::cos(phi);
  return (theta + std::atan2(x, z)) / (2 * half_pi);
}
// view_s is monotone in theta for a given phi.
double theta_of(double s, double phi) {
  double low = -half_pi, high = half_pi;
  for (int k = 0; k < 60; ++k) (view_s((low + high) / 2, phi) < s ? low : high) = (low + high) / 2;
  return (low + high) / 2;
}

double node_place(int i, int nodes, bool mirrored) {
  const double t = double(i) / (nodes - 1);
  return outermost * (mirrored ? t : 2 * t - 1);
}
float node_index(float place, int nodes, bool mirrored) {
  const float t = place * float(1 / outermost);
  const float index = (mirrored ? t : 0.5f * (t + 1)) * float(nodes - 1);
  return std::clamp(index, 0.0f, float(nodes - 1));
}

struct PhiGrid {
  std::array<float, phi_cells + 1> edge;
  std::array<float, phi_cells> inverse_area;  ///< 1 / (d theta d phi) of a cell times 2^-32
  std::array<std::uint8_t, guides> guide;     ///< first cell that an equal share of the half turn meets
};
const PhiGrid& phi_grid() {
  static const PhiGrid grid = [] {
    PhiGrid g;
    for (int b = 0; b <= phi_cells; ++b) g.edge[b] = float(crowded_angle(2.0 * b / phi_cells - 1, crowding_cell));
    for (int b = 0; b < phi_cells; ++b)
      g.inverse_area[b] = float(theta_cells / (2 * half_pi) / (double(g.edge[b + 1]) - g.edge[b]) * 0x1p-32);
    for (int i = 0, b = 0; i < guides; ++i) {
      // One share earlier than exact, so that rounding of the place never starts behind the cell.
      const double from = 2 * half_pi * (i - 0.01) / guides - half_pi;
      while (b < phi_cells - 1 && double(g.edge[b + 1]) <= from) ++b;
      g.guide[size_t(i)] = std::uint8_t(b);
    }
    return g;
  }();
  return grid;
}

struct SliceMaker {
  const Threads<float>& threads;
  float volume_warp, volume_weft;
  ThreadView<float> view;

  double f_cos_theta(double theta, double phi) const {
    const double c = std::cos(theta);
    const ThreadSums<float> s = scatter<float>(threads, view, float(std::sin(theta)), float(c * std::sin(phi)),
                                               float(c * std::cos(phi)));
    return c * (double(s.surface[0]) + s.surface[1] + volume_warp * s.volume[0] + volume_weft * s.volume[1]);
  }

  void make(double theta_r, double phi_r, std::uint32_t* cumulative) {
    const double c = std::cos(theta_r);
    prepare_view<float>(threads, float(std::sin(theta_r)), float(c * std::sin(phi_r)), float(c * std::cos(phi_r)), view);
    const PhiGrid& grid = phi_grid();
    std::array<double, cells> mass;
    const double d_theta = 2 * half_pi / theta_cells;
    double total = 0;
    for (int a = 0; a < theta_cells; ++a)
      for (int b = 0; b < phi_cells; ++b) {
        const double theta = -half_pi + a * d_theta, d_phi = double(grid.edge[b + 1]) - grid.edge[b];
        double mean = 0, largest = 0;
        for (const double i : {0.25, 0.75})
          for (const double j : {0.25, 0.75}) mean += f_cos_theta(theta + i * d_theta, grid.edge[b] + j * d_phi) / 4;
        if (b == 0 || b == phi_cells - 1)  // the rim: Q vanishes within a tenth of a degree of the horizon
          for (const double i : {0.25, 0.75})
            for (const double j : {0.02, 0.1})
              largest = std::max(largest, f_cos_theta(theta + i * d_theta, grid.edge[b] + (b == 0 ? j : 1 - j) * d_phi));
        mass[a * phi_cells + b] = std::max(mean, rim_share * largest) * d_theta * d_phi;
        total += mass[a * phi_cells + b];
      }
    const double everywhere = total > 0 ? floor_share * total : 1.0;
    for (int k = 0; k < cells; ++k)
      mass[k] += everywhere * (double(grid.edge[k % phi_cells + 1]) - grid.edge[k % phi_cells]) * d_theta /
                 (4 * half_pi * half_pi);
    double all = 0, sum = 0;
    for (const double m : mass) all += m;
    for (int k = 0; k < cells; ++k) {
      cumulative[k] = std::uint32_t(sum / all * 0x1p32);
      sum += mass[k];
    }
    cumulative[cells] = 0;
  }
};

float wrap_theta(float theta) {
  constexpr float quarter = float(half_pi);
  if (theta >= quarter) theta -= pi;
  if (theta < -quarter) theta += pi;
  return theta;
}

int theta_cell(float theta) {
  return std::clamp(int((theta + float(half_pi)) * float(theta_cells / (2 * half_pi))), 0, theta_cells - 1);
}
int phi_cell(float phi) {
  const PhiGrid& grid = phi_grid();
  const int place = std::clamp(int((phi + float(half_pi)) * float(guides / (2 * half_pi))), 0, guides - 1);
  int b = grid.guide[size_t(place)];
  // The edges as stored decide, so that the density is exactly the one drawn from.
  while (b < phi_cells - 1 && phi >= grid.edge[size_t(b) + 1]) ++b;
  return b;
}

/// Index of the last of `count` ascending entries that is <= value, the first of which is. Counting them all has no
/// branch to predict and is a few vector instructions.
template <int count>
int last_not_above(const std::uint32_t* entries, std::uint32_t value) {
  int n = 0;
  for (int i = 0; i < count; ++i) n += entries[i] <= value ? 1 : 0;
  return std::max(n - 1, 0);
}

/// atan2(y, x) for x >= 0, several at a time.
struct Angles {
  float a, b, c;
};
Angles right_angles(float ya, float xa, float yb, float xb, float yc = 0, float xc = 1) {
  float angle[8];
  atan_magnitude(Lanes::of(ya, yb, yc, 1), max(Lanes::of(xa, xb, xc, 1), Lanes(1e-30f))).store(angle);
  return {std::copysign(angle[0], ya), std::copysign(angle[1], yb), std::copysign(angle[2], yc)};
}

}  // namespace

DirectionTable tabulate_directions(const Threads<float>& threads, float volume_warp, float volume_weft, bool mirror_x,
                                   bool mirror_y, int threads_used) {
  DirectionTable table;
  table.mirror_x = mirror_x;
  table.mirror_y = mirror_y;
  table.s_nodes = mirror_x ? half_s_nodes : 2 * half_s_nodes - 1;
  table.phi_nodes = mirror_y ? half_phi_nodes : 2 * half_phi_nodes - 1;
  const int nodes = table.s_nodes * table.phi_nodes;
  table.node_theta.resize(nodes);
  table.cumulative.resize(size_t(nodes) * (cells + 1));
  table.row_start.resize(size_t(nodes) * theta_cells);
  parallel_for(nodes, threads_used, [&](int node) {
    const double phi =
        crowded_angle(node_place(node % table.phi_nodes, table.phi_nodes, mirror_y), crowding_view);
    const double theta = theta_of(node_place(node / table.phi_nodes, table.s_nodes, mirror_x), phi);
    table.node_theta[node] = float(theta);
    SliceMaker maker{threads, volume_warp, volume_weft, {}};
    std::uint32_t* cumulative = &table.cumulative[size_t(node) * (cells + 1)];
    maker.make(theta, phi, cumulative);
    for (int a = 0; a < theta_cells; ++a) table.row_start[size_t(node) * theta_cells + size_t(a)] = cumulative[a * phi_cells];
  });
  return table;
}

TableView prepare_table(const DirectionTable& table, const Vec3& wo) {
  TableView view;
  view.flip_x = table.mirror_x && wo.x < 0 ? -1.0f : 1.0f;
  view.flip_y = table.mirror_y && wo.y < 0 ? -1.0f : 1.0f;
  const float x = wo.x * view.flip_x, y = wo.y * view.flip_y;
  const Angles angles = right_angles(x, std::sqrt(y * y + wo.z * wo.z), x, wo.z, y, wo.z);
  const float theta = angles.a, s = (theta + angles.b) * (1 / pi);
  const float i = node_index(s, table.s_nodes, table.mirror_x);
  const float j = node_index(crowded_place(angles.c, float(crowding_view)), table.phi_nodes, table.mirror_y);
  const int i0 = std::min(int(i), table.s_nodes - 2), j0 = std::min(int(j), table.phi_nodes - 2);
  const float fi = i - float(i0), fj = j - float(j0);
  for (int k = 0; k < 4; ++k) {
    const int node = (i0 + (k & 1)) * table.phi_nodes + j0 + (k >> 1);
    view.slice[k] = &table.cumulative[size_t(node) * (cells + 1)];
    view.row_start[k] = &table.row_start[size_t(node) * theta_cells];
    view.share[k] = (k & 1 ? fi : 1 - fi) * (k >> 1 ? fj : 1 - fj);
    view.turn[k] = theta - table.node_theta[node];
  }
  return view;
}

float table_pdf(const TableView& view, const Vec3& wi) {
  if (!(wi.z > 0)) return 0;
  const float x = wi.x * view.flip_x, y = wi.y * view.flip_y;
  const float cos_theta = std::sqrt(y * y + wi.z * wi.z);
  const Angles angles = right_angles(x, cos_theta, y, wi.z);
  const float theta = angles.a;
  const int b = phi_cell(angles.b);
  float density = 0;
  for (int k = 0; k < 4; ++k) {
    if (view.share[k] == 0) continue;
    const std::uint32_t* entry = view.slice[k] + theta_cell(wrap_theta(theta + view.turn[k])) * phi_cells + b;
    density += view.share[k] * float(entry[1] - entry[0]);
  }
  return density * phi_grid().inverse_area[b] / std::max(cos_theta, 1e-12f);
}

Vec3 sample_table(const TableView& view, double u_view, double u_theta, double u_phi) {
  int k = 0;
  for (float left = float(u_view) - view.share[0]; k < 3 && left >= 0; left -= view.share[++k]) {
  }
  while (k > 0 && view.share[k] == 0) --k;
  const std::uint32_t* slice = view.slice[k];

  // Rows by u_theta, columns within the row by u_phi: a two-dimensional point set stays stratified.
  const std::uint32_t u = std::uint32_t(u_theta * 0x1p32);
  const int a = last_not_above<theta_cells>(view.row_start[k], u);
  const std::uint32_t* row = slice + a * phi_cells;
  const std::uint32_t row_mass = row[phi_cells] - row[0];
  const double in_row = (u_theta * 0x1p32 - row[0]) / row_mass;
  const double target = u_phi * row_mass;
  const int low = last_not_above<phi_cells>(row, row[0] + std::uint32_t(target));
  const double in_cell = (target - double(row[low] - row[0])) / double(row[low + 1] - row[low]);

  const PhiGrid& grid = phi_grid();
  const float theta_node =
      float(-half_pi + (a + std::clamp(in_row, 0.0, 0x1.fffffep-1)) * (2 * half_pi / theta_cells));
  const float theta = wrap_theta(theta_node - view.turn[k]);
  const float phi = grid.edge[low] + float(std::clamp(in_cell, 0.0, 0x1.fffffep-1)) * (grid.edge[low + 1] - grid.edge[low]);
  const Lanes angles = Lanes::of(theta, phi, 0, 0);
  float sine[8], cosine[8];
  sin_quarter(angles).store(sine);
  cos_quarter(angles).store(cosine);
  const float across = std::max(cosine[0], 0.0f);
  return {view.flip_x * sine[0], view.flip_y * across * sine[1], std::max(across * cosine[1], 1e-9f)};
}

}  // namespace sateen
