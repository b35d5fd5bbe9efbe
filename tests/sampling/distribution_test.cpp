#include "sampling/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>

#include "sampling/chi_square.h"

namespace sateen {
namespace {

constexpr double just_below_one = 1.0 - 0x1p-53;

double total(const Distribution1D& d) {
  double sum = 0;
  for (std::uint32_t i = 0; i < d.starts.size(); ++i) sum += cell_probability(d, i);
  return sum;
}

double total(const Distribution2D& d) {
  double sum = 0;
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x) sum += cell_probability(d, std::uint32_t(x), std::uint32_t(y));
  return sum;
}

Distribution2D build(int width, int height, const std::vector<double>& weights) {
  return build_distribution(width, height, [&](int y, std::span<double> out) {
    for (int x = 0; x < width; ++x) out[size_t(x)] = weights[size_t(y) * size_t(width) + size_t(x)];
  });
}

TEST(Distribution, SumsToExactlyOneForAnyWeights) {
  std::mt19937 random(7);
  std::lognormal_distribution<double> wide(0, 8);
  for (int size : {1, 2, 3, 7, 100, 4096, 10007}) {
    std::vector<double> weights(static_cast<size_t>(size));
    for (double& w : weights) w = random() % 3 ? wide(random) : 0.0;
    weights[size_t(size) / 2] = 1;
    // Integer counts over 2^32 add up without rounding.
    EXPECT_EQ(total(build_distribution(weights)), 1.0) << size;
  }
}

TEST(Distribution, GivesProbabilitiesInProportionToTheWeights) {
  const std::vector<double> weights{1, 0, 2, 5, 0, 0, 8, 0};
  const Distribution1D d = build_distribution(weights);
  for (std::uint32_t i = 0; i < weights.size(); ++i) EXPECT_NEAR(cell_probability(d, i), weights[i] / 16, 2e-9) << i;
}

TEST(Distribution, NeverDrawsAZeroWeightAndReachesEveryPositiveOne) {
  // Weights that differ by 1e300 still own one integer each, and the ends of u land on cells that have a weight.
  const std::vector<double> weights{0, 0, 1e-300, 0, 1, 0, 1e-310, 0, 0};
  const Distribution1D d = build_distribution(weights);
  for (std::uint32_t i = 0; i < weights.size(); ++i) {
    if (weights[i] > 0)
      EXPECT_GE(cell_probability(d, i), 0x1p-32) << i;
    else
      EXPECT_EQ(cell_probability(d, i), 0) << i;
  }
  EXPECT_EQ(sample_cell(d, 0.0).cell, 2u);
  EXPECT_EQ(sample_cell(d, 0x1p-32).cell, 4u);
  EXPECT_EQ(sample_cell(d, 0.5).cell, 4u);
  EXPECT_EQ(sample_cell(d, just_below_one).cell, 6u);
}

TEST(Distribution, ReportsAllZeroWeightsAsNothingToDraw) {
  for (size_t size : {size_t(0), size_t(1), size_t(5)}) {
    const Distribution1D d = build_distribution(std::vector<double>(size, 0.0));
    EXPECT_FALSE(drawable(d));
    EXPECT_EQ(sample_cell(d, 0.3).probability, 0);
    EXPECT_EQ(cell_probability(d, 0), 0);
  }
  const Distribution2D d = build(3, 2, std::vector<double>(6, 0.0));
  EXPECT_FALSE(drawable(d));
  EXPECT_EQ(sample_cell(d, 0.3, 0.9).probability, 0);
}

TEST(Distribution, InvertsTheCumulativeTableWithItsRemainder) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> weights(257);
  for (double& w : weights) w = random() % 4 ? uniform(random) : 0.0;
  const Distribution1D d = build_distribution(weights);
  std::vector<double> below(weights.size() + 1, 0.0);
  for (std::uint32_t i = 0; i < weights.size(); ++i) below[i + 1] = below[i] + cell_probability(d, i);
  for (int k = 0; k < 100000; ++k) {
    const double u = uniform(random);
    const CellSample s = sample_cell(d, u);
    ASSERT_GT(s.probability, 0);
    ASSERT_EQ(s.probability, cell_probability(d, s.cell));
    ASSERT_GE(s.offset, 0);
    ASSERT_LT(s.offset, 1);
    ASSERT_NEAR(below[s.cell] + s.offset * s.probability, u, 1e-15);
  }
}

