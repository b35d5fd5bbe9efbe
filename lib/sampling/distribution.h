#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/shared_array.h"

namespace sateen {

/// Piecewise-constant distribution over `starts.size()` cells, drawn by inversion. The cumulative table is fixed
/// point on a scale of 2^32: cell i owns the integers [starts[i], starts[i + 1]), the last cell that owns any ends
/// at 2^32. Every positive weight owns at least one, so nothing that has a weight is unreachable; the probability
/// is that integer count / 2^32, so it is the density drawn and not an approximation of it.
struct Distribution1D {
  SharedArray<std::uint32_t> starts;
  std::uint32_t used = 0;  ///< one past the last cell of positive weight; 0: all weights are zero, nothing to draw
  /// Where to begin: for each of 2^n equal parts of u, some eight cells wide, the cell at the part's beginning, and
  /// the last cell. Without it the search misses the cache, or its branches, at nearly every step.
  SharedArray<std::uint32_t> guide;
};

/// Distribution over width x height cells: a row by the marginal, then a column by that row's conditional table
/// (4 bytes a cell and 1 for its guide, row-major, 64-bit index).
struct Distribution2D {
  int width = 0, height = 0;
  Distribution1D rows;
  SharedArray<std::uint32_t> starts;  ///< width * height
  SharedArray<std::uint32_t> used;    ///< per row, as Distribution1D::used
  SharedArray<std::uint32_t> guide;   ///< of each row, as Distribution1D::guide; a quarter of the table's size
  std::size_t guide_parts = 1;        ///< of u, of each row
};

struct CellSample {
  std::uint32_t cell = 0;
  double offset = 0;       ///< position in the cell, [0, 1): what inversion leaves of u
  double probability = 0;  ///< 0 where there is nothing to draw
};

struct CellSample2D {
  std::uint32_t x = 0, y = 0;
  double offset_x = 0, offset_y = 0;
  double probability = 0;
};

/// Fills one cumulative table from weights (finite, not negative; at most 2^31 of them) and returns `used`. A
/// subnormal sum is fine: weights are scaled by their largest first.
std::uint32_t tabulate(std::span<const double> weights, std::span<std::uint32_t> starts);

/// `u` in [0, 1), of which 32 bits choose the cell. Draws from one table as made by `tabulate`.
CellSample sample_table(std::span<const std::uint32_t> starts, std::uint32_t used, double u);

/// The same with a guide.
CellSample sample_table(std::span<const std::uint32_t> starts, std::uint32_t used, double u,
                        std::span<const std::uint32_t> guide);

/// Equal parts of u that the guide of so many cells has.
std::size_t guide_parts(std::size_t cells);

/// Fills the entries of a guide, one more than it has parts.
void tabulate_guide(std::span<const std::uint32_t> starts, std::uint32_t used, std::span<std::uint32_t> guide);

/// Probability of a cell of one table; 0 out of range.
double table_probability(std::span<const std::uint32_t> starts, std::uint32_t used, std::uint32_t cell);

Distribution1D build_distribution(std::span<const double> weights);
CellSample sample_cell(const Distribution1D& distribution, double u);
double cell_probability(const Distribution1D& distribution, std::uint32_t cell);

/// `row_weights(y, out)` fills the `width` weights of row y; called once a row, top first, so that a map of any
/// size needs no second copy of its weights.
template <class RowWeights>
Distribution2D build_distribution(int width, int height, RowWeights&& row_weights);

CellSample2D sample_cell(const Distribution2D& distribution, double u0, double u1);
/// The same for many, the same bits: looked up side by side, in half of the time.
void sample_cells(const Distribution2D& distribution, std::span<const std::array<double, 2>> u, CellSample2D* out);
double cell_probability(const Distribution2D& distribution, std::uint32_t x, std::uint32_t y);

inline bool drawable(const Distribution1D& d) {
  return d.used > 0;
}
inline bool drawable(const Distribution2D& d) {
  return d.rows.used > 0;
}

template <class RowWeights>
Distribution2D build_distribution(int width, int height, RowWeights&& row_weights) {
  Distribution2D d;
  d.width = width;
  d.height = height;
  const std::span<std::uint32_t> starts = d.starts.make(std::size_t(width) * std::size_t(height));
  const std::span<std::uint32_t> used = d.used.make(std::size_t(height));
  d.guide_parts = guide_parts(std::size_t(width));
  const std::size_t entries = d.guide_parts + 1;
  const std::span<std::uint32_t> guide = d.guide.make(entries * std::size_t(height));
  std::vector<double> weights(static_cast<std::size_t>(width)), sums(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    row_weights(y, std::span<double>(weights));
    const std::size_t first = std::size_t(y) * std::size_t(width);
    used[std::size_t(y)] = tabulate(weights, starts.subspan(first, std::size_t(width)));
    tabulate_guide(starts.subspan(first, std::size_t(width)), used[std::size_t(y)],
                   guide.subspan(std::size_t(y) * entries, entries));
    for (const double w : weights) sums[std::size_t(y)] += w;
  }
  d.rows = build_distribution(sums);
  return d;
}

}  // namespace sateen
