#include "sampling/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sateen {

namespace {
constexpr double scale = 4294967296.0;

std::uint64_t end_of(std::span<const std::uint32_t> starts, std::uint32_t used, std::uint32_t cell) {
  return cell + 1 == used ? (std::uint64_t(1) << 32) : starts[cell + 1];
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
  const double below_one = std::clamp(u, 0.0, 1.0 - 0x1p-53);
  const auto part = std::size_t(below_one * double(guide.size() - 1));
  const double x = below_one * scale;
  const auto key = std::uint32_t(x);
  // The last cell that starts at or before the key; equal starts are empty cells followed by the one that owns them.
  const std::uint32_t* first = starts.data() + guide[part];
  std::uint32_t length = guide[part + 1] - guide[part] + 1;
  while (length > 1) {
    const std::uint32_t half = length / 2;
    first = first[half] <= key ? first + half : first;
    length -= half;
  }
  const auto cell = std::uint32_t(first - starts.data());
  const std::uint64_t start = starts[cell], count = end_of(starts, used, cell) - start;
  return {cell, std::min((x - double(start)) / double(count), 1.0 - 0x1p-53), double(count) / scale};
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
  return double(end_of(starts, used, cell) - starts[cell]) / scale;
}

Distribution1D build_distribution(std::span<const double> weights) {
  Distribution1D d;
  d.starts.resize(weights.size());
  d.used = tabulate(weights, d.starts);
  d.guide.resize(guide_parts(weights.size()) + 1);
  tabulate_guide(d.starts, d.used, d.guide);
  return d;
}

CellSample sample_cell(const Distribution1D& d, double u) {
  return sample_table(d.starts, d.used, u, d.guide);
}

double cell_probability(const Distribution1D& d, std::uint32_t cell) {
  return table_probability(d.starts, d.used, cell);
}

CellSample2D sample_cell(const Distribution2D& d, double u0, double u1) {
  const CellSample row = sample_cell(d.rows, u1);
  if (row.probability == 0) return {};
  const auto width = std::size_t(d.width);
  const std::span guide = std::span(d.guide).subspan(row.cell * (d.guide_parts + 1), d.guide_parts + 1);
  const CellSample column = sample_table({d.starts.data() + row.cell * width, width}, d.used[row.cell], u0, guide);
  return {column.cell, row.cell, column.offset, row.offset, row.probability * column.probability};
}

double cell_probability(const Distribution2D& d, std::uint32_t x, std::uint32_t y) {
  if (x >= std::uint32_t(d.width) || y >= std::uint32_t(d.height)) return 0;
  const auto width = std::size_t(d.width);
  return cell_probability(d.rows, y) * table_probability({d.starts.data() + y * width, width}, d.used[y], x);
}

}  // namespace sateen