TEST(Distribution, StaysInRangeAtTheEndsOfU) {
  const Distribution1D d = build_distribution(std::vector<double>{0.1, 0.2, 0.3});
  for (double u : {0.0, 0x1p-60, 0x1p-32, 0.5, 1 - 0x1p-32, just_below_one, 1.0}) {
    const CellSample s = sample_cell(d, u);
    EXPECT_LT(s.cell, 3u);
    EXPECT_GE(s.offset, 0);
    EXPECT_LT(s.offset, 1);
  }
}

TEST(Distribution, KeepsTheStrataOfAStratifiedSequence) {
  // Inversion is monotonic: one point a stratum gives each cell its share of points to within one.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> weights(40);
  for (double& w : weights) w = uniform(random);
  const Distribution1D d = build_distribution(weights);
  constexpr int points = 4096;
  std::vector<int> counts(weights.size(), 0);
  std::uint32_t last = 0;
  for (int i = 0; i < points; ++i) {
    const CellSample s = sample_cell(d, (i + uniform(random)) / points);
    ASSERT_GE(s.cell, last);
    last = s.cell;
    ++counts[s.cell];
  }
  for (std::uint32_t i = 0; i < counts.size(); ++i) EXPECT_NEAR(counts[i], points * cell_probability(d, i), 2.0) << i;
}

TEST(Distribution, WorksForEveryShapeInTwoDimensions) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  const int shapes[][2] = {{1, 1}, {1, 9}, {9, 1}, {2, 2}, {31, 17}, {1024, 3}};
  for (const auto& shape : shapes) {
    std::vector<double> weights(static_cast<size_t>(shape[0]) * static_cast<size_t>(shape[1]));
    for (double& w : weights) w = uniform(random);
    const Distribution2D d = build(shape[0], shape[1], weights);
    EXPECT_NEAR(total(d), 1, 1e-12);
    for (int k = 0; k < 2000; ++k) {
      const CellSample2D s = sample_cell(d, uniform(random), uniform(random));
      ASSERT_LT(s.x, std::uint32_t(shape[0]));
      ASSERT_LT(s.y, std::uint32_t(shape[1]));
      ASSERT_EQ(s.probability, cell_probability(d, s.x, s.y));
    }
  }
}

TEST(Distribution, FindsTheSameCellWithItsGuideAsWithout) {
  std::mt19937 random(23);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int width : {1, 7, 8, 9, 100, 1024}) {
    std::vector<double> weights(static_cast<size_t>(width) * 3);
    // Some rows even, some of one dominant cell, some with empty ends.
    for (size_t i = 0; i < weights.size(); ++i) weights[i] = random() % 3 ? std::pow(uniform(random), 20) : 0.0;
    weights[size_t(width) / 2] = 1;
    const Distribution2D d = build(width, 3, weights);
    for (int k = 0; k < 30000; ++k) {
      const double v = uniform(random);
      // The borders of the guide's parts and their neighbours, then anything.
      const double border = double(k % 257) / 256;
      const double u = k < 771 ? std::clamp(border + (k / 257 - 1) * 0x1p-32, 0.0, just_below_one) : uniform(random);
      const CellSample2D with = sample_cell(d, u, v);
      if (with.probability == 0) continue;
      const auto row = std::span(d.starts).subspan(size_t(with.y) * size_t(width), size_t(width));
      const CellSample without = sample_table(row, d.used[with.y], u);
      ASSERT_EQ(with.x, without.cell) << width << " " << u;
      ASSERT_EQ(with.offset_x, without.offset);
    }
  }
}

