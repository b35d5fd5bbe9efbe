#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "sampling/sampler.h"

namespace sateen {
namespace {

constexpr Dimension every_dimension[] = {Dimension::film,        Dimension::table,       Dimension::table_view,
                                         Dimension::talk,        Dimension::talk_thread, Dimension::uniform,
                                         Dimension::environment, Dimension::choice,      Dimension::gap,
                                         Dimension::roulette,    Dimension::lens,        Dimension::time};

TEST(Sobol, EveryAlignedBlockOfAPowerOfTwoIsANetInBaseTwo) {
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {319, 77}, {-3, 8000}})
    for (const Dimension dimension : every_dimension) {
      const Sequence sequence = pixel_sequence(5, x, y, 2, 1);
      for (int k = 0; k <= 10; ++k)
        for (const std::uint32_t first : {0u, 1u << k, 7u << k}) {
          std::vector<std::array<double, 2>> points(1u << k);
          for (std::uint32_t i = 0; i < points.size(); ++i) points[i] = draw2(sequence, dimension, first + i);
          // One point in each of the 2^k boxes of every shape 2^-a by 2^-(k - a).
          for (int a = 0; a <= k; ++a) {
            std::set<std::pair<int, int>> boxes;
            for (const auto& p : points) boxes.emplace(int(p[0] * (1 << a)), int(p[1] * (1 << (k - a))));
            ASSERT_EQ(boxes.size(), points.size()) << "k " << k << ", a " << a << ", pixel " << x << " " << y;
          }
        }
    }
}

TEST(Sobol, ABatchDrawsTheNumbersThatItsSamplesDrawAlone) {
  std::vector<SampleId> ids;
  for (int k = 0; k < batch_size; ++k) ids.push_back({17 * k - 40, k * k * k, k % 5, std::uint32_t(k * k * 12345)});
  for (size_t count = 1; count <= ids.size(); ++count) {
    const SequenceBatch batch = pixel_sequences(77, {ids.data(), count});
    ASSERT_EQ(batch.count, int(count));
    for (const Dimension dimension : every_dimension) {
      const Batch1 one = draw(batch, dimension);
      const Batch2 two = draw2(batch, dimension);
      for (size_t k = 0; k < count; ++k) {
        const Sequence sequence = pixel_sequence(77, ids[k].x, ids[k].y, ids[k].replicate);
        EXPECT_EQ(one[k], draw(sequence, dimension, ids[k].index));
        EXPECT_EQ(two[k], draw2(sequence, dimension, ids[k].index));
      }
    }
  }
}

TEST(Sobol, ConsecutivePointsAreThoseThatAreDrawnAlone) {
  const Sequence sequence = pixel_sequence(5, 31, -7, 2, 1);
  for (const Dimension dimension : every_dimension)
    for (const std::uint32_t first : {0u, 1u, 64u, 77u, 0xfffffff0u})
      for (const size_t count : {size_t(0), size_t(1), size_t(3), size_t(8), size_t(13), size_t(batch_size)}) {
        std::vector<double> one(count);
        std::vector<std::array<double, 2>> two(count);
        draw(sequence, dimension, first, one);
        draw2(sequence, dimension, first, two);
        for (size_t k = 0; k < count; ++k) {
          EXPECT_EQ(one[k], draw(sequence, dimension, first + std::uint32_t(k)));
          EXPECT_EQ(two[k], draw2(sequence, dimension, first + std::uint32_t(k)));
        }
      }
}

TEST(Sobol, EveryAlignedBlockIsStratifiedInOneDimension) {
  const Sequence sequence = pixel_sequence(9, 12, 34, 0);
  for (const Dimension dimension : every_dimension)
    for (int k = 0; k <= 12; ++k)
      for (const std::uint32_t first : {0u, 3u << k}) {
        std::set<int> strata;
        for (std::uint32_t i = 0; i < (1u << k); ++i)
          strata.insert(int(draw(sequence, dimension, first + i) * (1 << k)));
        ASSERT_EQ(strata.size(), size_t(1) << k);
      }
}

