#include "fabric/direction_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "math/lane_functions.h"

namespace sateen {

namespace {

constexpr int theta_cells = DirectionTable::theta_cells, phi_cells = DirectionTable::phi_cells;
constexpr int cells = DirectionTable::cells, half_columns = phi_cells / 2;
constexpr double half_pi = 1.57079632679489662;
constexpr double floor_share = 0.01;  // of the mean, so that every direction can be drawn; 2 % cost 0.001 of variance
constexpr double crowding_s = 0.15;  // of s towards the ends; without it weights of 33 times the mean, see place_of_s
constexpr double crowding_view = 0.1;  // of phi_r towards the horizon; variance of grazing views, measured
constexpr double crowding_cell = 0.5;  // of phi towards the horizon; an even pile wants 1, grazing velvet 0.15
constexpr double rim_deg[] = {0, 0.005, 0.08,
                              0.8};  // edges over the horizon; without them weights of 25 times the mean
constexpr int rim_cells = 3;
constexpr double neighbour_share = 0.2;  // of the largest neighbour: a slice of another view is off by part of a cell
constexpr int half_s_nodes = 13, half_phi_nodes = 12;  // s of 12: crimson velvet has 0.061 of uniform's variance
constexpr int guides = 128;                            // shares of the height; behind the rim no column is narrower
constexpr double outermost = 0.99;  // of t: nodes stay off the horizon, next to which F is another one than here

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

// s in [-1, 1] to t in [-1, 1]: even but for the last 15 degrees, where nodes lie up to four times as close. Where a
// view grazes the ends of the warp F turns with the ratio of heights over the horizon; even nodes 8 degrees apart saw
// nothing of it.
template <class Real>
Real place_of_s(Real s) {
  const Real s2 = s * s, s4 = s2 * s2, s8 = s4 * s4;
  return s * (Real(1 - crowding_s) + Real(crowding_s) * s8 * s8);
}
double view_s(double theta, double phi) {
  const double x = std::sin(theta), z = std::cos(theta) * std::cos(phi);
  return (theta + std::atan2(x, z)) / (2 * half_pi);
}
// Place and s are monotone in theta for a given phi.
double theta_of(double place, double phi) {
  double low = -half_pi, high = half_pi;
  for (int k = 0; k < 60; ++k) (place_of_s(view_s((low + high) / 2, phi)) < place ? low : high) = (low + high) / 2;
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

// Edge b of a column as its height over the horizon; the cells of the rim get ever narrower.
double height_edge(int b) {
  const double rim = rim_deg[rim_cells] / 90;
  if (b <= rim_cells) return rim_deg[b] / 90 * half_pi;
  const double tau = double(b - rim_cells) / (half_columns - rim_cells);
  return (rim + (1 - rim) * tau * (tau + crowding_cell) / (1 + crowding_cell)) * half_pi;
}

}  // namespace

/// Columns of every slice in the height pi/2 - |phi|, which a float states exactly where it matters, at the horizon.
/// Column b of y < 0 lies between the heights edge[b] and edge[b + 1]; the columns of y > 0 follow from the zenith
/// down.
struct ColumnGrid {
  std::array<float, half_columns + 1> edge;
  std::array<float, half_columns> ceiling;       ///< edge[b + 1]; above every height for the last
  std::array<float, half_columns> inverse_area;  ///< 1 / (d theta d phi) of a cell times 2^-32
  std::array<std::uint8_t, guides + 1> guide;    ///< first column that an equal share of the height meets

  /// The edges as stored decide, so that the density is exactly the one drawn from. No share meets more than two
  /// edges.
  int cell(float height) const {
    int b = guide[size_t(std::min(int(height * float(guides / half_pi)), guides))];
    b += height >= ceiling[size_t(b)] ? 1 : 0;
    return b + (height >= ceiling[size_t(b)] ? 1 : 0);
  }
};

namespace {

const ColumnGrid& column_grid() {
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

float wrap_theta(float theta) {
  constexpr float quarter = float(half_pi);
  if (theta >= quarter) theta -= pi;
  if (theta < -quarter) theta += pi;
  return theta;
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
    const double phi = crowded_angle(node_place(node % table.phi_nodes, table.phi_nodes, mirror_y), crowding_view);
    const double theta = theta_of(node_place(node / table.phi_nodes, table.s_nodes, mirror_x), phi);
    table.node_theta[node] = float(theta);
    SliceMaker maker{threads, volume_warp, volume_weft, {}};
    std::uint32_t* cumulative = &table.cumulative[size_t(node) * (cells + 1)];
    maker.make(theta, phi, cumulative);
    for (int a = 0; a < theta_cells; ++a)
      table.row_start[size_t(node) * theta_cells + size_t(a)] = cumulative[a * phi_cells];
  });
  return table;
}

std::vector<float> column_heights() {
  const ColumnGrid& grid = column_grid();
  return {grid.edge.begin(), grid.edge.end()};
}

TableView prepare_table(const DirectionTable& table, const Vec3& wo) {
  TableView view;
  view.columns = &column_grid();
  view.flip_x = table.mirror_x && wo.x < 0 ? -1.0f : 1.0f;
  view.flip_y = table.mirror_y && wo.y < 0 ? -1.0f : 1.0f;
  const float x = wo.x * view.flip_x, y = wo.y * view.flip_y;
  const Angles angles = right_angles(x, std::sqrt(y * y + wo.z * wo.z), x, wo.z, y, wo.z);
  const float theta = angles.a, s = (theta + angles.b) * (1 / pi);
  const float i = node_index(place_of_s(s), table.s_nodes, table.mirror_x);
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
  const Angles angles = right_angles(x, cos_theta, wi.z, std::abs(y));
  const int height = view.columns->cell(angles.b), column = y < 0 ? height : phi_cells - 1 - height;
  // A turn is half a circle at most: one more keeps the row positive.
  const float row = angles.a * float(theta_cells / (2 * half_pi)) + 1.5f * theta_cells;
  float density = 0;
  for (int k = 0; k < 4; ++k) {
    int a = int(row + view.turn[k] * float(theta_cells / (2 * half_pi)));
    a -= a >= theta_cells ? theta_cells : 0;
    a -= a >= theta_cells ? theta_cells : 0;
    const std::uint32_t* entry = view.slice[k] + (a * phi_cells + column);
    density += view.share[k] * float(entry[1] - entry[0]);
  }
  return density * view.columns->inverse_area[size_t(height)] / std::max(cos_theta, 1e-12f);
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

  constexpr double below_one = 0x1.fffffep-1;
  const ColumnGrid& grid = *view.columns;
  const float theta_node = float(-half_pi + (a + std::clamp(in_row, 0.0, below_one)) * (2 * half_pi / theta_cells));
  const float theta = wrap_theta(theta_node - view.turn[k]);
  const size_t b = size_t(std::min(low, phi_cells - 1 - low));
  const float height = grid.edge[b] + float(std::clamp(in_cell, 0.0, below_one)) * (grid.edge[b + 1] - grid.edge[b]);
  const Lanes angles = Lanes::of(theta, height, 0, 0);
  float sine[8], cosine[8];
  sin_quarter(angles).store(sine);
  cos_quarter(angles).store(cosine);
  const float across = std::max(cosine[0], 0.0f), side = low < half_columns ? -view.flip_y : view.flip_y;
  return {view.flip_x * sine[0], side * across * cosine[1], std::max(across * sine[1], 1e-9f)};
}

}  // namespace sateen
