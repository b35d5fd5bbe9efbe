#include "fabric/direction_grid.h"
#include "math/lane_functions.h"

namespace sateen {

namespace {

using namespace direction_grid;

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

/// Where the shares of the first three slices end, one after the other; behind the last that has a share, nowhere.
using SliceEnds = std::array<float, 3>;
SliceEnds slice_ends(const TableView& view) {
  SliceEnds ends;
  float end = 0;
  for (int k = 0; k < 3; ++k) ends[size_t(k)] = end += view.share[k];
  for (int k = 2; k >= 0 && view.share[k + 1] == 0; --k) ends[size_t(k)] = 2;
  return ends;
}

/// A direction in a slice as it is drawn: angles, and on which side of the warp.
struct DrawnAngles {
  float theta, height, side;
};
DrawnAngles draw_angles(const TableView& view, const SliceEnds& ends, double u_view, double u_theta, double u_phi) {
  const int k = (float(u_view) >= ends[0]) + (float(u_view) >= ends[1]) + (float(u_view) >= ends[2]);
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
  const size_t b = size_t(std::min(low, phi_cells - 1 - low));
  return {wrap_theta(theta_node - view.turn[k]),
          grid.edge[b] + float(std::clamp(in_cell, 0.0, below_one)) * (grid.edge[b + 1] - grid.edge[b]),
          low < half_columns ? -view.flip_y : view.flip_y};
}

}  // namespace

TableView prepare_table(const DirectionTable& table, const Vec3& wo) {
  TableView view;
  view.columns = &column_grid();
  view.flip_x = table.mirror_x && wo.x < 0 ? -1.0f : 1.0f;
  view.flip_y = table.mirror_y && wo.y < 0 ? -1.0f : 1.0f;
  const float x = wo.x * view.flip_x, y = wo.y * view.flip_y;
  const Angles angles = right_angles(x, std::sqrt(y * y + wo.z * wo.z), x, wo.z, y, wo.z);
  const float theta = angles.a, s = (theta + angles.b) * (1 / pi);
  const float i = node_index(place_of_s(s), table.s_nodes, table.mirror_x);
  const float j = node_index(place_of_phi(angles.c), table.phi_nodes, table.mirror_y);
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

void table_pdfs(const TableView& view, std::span<const Vec3> wi, float* densities) {
  constexpr size_t width = Lanes::width;
  for (size_t from = 0; from < wi.size(); from += width) {
    const size_t count = std::min(wi.size() - from, width);
    float x[width], y[width], z[width], theta[width], height[width], across[width];
    for (size_t i = 0; i < width; ++i) {
      const Vec3& direction = wi[from + std::min(i, count - 1)];
      x[i] = direction.x * view.flip_x;
      y[i] = direction.y * view.flip_y;
      z[i] = direction.z;
    }
    const Lanes side = Lanes::load(y), up = Lanes::load(z), tiny(1e-30f);
    const Lanes cosine = sqrt(side * side + up * up);
    atan_magnitude(Lanes::load(x), max(cosine, tiny)).store(theta);
    atan_magnitude(up, max(abs(side), tiny)).store(height);
    cosine.store(across);
    int column[width], b[width];
    float row[width], density[width] = {};
    for (size_t i = 0; i < width; ++i) {
      b[i] = view.columns->cell(height[i]);
      column[i] = y[i] < 0 ? b[i] : phi_cells - 1 - b[i];
      // A turn is half a circle at most: one more keeps the row positive.
      row[i] = std::copysign(theta[i], x[i]) * float(theta_cells / (2 * half_pi)) + 1.5f * theta_cells;
    }
    for (int k = 0; k < 4; ++k) {
      const float turn = view.turn[k] * float(theta_cells / (2 * half_pi));
      int cell[width];
      std::uint32_t mass[width];
      for (size_t i = 0; i < width; ++i) {
        int a = int(row[i] + turn);
        a -= a >= theta_cells ? theta_cells : 0;
        a -= a >= theta_cells ? theta_cells : 0;
        cell[i] = a * phi_cells + column[i];
      }
      for (size_t i = 0; i < width; ++i) {
        const std::uint32_t* entry = view.slice[k] + cell[i];
        mass[i] = entry[1] - entry[0];
      }
      for (size_t i = 0; i < width; ++i) density[i] += view.share[k] * float(mass[i]);
    }
    for (size_t i = 0; i < count; ++i)
      densities[from + i] =
          z[i] > 0 ? density[i] * view.columns->inverse_area[size_t(b[i])] / std::max(across[i], 1e-12f) : 0;
  }
}

float table_pdf(const TableView& view, const Vec3& wi) {
  float density;
  table_pdfs(view, {&wi, 1}, &density);
  return density;
}

void sample_table(const TableView& view, std::span<const double> u_view, std::span<const std::array<double, 2>> u,
                  Vec3* directions) {
  constexpr size_t width = Lanes::width;
  const SliceEnds ends = slice_ends(view);
  for (size_t from = 0; from < u.size(); from += width) {
    const size_t count = std::min(u.size() - from, width);
    float theta[width] = {}, height[width] = {}, side[width];
    for (size_t i = 0; i < count; ++i) {
      const DrawnAngles drawn = draw_angles(view, ends, u_view[from + i], u[from + i][0], u[from + i][1]);
      theta[i] = drawn.theta, height[i] = drawn.height, side[i] = drawn.side;
    }
    float sine[width], across[width], along[width], up[width];
    sin_quarter(Lanes::load(theta)).store(sine);
    const Lanes cosine = max(cos_quarter(Lanes::load(theta)), Lanes(0.0f)), heights = Lanes::load(height);
    cosine.store(across);
    cos_quarter(heights).store(along);
    max(cosine * sin_quarter(heights), Lanes(1e-9f)).store(up);
    for (size_t i = 0; i < count; ++i)
      directions[from + i] = {view.flip_x * sine[i], side[i] * across[i] * along[i], up[i]};
  }
}

Vec3 sample_table(const TableView& view, double u_view, double u_theta, double u_phi) {
  Vec3 direction;
  const std::array<double, 2> u{u_theta, u_phi};
  sample_table(view, {&u_view, 1}, {&u, 1}, &direction);
  return direction;
}

}  // namespace sateen