TEST(Distribution, IsZeroOutsideItsCells) {
  const Distribution2D d = build(2, 2, {1, 1, 1, 1});
  EXPECT_EQ(cell_probability(d, 2, 0), 0);
  EXPECT_EQ(cell_probability(d, 0, 2), 0);
}

// False-alarm rate: 1e-4 over both seeds together (fixed, so it either always passes or never).
TEST(Distribution, DrawsWhatItSaysInTwoDimensions) {
  std::mt19937 random(19);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int width = 37, height = 21, draws = 1000000;
  std::vector<double> weights(width * height);
  for (double& w : weights) w = random() % 3 ? std::pow(uniform(random), 6) : 0.0;
  const Distribution2D d = build(width, height, weights);
  std::vector<double> counts(weights.size(), 0.0), expected(weights.size());
  for (int k = 0; k < draws; ++k) {
    const CellSample2D s = sample_cell(d, uniform(random), uniform(random));
    ++counts[s.y * width + s.x];
  }
  for (std::uint32_t i = 0; i < weights.size(); ++i) expected[i] = draws * cell_probability(d, i % width, i / width);
  EXPECT_GT(sateen_test::chi_square_test(counts, expected), 1e-4);
  // The test must be able to fail: the same counts against the neighbour's density.
  std::rotate(expected.begin(), expected.begin() + 1, expected.end());
  EXPECT_LT(sateen_test::chi_square_test(counts, expected), 1e-4);
}

TEST(Distribution, HoldsAMapSixteenThousandWide) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "half a gigabyte: set SATEEN_LONG_TESTS";
  constexpr int width = 16384, height = 8192;
  const auto weight = [](int x, int y) { return 1.0 + ((x * 7 + y * 13) % 64); };
  const Distribution2D d = build_distribution(width, height, [&](int y, std::span<double> out) {
    for (int x = 0; x < width; ++x) out[size_t(x)] = weight(x, y);
  });
  EXPECT_EQ(d.starts.size() * 4, std::size_t(width) * height * 4);
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) sum += weight(x, y);
  for (int y : {0, 1, 4095, 8190, 8191})
    for (int x : {0, 1, 8191, 16382, 16383})
      EXPECT_NEAR(cell_probability(d, std::uint32_t(x), std::uint32_t(y)) * sum, weight(x, y), 2e-4 * weight(x, y));
  const CellSample2D last = sample_cell(d, just_below_one, just_below_one);
  EXPECT_EQ(last.x, 16383u);
  EXPECT_EQ(last.y, 8191u);
}

// Whatever their number; a row that is empty and one of a single cell among them.
TEST(Distribution2D, ManyAreDrawnAsOneAfterTheOther) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  const Distribution2D d = build_distribution(57, 9, [&](int y, std::span<double> row) {
    for (double& w : row) w = y == 3 ? 0 : std::pow(uniform(random), 12);
    if (y == 4) std::fill(row.begin() + 1, row.end(), 0.0);
  });
  for (const size_t count : {size_t(0), size_t(1), size_t(15), size_t(16), size_t(17), size_t(1000)}) {
    std::vector<std::array<double, 2>> u(count);
    for (auto& each : u) each = {uniform(random), uniform(random)};
    std::vector<CellSample2D> cells(count);
    sample_cells(d, u, cells.data());
    for (size_t k = 0; k < count; ++k) {
      const CellSample2D one = sample_cell(d, u[k][0], u[k][1]);
      EXPECT_EQ(cells[k].x, one.x);
      EXPECT_EQ(cells[k].y, one.y);
      EXPECT_EQ(cells[k].offset_x, one.offset_x);
      EXPECT_EQ(cells[k].offset_y, one.offset_y);
      EXPECT_EQ(cells[k].probability, one.probability);
      EXPECT_EQ(cells[k].probability, cell_probability(d, one.x, one.y));
    }
  }
}

}  // namespace
}  // namespace sateen