TEST(Sobol, ValuesLieInTheUnitIntervalWithThirtyTwoBits) {
  const Sequence sequence = pixel_sequence(1, 2, 3, 4);
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const auto p = draw2(sequence, Dimension::table, i * 2654435761u);
    for (const double v : {p[0], p[1], draw(sequence, Dimension::gap, i)}) {
      ASSERT_GE(v, 0);
      ASSERT_LE(v, 1 - 0x1p-32);
      ASSERT_EQ(v * 0x1p32, std::floor(v * 0x1p32));
    }
  }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double ab = 0, aa = 0, bb = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - 0.5) * (b[i] - 0.5);
    aa += (a[i] - 0.5) * (a[i] - 0.5);
    bb += (b[i] - 0.5) * (b[i] - 0.5);
  }
  return ab / std::sqrt(aa * bb);
}

// The same index in two dimensions, pixels, replicates or bounces: correlations of n points scatter by 1 / sqrt(n) at
// most. 6 standard deviations are a false alarm in 5e8; the seeds are fixed.
TEST(Sobol, DimensionsPixelsReplicatesAndBouncesAreIndependent) {
  constexpr int n = 4096;
  std::vector<std::vector<double>> series;
  const auto add = [&](Sequence s, Dimension d) {
    std::vector<double> first(n), second(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      const auto p = draw2(s, d, i);
      first[i] = p[0];
      second[i] = p[1];
    }
    series.push_back(first);
    series.push_back(second);
  };
  for (const Dimension d : every_dimension) add(pixel_sequence(7, 100, 200, 0, 0), d);
  for (const auto& [x, y] : {std::pair{101, 200}, {100, 201}, {200, 100}})
    add(pixel_sequence(7, x, y, 0, 0), Dimension::film);
  add(pixel_sequence(7, 100, 200, 1, 0), Dimension::film);
  add(pixel_sequence(7, 100, 200, 0, 1), Dimension::film);
  add(pixel_sequence(8, 100, 200, 0, 0), Dimension::film);
  for (size_t i = 0; i < series.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      EXPECT_LT(std::abs(correlation(series[i], series[j])), 6 / std::sqrt(double(n)))
          << "series " << i << " and " << j;
}

// One sample of every pixel is white noise over the picture, not a pattern.
TEST(Sobol, NeighbouringPixelsAreUncorrelated) {
  std::vector<double> here, right, below;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto at = [](int px, int py) {
        return draw2(pixel_sequence(3, px, py, 0), Dimension::environment, 0)[0];
      };
      here.push_back(at(x, y));
      right.push_back(at(x + 1, y));
      below.push_back(at(x, y + 1));
    }
  EXPECT_LT(std::abs(correlation(here, right)), 6 / 64.0);
  EXPECT_LT(std::abs(correlation(here, below)), 6 / 64.0);
}

double rms_error(int samples, int replicates) {
  double squares = 0;
  const auto smooth = [](double x, double y) { return std::exp(-2 * x) * std::cos(1.5 * y) * 2 + x * y; };
  const double truth = (1 - std::exp(-2.0)) * std::sin(1.5) / 1.5 + 0.25;
  for (int r = 0; r < replicates; ++r) {
    double sum = 0;
    for (int i = 0; i < samples; ++i) {
      const auto p = draw2(pixel_sequence(11, 5, 6, r), Dimension::uniform, std::uint32_t(i));
      sum += smooth(p[0], p[1]);
    }
    squares += std::pow(sum / samples - truth, 2);
  }
  return std::sqrt(squares / replicates);
}

// Scrambled nets reach N^-1.5 on smooth integrands; plain random numbers N^-0.5.
TEST(Sobol, ErrorOfASmoothIntegrandFallsFasterThanOneOverN) {
  const double few = rms_error(16, 200), many = rms_error(4096, 200);
  const double slope = std::log(many / few) / std::log(4096.0 / 16);
  printf("RMS error %.2e at 16 points, %.2e at 4096: N^%.2f\n", few, many, slope);
  EXPECT_LT(slope, -1.3);
  EXPECT_GT(few, 1e-5);  // and it is an error at all
}

TEST(Sobol, PrefixesThatAreNoPowerOfTwoStayGood) {
  EXPECT_LT(rms_error(1000, 100), 0.2 * rms_error(100, 100));
}

}  // namespace
}  // namespace sateen
