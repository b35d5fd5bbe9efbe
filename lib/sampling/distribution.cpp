#include "sampling/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sateen {

namespace {
constexpr double scale = 4294967296.0;

std::uint64_t end_of(const std::uint32_t* starts, std::uint32_t used, std::uint32_t cell) {
  return cell + 1 == used ? (std::uint64_t(1) << 32) : starts[cell + 1];
}

/// One look-up in a table: the cell that owns x lies among `length` cells from `first` on.
struct Search {
  const std::uint32_t* first;
  std::uint32_t length, key;
  double x;
};

Search begin_search(const std::uint32_t* starts, double u, const std::uint32_t* guide, std::size_t parts) {
  const double below_one = std::clamp(u, 0.0, 1.0 - 0x1p-53);
  const auto part = std::size_t(below_one * double(parts));
  const double x = below_one * scale;
  return {starts + guide[part], guide[part + 1] - guide[part] + 1, std::uint32_t(x), x};
}

/// Narrows all of them down to the last cell that starts at or before the key; equal starts are empty cells followed
/// by the one that owns them. In step: their ways to memory overlap, and what is done with early does nothing.
void find_cells(std::span<Search> searches) {
  std::uint32_t longest = 1;
  for (const Search& search : searches) longest = std::max(longest, search.length);
  for (; longest > 1; longest -= longest / 2)
    for (Search& search : searches) {
      const std::uint32_t half = search.length / 2;
      search.first = search.first[half] <= search.key ? search.first + half : search.first;
      search.length -= half;
    }
}

CellSample found_cell(const Search& search, const std::uint32_t* starts, std::uint32_t used) {
  const auto cell = std::uint32_t(search.first - starts);
  const std::uint64_t start = starts[cell], count = end_of(starts, used, cell) - start;
  return {cell, std::min((search.x - double(start)) / double(count), 1.0 - 0x1p-53), double(count) / scale};
}

}  // namespace

std::uint32_t tabulate(std::span<const double> weights, std::span<std::uint32_t> starts) {
  assert(weights.size() == starts.size() && weights.size() <= (std::size_t(1) << 31));
  double largest = 0;
  std::uint64_t positive = 0;
  std::uint32_t used = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    assert(std::isfinite(weights[i]) && weights[i] >= 0);
    if (!(weights[i] > 0)) continue;
    largest = std::max(largest, weights[i]);
    ++positive;
    used = std::uint32_t(i + 1);
  }
  if (used == 0) {
    std::fill(starts.begin(), starts.end(), 0u);
    return 0;
  }
  // A power of two keeps the quotients exact; it stays in range where 1 / largest would overflow.
  const int exponent = std::ilogb(largest);
  const auto scaled = [&](std::size_t i) { return std::scalbn(weights[i], -exponent); };
  double sum = 0;
  for (std::size_t i = 0; i < used; ++i) sum += scaled(i);
  // One integer for each positive weight, the rest shared in proportion. The running sum is the same one that made
  // `sum`, so its last value over `sum` is exactly 1 and the table ends at 2^32 without a correction.
  const double shared = scale - double(positive);
  double running = 0;
  std::uint64_t ones = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    starts[i] = i < used ? std::uint32_t(ones + std::uint64_t(running / sum * shared)) : 0xffffffffu;
    if (i < used && weights[i] > 0) {
      running += scaled(i);
      ++ones;
    }
  }
  return used;
}

CellSample sample_table(std::span<const std::uint32_t> starts, std::uint32_t used, double u,
                        std::span<const std::uint32_t> guide) {
  if (used == 0) return {};
  Search search = begin_search(starts.data(), u, guide.data(), guide.size() - 1);
  find_cells({&search, 1});
  return found_cell(search, starts.data(), used);
}

CellSample sample_table(std::span<const std::uint32_t> starts, std::uint32_t used, double u) {
  const std::uint32_t whole[] = {0, used - 1};
  return sample_table(starts, used, u, whole);
}

std::size_t guide_parts(std::size_t cells) {
  std::size_t parts = 1;
  while (parts < (std::size_t(1) << 20) && 8 * parts <= cells) parts *= 2;
  return parts;
}

void tabulate_guide(std::span<const std::uint32_t> starts, std::uint32_t used, std::span<std::uint32_t> guide) {
  const std::size_t parts = guide.size() - 1;
  std::uint32_t cell = 0;
  for (std::size_t k = 0; k < parts; ++k) {
    const std::uint64_t key = (std::uint64_t(k) << 32) / parts;
    while (cell + 1 < used && starts[cell + 1] <= key) ++cell;
    guide[k] = cell;
  }
  guide[parts] = used > 0 ? used - 1 : 0;
}

double table_probability(std::span<const std::uint32_t> starts, std::uint32_t used, std::uint32_t cell) {
  if (cell >= used) return 0;
  return double(end_of(starts.data(), used, cell) - starts[cell]) / scale;
}

Distribution1D build_distribution(std::span<const double> weights) {
  Distribution1D d;
  const std::span<std::uint32_t> starts = d.starts.make(weights.size());
  d.used = tabulate(weights, starts);
  tabulate_guide(starts, d.used, d.guide.make(guide_parts(weights.size()) + 1));
  return d;
}

CellSample sample_cell(const Distribution1D& d, double u) {
  return sample_table(d.starts, d.used, u, d.guide);
}

double cell_probability(const Distribution1D& d, std::uint32_t cell) {
  return table_probability(d.starts, d.used, cell);
}

void sample_cells(const Distribution2D& d, std::span<const std::array<double, 2>> u, CellSample2D* out) {
  constexpr std::size_t together = 16;
  if (!drawable(d)) return void(std::fill_n(out, u.size(), CellSample2D{}));
  const std::size_t width = std::size_t(d.width), entries = d.guide_parts + 1;
  for (; !u.empty(); out += together, u = u.subspan(std::min(u.size(), together))) {
    const std::size_t count = std::min(u.size(), together);
    std::array<Search, together> search;
    for (std::size_t k = 0; k < count; ++k)
      search[k] = begin_search(d.rows.starts.data(), u[k][1], d.rows.guide.data(), d.rows.guide.size() - 1);
    find_cells({search.data(), count});
    for (std::size_t k = 0; k < count; ++k) {
      const CellSample row = found_cell(search[k], d.rows.starts.data(), d.rows.used);
      out[k] = {0, row.cell, 0, row.offset, row.probability};
      search[k] = begin_search(d.starts.data() + row.cell * width, u[k][0], d.guide.data() + row.cell * entries,
                               d.guide_parts);
    }
    find_cells({search.data(), count});
    for (std::size_t k = 0; k < count; ++k) {
      CellSample2D& cell = out[k];
      const CellSample column = found_cell(search[k], d.starts.data() + cell.y * width, d.used[cell.y]);
      cell.x = column.cell;
      cell.offset_x = column.offset;
      cell.probability *= column.probability;
    }
  }
}

CellSample2D sample_cell(const Distribution2D& d, double u0, double u1) {
  CellSample2D cell;
  const std::array u{u0, u1};
  sample_cells(d, {&u, 1}, &cell);
  return cell;
}

double cell_probability(const Distribution2D& d, std::uint32_t x, std::uint32_t y) {
  if (x >= std::uint32_t(d.width) || y >= std::uint32_t(d.height)) return 0;
  const auto width = std::size_t(d.width);
  return cell_probability(d.rows, y) * table_probability({d.starts.data() + y * width, width}, d.used[y], x);
}

}  // namespace sateen
