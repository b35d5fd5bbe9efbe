#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fabric/threads.h"
#include "math/vector.h"

namespace sateen {

/// F of one look tabulated as a density of directions (cloth-model.md section 6), for sampling and as a cheap
/// stand-in for F. A slice of directions for every view node, laid out in the warp's coordinates theta = asin(w.x),
/// phi = atan2(w.y, w.z), where the lobes run along the grid; inside a cell uniform in theta and phi.
///
/// Four things make a small table enough, all measured (docs/numbers.md):
/// - view nodes lie in s = (theta_r + psi_r)/pi with psi_r = atan2(w.x, w.z), and in phi_r, both crowded towards the
/// horizon:
///   Q turns with psi_r, the lobes with theta_r, and s resolves both;
/// - a slice is turned about by theta_r - theta_node before use, so that the lobes of neighbouring views lie on each
/// other;
/// - the outer three columns on either side are 0.005, 0.075 and 0.72 degrees wide: where Q vanishes towards the
/// horizon,
///   F goes like the inverse of the height over it;
/// - a look that is its own mirror image in x or in y needs half the views in that axis.
struct DirectionTable {
  static constexpr int theta_cells = 64, phi_cells = 40, cells = theta_cells * phi_cells;

  bool mirror_x = false, mirror_y = false;  ///< tabulated for w.x >= 0 or w.y >= 0 alone
  int s_nodes = 0, phi_nodes = 0;           ///< 2 or more
  std::vector<float> node_theta;            ///< theta of view node [s][phi]
  std::vector<std::uint32_t> cumulative;    ///< [s][phi][cells + 1], 2^32 scale; the last entry, 2^32, is stored as 0
  std::vector<std::uint32_t> row_start;     ///< [s][phi][theta_cells]: every phi_cells-th of those, side by side
};

struct ColumnGrid;

/// The four slices around a view with their shares, and the turn of each.
struct TableView {
  const ColumnGrid* columns = nullptr;  ///< the same for every table
  const std::uint32_t* slice[4];
  const std::uint32_t* row_start[4];
  float share[4];  ///< sum to 1
  float turn[4];   ///< theta of the view minus theta of the node [radians]
  float flip_x = 1, flip_y = 1;
};

/// Tabulates S_0 + S_1 + a_0 V_0 + a_1 V_1 with the volume colours' means a. Deterministic. `size` times the usual
/// number of views in either axis.
DirectionTable tabulate_directions(const Threads<float>& threads, float volume_warp, float volume_weft, bool mirror_x,
                                   bool mirror_y, int threads_used = 1, double size = 1);

/// Heights [radians] over the horizon of the columns' edges, 0 to pi/2, on either side of the warp. Rows are
/// theta_cells equal parts of theta + turn, wrapped. Inside a cell the density times cos theta is constant for each
/// of the four slices.
std::vector<float> column_heights();

/// For a unit wo with wo.z > 0.
TableView prepare_table(const DirectionTable& table, const Vec3& wo);

/// Solid-angle density [1/sr] of `sample_table`; 0 below the horizon.
float table_pdf(const TableView& view, const Vec3& wi);

/// The same for many directions of one view, the same bits in half of the time.
void table_pdfs(const TableView& view, std::span<const Vec3> wi, float* densities);

/// u_view chooses the slice, u_theta and u_phi the direction; all in [0, 1) with up to 32 bits.
Vec3 sample_table(const TableView& view, double u_view, double u_theta, double u_phi);

/// The same for many, `u` holding theta's and phi's: the same bits.
void sample_table(const TableView& view, std::span<const double> u_view, std::span<const std::array<double, 2>> u,
                  Vec3* directions);

}  // namespace sateen
