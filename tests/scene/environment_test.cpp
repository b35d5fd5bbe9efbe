#include "scene/environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/error.h"
#include "maps.h"

namespace sateen {
namespace {

using sateen_test::make_map;
using sateen_test::NamedMap;
using sateen_test::torture_maps;

constexpr double pi_d = std::numbers::pi;
constexpr EnvironmentDensity densities[] = {EnvironmentDensity::radiance, EnvironmentDensity::compensated};

bool fine(float value) {
  return std::isfinite(value) && value >= 0;
}

std::vector<Environment> torture_environments() {
  std::vector<Environment> all;
  for (NamedMap& map : torture_maps()) {
    EnvironmentOptions options;
    options.name = map.name;
    all.push_back(build_environment(map.image, options));
    options.rotation = 1.2345f;
    options.exposure_ev = -3;
    options.name += ", turned";
    all.push_back(build_environment(std::move(map.image), options));
  }
  return all;
}

double solid_angle(const Environment& e, int y) {
  return environment_row_weight(y, e.height) * 2 * pi_d / e.width;
}

TEST(Environment, HasRowsWhoseWeightsAreExactAndNeverZero) {
  for (int height : {1, 2, 3, 17, 512, 8192, 16384}) {
    double sum = 0;
    for (int y = 0; y < height; ++y) {
      const double weight = environment_row_weight(y, height);
      EXPECT_GT(weight, 0);
      const long double exact = std::cos(std::numbers::pi_v<long double> * y / height) -
                                std::cos(std::numbers::pi_v<long double> * (y + 1) / height);
      EXPECT_NEAR(weight, double(exact), 1e-9 * double(exact)) << y << " of " << height;
      sum += weight;
    }
    EXPECT_NEAR(sum, 2, 1e-12);
  }
}

TEST(Environment, IsFiniteAndNotNegativeForEveryTortureMap) {
  for (const Environment& e : torture_environments()) {
    for (const auto& t : e.texels)
      ASSERT_TRUE(fine(t.radiance.x) && fine(t.radiance.y) && fine(t.radiance.z) && fine(t.pdf_radiance) &&
                  fine(t.pdf_compensated))
          << e.name;
    EXPECT_TRUE(fine(e.mean_radiance.x) && fine(e.mean_radiance.y) && fine(e.mean_radiance.z)) << e.name;
    EXPECT_TRUE(std::isfinite(metered_exposure_ev(e))) << e.name;
  }
}

TEST(Environment, HasDensitiesThatIntegrateToOneUnlessTheMapIsBlack) {
  for (const Environment& e : torture_environments())
    for (const EnvironmentDensity density : densities) {
      double integral = 0;
      for (int y = 0; y < e.height; ++y)
        for (int x = 0; x < e.width; ++x) {
          const auto& t = e.texels[size_t(y) * size_t(e.width) + size_t(x)];
          integral += double(density == EnvironmentDensity::radiance ? t.pdf_radiance : t.pdf_compensated) *
                      solid_angle(e, y);
        }
      EXPECT_NEAR(integral, e.black ? 0 : 1, 1e-6) << e.name;
    }
}

TEST(Environment, IsBlackExactlyWhereNothingShines) {
  for (const Environment& e : torture_environments()) {
    const bool expected = e.name.rfind("black,", 0) == 0 || e.name == "black" ||
                          e.name.rfind("all not a number", 0) == 0 || e.name.rfind("all negative", 0) == 0 ||
                          e.name.rfind("denormals,", 0) == 0 || e.name == "denormals" ||
                          e.name == "smallest floats, turned";  // three stops down they are subnormal
    EXPECT_EQ(e.black, expected) << e.name;
  }
}

TEST(Environment, CanDrawEveryTexelThatShines) {
  for (const Environment& e : torture_environments())
    for (const auto& t : e.texels) ASSERT_EQ(t.pdf_radiance > 0, max_component(t.radiance) > 0) << e.name;
}

TEST(Environment, LooksUpTheTexelThatASampleWasDrawnFrom) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  const double ends[] = {0, 0x1p-32, 0x1p-24, 0.25, 0.5, 0.75, 1 - 0x1p-24, 1 - 0x1p-32, 1 - 0x1p-53};
  for (const Environment& e : torture_environments())
    for (const EnvironmentDensity density : densities)
      for (int k = 0; k < 4081; ++k) {
        const double u0 = k < 81 ? ends[k / 9] : uniform(random), u1 = k < 81 ? ends[k % 9] : uniform(random);
        const EnvironmentSample s = sample_environment(e, density, u0, u1);
        if (e.black) {
          ASSERT_EQ(s.pdf, 0) << e.name;
          continue;
        }
        ASSERT_GT(s.pdf, 0) << e.name;
        ASSERT_NEAR(length(s.direction), 1, 3e-7) << e.name;
        ASSERT_EQ(environment_radiance(e, s.direction), s.radiance) << e.name << " u " << u0 << " " << u1;
        ASSERT_EQ(environment_pdf(e, density, s.direction), s.pdf) << e.name << " u " << u0 << " " << u1;
      }
}

TEST(Environment, LooksUpTheTexelOfASampleInLargeMapsToo) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  // Wide and low, narrow and tall: each direction at the size of a 16k map.
  for (const auto& [width, height] : {std::pair(16384, 64), std::pair(64, 8192)}) {
    EnvironmentOptions options;
    options.rotation = 2.5f;
    const Environment e = build_environment(
        make_map(width, height, [](int x, int y) { return Color(1 + float((x * 31 + y * 17) % 97), 1, 1); }),
        options);
    for (int k = 0; k < 300000; ++k) {
      const EnvironmentSample s =
          sample_environment(e, EnvironmentDensity::radiance, uniform(random), uniform(random));
      ASSERT_EQ(environment_radiance(e, s.direction), s.radiance) << width << " " << s.direction;
    }
  }
}

TEST(Environment, LooksUpManyDirectionsAsEachAlone) {
  std::mt19937 random(6);
  std::normal_distribution<float> normal;
  EnvironmentOptions options;
  options.rotation = 0.7f;
  const Environment e =
      build_environment(make_map(301, 97, [](int x, int y) { return Color(float(x), float(y), 1); }), options);
  std::vector<Vec3> directions{{0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
  while (directions.size() < 1003)
    directions.push_back(normalize(Vec3(normal(random), normal(random), normal(random))));
  for (const size_t count : {size_t(0), size_t(1), size_t(7), size_t(8), size_t(9), directions.size()}) {
    std::vector<MapTexel> texels(count);
    environment_texels(e, {directions.data(), count}, texels.data());
    for (size_t k = 0; k < count; ++k) ASSERT_TRUE(texels[k] == environment_texel(e, directions[k])) << directions[k];
  }
}

// Each of 64 maps x 2 densities is one test at 1e-5: false alarms below 1.3e-3 in all (the seed is fixed).
TEST(Environment, DrawsDirectionsWithTheDensityItStates) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int draws = 60000;
  // Bins in the sphere that are not the map's texels: longitude x cosine. Expectation by integrating the look-up.
  constexpr int across = 24, down = 12;
  for (const Environment& e : torture_environments()) {
    if (e.black || e.width * e.height > 4096) continue;
    for (const EnvironmentDensity density : densities) {
      std::vector<double> counts(across * down, 0.0), expected(across * down, 0.0);
      const auto bin = [&](const Vec3& d) {
        const double u = std::atan2(double(d.x), double(-d.z)) / (2 * pi_d) + 0.5;
        return std::min(int(u * across), across - 1) +
               across * std::clamp(int((1 - double(d.y)) / 2 * down), 0, down - 1);
      };
      for (int k = 0; k < draws; ++k)
        ++counts[size_t(bin(sample_environment(e, density, uniform(random), uniform(random)).direction))];
      // Exact overlaps of texel and bin are intervals in longitude and in cosine.
      for (int y = 0; y < e.height; ++y)
        for (int x = 0; x < e.width; ++x) {
          const auto& t = e.texels[size_t(y) * size_t(e.width) + size_t(x)];
          const double pdf = double(density == EnvironmentDensity::radiance ? t.pdf_radiance : t.pdf_compensated);
          if (pdf == 0) continue;
          const double c1 = std::cos(pi_d * y / e.height), c0 = std::cos(pi_d * (y + 1) / e.height);
          const double u0 = double(x) / e.width + e.rotation_turns, u1 = double(x + 1) / e.width + e.rotation_turns;
          for (int j = 0; j < down; ++j) {
            const double overlap_c = std::min(c1, 1 - 2.0 * j / down) - std::max(c0, 1 - 2.0 * (j + 1) / down);
            if (overlap_c <= 0) continue;
            for (int i = 0; i < 2 * across; ++i) {
              const double overlap_u = std::min(u1, double(i + 1) / across) - std::max(u0, double(i) / across);
              if (overlap_u > 0)
                expected[size_t(j * across + i % across)] += draws * pdf * overlap_c * overlap_u * 2 * pi_d;
            }
          }
        }
      double statistic = 0, pooled_count = 0, pooled = 0;
      int cells = 0;
      for (size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 10) {
          statistic += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
          ++cells;
        } else {
          // A bin that expects nothing may receive a sample that rounding carried over a shared border.
          pooled_count += counts[i];
          pooled += expected[i];
        }
      }
      EXPECT_LE(std::abs(pooled_count - pooled), 5 * std::sqrt(pooled) + 5) << e.name;
      if (cells < 2) continue;
      const double k = 2.0 / (9.0 * (cells - 1));
      const double z = (std::cbrt(statistic / (cells - 1)) - (1 - k)) / std::sqrt(k);  // Wilson and Hilferty 1931
      EXPECT_LT(z, 4.27) << e.name << " chi-square " << statistic << " of " << cells;
    }
  }
}

TEST(Environment, KeepsTheSamplesOfAPoleRowInThatRow) {
  const Environment north =
      build_environment(make_map(64, 32, [](int, int y) { return y == 0 ? Color(1, 1, 1) : Color(0, 0, 0); }));
  const Environment south =
      build_environment(make_map(64, 32, [](int, int y) { return y == 31 ? Color(1, 1, 1) : Color(0, 0, 0); }));
  const float border = std::cos(pi / 32);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j) {
      const double u0 = (i + 0.5) / 64, u1 = (j + 0.5) / 64;
      EXPECT_GE(sample_environment(north, EnvironmentDensity::radiance, u0, u1).direction.y, border);
      EXPECT_LE(sample_environment(south, EnvironmentDensity::radiance, u0, u1).direction.y, -border);
    }
  for (const Vec3& up : {Vec3(0, 1, 0), Vec3(-0.0f, 1, -0.0f), Vec3(1e-30f, 1, -1e-30f)}) {
    EXPECT_EQ(environment_radiance(north, up), Color(1, 1, 1));
    EXPECT_EQ(environment_radiance(south, up), Color(0, 0, 0));
    EXPECT_EQ(environment_radiance(south, -up), Color(1, 1, 1));
  }
}

TEST(Environment, FollowsItsStatedConventions) {
  // Columns are numbered by red, rows by green.
  const Image map = make_map(8, 4, [](int x, int y) { return Color(float(x), float(y), 1); });
  const Environment e = build_environment(map);
  const auto column = [&](const Environment& env, Vec3 d) { return environment_radiance(env, d).x; };
  EXPECT_EQ(column(e, Vec3(0.01f, 0, -1)), 4);  // -Z is the middle
  EXPECT_EQ(column(e, Vec3(-0.01f, 0, -1)), 3);
  EXPECT_EQ(column(e, Vec3(1, 0, -0.01f)), 5);  // +X is three quarters across
  EXPECT_EQ(column(e, Vec3(1, 0, 0.01f)), 6);
  EXPECT_EQ(column(e, Vec3(-1, 0, 0.01f)), 1);
  EXPECT_EQ(column(e, Vec3(0.01f, 0, 1)), 7);  // +Z is the seam
  EXPECT_EQ(column(e, Vec3(-0.01f, 0, 1)), 0);
  EXPECT_EQ(environment_radiance(e, Vec3(1, 5, 0)).y, 0);
  EXPECT_EQ(environment_radiance(e, Vec3(1, -5, 0)).y, 3);
  EXPECT_EQ(column(e, Vec3(100, 0, -1)), 5);  // of any length

  // A quarter turn brings what was ahead to the right.
  EnvironmentOptions options;
  options.rotation = pi / 2;
  const Environment turned = build_environment(map, options);
  EXPECT_EQ(column(turned, Vec3(1, 0, 0.01f)), 4);
  EXPECT_EQ(column(turned, Vec3(1, 0, -0.01f)), 3);
  options.rotation = -pi / 2;
  EXPECT_EQ(column(build_environment(map, options), Vec3(-1, 0, -0.01f)), 4);
}

TEST(Environment, TurnsByAnyAngle) {
  const Image map = make_map(64, 32, [](int x, int y) { return Color(float(x), float(y), 1); });
  EnvironmentOptions options;
  for (float turns : {-7.0f, -1.0f, 0.0f, 1.0f, 3.0f}) {
    options.rotation = turns * 2 * pi + 0.7f;
    const Environment e = build_environment(map, options);
    EXPECT_GE(e.rotation_turns, 0);
    EXPECT_LT(e.rotation_turns, 1);
    options.rotation = 0.7f;
    const Environment same = build_environment(map, options);
    EXPECT_EQ(environment_radiance(e, Vec3(0.3f, 0.2f, 0.4f)), environment_radiance(same, Vec3(0.3f, 0.2f, 0.4f)));
  }
}

TEST(Environment, AnswersAnyDirectionAtAll) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const float values[] = {0, -0.0f, 1, -1, 1e-40f, 1e-20f, 1e30f, -1e30f, inf, -inf, nan};
  const Environment e = build_environment(make_map(7, 5, [](int x, int y) { return Color(float(x), float(y), 1); }));
  for (float x : values)
    for (float y : values)
      for (float z : values) {
        EXPECT_TRUE(fine(environment_radiance(e, Vec3(x, y, z)).x));
        EXPECT_TRUE(fine(environment_backdrop(e, Vec3(x, y, z)).x));
      }
}

TEST(Environment, CompensatesByTheMeanAndFallsBackForAConstantMap) {
  const Environment constant = build_environment(make_map(64, 32, [](int, int) { return Color(0.7f, 0.7f, 0.7f); }));
  for (const auto& t : constant.texels) {
    ASSERT_NEAR(t.pdf_radiance, 1 / (4 * pi), 1e-6f);
    ASSERT_EQ(t.pdf_compensated, t.pdf_radiance);
  }
  // The upper half three times as bright as the lower: only it stays, evenly.
  const Environment halves =
      build_environment(make_map(64, 32, [](int, int y) { return y < 16 ? Color(3, 3, 3) : Color(1, 1, 1); }));
  EXPECT_NEAR(halves.mean_radiance.x, 2, 1e-6f);
  EXPECT_NEAR(environment_pdf(halves, EnvironmentDensity::compensated, Vec3(1, 2, 3)), 1 / (2 * pi), 1e-6f);
  EXPECT_EQ(environment_pdf(halves, EnvironmentDensity::compensated, Vec3(1, -2, 3)), 0);
  EXPECT_NEAR(environment_pdf(halves, EnvironmentDensity::radiance, Vec3(1, -2, 3)), 0.25f / (2 * pi), 1e-6f);
}

TEST(Environment, CountsRepairsAndNamesTheFirstPlace) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Image map = make_map(16, 8, [](int, int) { return Color(1, 1, 1); });
  map.at(3, 1)[0] = nan;
  map.at(3, 1)[2] = nan;  // the same pixel counts once
  map.at(4, 5)[1] = nan;
  map.at(7, 2)[0] = inf;
  map.at(2, 6)[0] = -0.25f;
  map.at(9, 6)[1] = -1;
  map.at(1, 1)[0] = 9;
  const Environment e = build_environment(map);
  EXPECT_EQ(e.repairs.not_a_number.count, 2);
  EXPECT_EQ(e.repairs.not_a_number.first_x, 3);
  EXPECT_EQ(e.repairs.not_a_number.first_y, 1);
  EXPECT_EQ(e.repairs.infinite.count, 1);
  EXPECT_EQ(e.repairs.infinite.first_x, 7);
  EXPECT_EQ(e.repairs.negative.count, 2);
  EXPECT_EQ(e.repairs.negative.first_x, 2);
  EXPECT_EQ(e.repairs.negative.first_y, 6);
  EXPECT_EQ(e.repairs.out_of_gamut.count + e.repairs.wide.count, 0);
  EXPECT_EQ(e.repairs.spike.count, 0);
  EXPECT_TRUE(e.repairs.any());
  EXPECT_EQ(e.texels[2 * 16 + 7].radiance.x, 9);  // the largest finite value of the map
  EXPECT_EQ(e.texels[16 + 3].radiance, Color(0, 1, 0));
  EXPECT_FALSE(build_environment(make_map(4, 2, [](int, int) { return Color(1, 2, 3); })).repairs.any());
}

// A map too large for a density of each texel: 4 x 4 share one. Sides that four does not divide.
TEST(Environment, DrawsALargeMapByBlocksWithTheDensityItStates) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  EnvironmentOptions options;
  options.rotation = 1.2f;
  const auto light = [](int x, int y) {
    return x == 90 && y == 20 ? Color(500, 400, 300) : Color(float(x % 7), float(y % 5), 1) * float(x < 70);
  };
  for (const auto& [width, height] : {std::pair{128, 64}, std::pair{130, 63}, std::pair{3, 2}}) {
    const Image map = make_map(width, height, light);
    options.most_texels = most_texels;
    const Environment each = build_environment(map, options);
    options.most_texels = 4;
    const Environment e = build_environment(map, options);
    ASSERT_TRUE(e.texels.empty());
    ASSERT_EQ(e.block, 4);
    EXPECT_EQ(e.by_radiance.width, (width + 3) / 4);
    EXPECT_EQ(e.mean_radiance, each.mean_radiance);
    EXPECT_EQ(metered_exposure_ev(e), metered_exposure_ev(each));
    for (const EnvironmentDensity density : densities) {
      double integral = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double colatitude = pi_d * (y + 0.5) / height,
                       longitude = 2 * pi_d * ((x + 0.5) / width + e.rotation_turns);
          const Vec3 d(float(-std::sin(longitude) * std::sin(colatitude)), float(std::cos(colatitude)),
                       float(std::cos(longitude) * std::sin(colatitude)));
          ASSERT_EQ(environment_radiance(e, d), environment_radiance(each, d));
          integral += double(environment_pdf(e, density, d)) * solid_angle(e, y);
        }
      EXPECT_NEAR(integral, 1, 1e-5);
      // The light that reaches a sphere, by the samples: unbiased, and exact where the density is the radiance's.
      double sum = 0, squares = 0;
      constexpr int draws = 40000;
      for (int k = 0; k < draws; ++k) {
        const EnvironmentSample s = sample_environment(e, density, uniform(random), uniform(random));
        ASSERT_GT(s.pdf, 0);
        ASSERT_EQ(environment_pdf(e, density, s.direction), s.pdf);
        ASSERT_EQ(environment_radiance(e, s.direction), s.radiance);
        if (density == EnvironmentDensity::compensated) continue;
        const double value = double(s.radiance.y) / double(s.pdf);
        sum += value, squares += value * value;
      }
      if (density == EnvironmentDensity::compensated) continue;
      const double mean = sum / draws, deviation = std::sqrt((squares / draws - mean * mean) / draws);
      EXPECT_NEAR(mean, 4 * pi_d * double(each.mean_radiance.y), 5 * deviation) << width;  // false alarms 6e-7
    }
  }
}

TEST(Environment, ReportsAOneChannelSpikeAndLeavesIt) {
  const auto map = [](Color spot) {
    return make_map(32, 16, [=](int x, int y) { return x == 9 && y == 4 ? spot : Color(0.1f, 0.2f, 0.2f); });
  };
  const Environment damaged = build_environment(map(Color(0.1f, 0.2f, 1e4f)));
  EXPECT_EQ(damaged.repairs.spike.count, 1);
  EXPECT_EQ(damaged.repairs.spike.first_x, 9);
  EXPECT_EQ(damaged.repairs.spike.first_y, 4);
  EXPECT_EQ(damaged.texels[4 * 32 + 9].radiance.z, 1e4f);
  EXPECT_FALSE(damaged.repairs.any());
  // A sun one texel wide, and a saturated lamp of ordinary strength, are lights.
  EXPECT_EQ(build_environment(map(Color(1e4f, 9e3f, 8e3f))).repairs.spike.count, 0);
  EXPECT_EQ(build_environment(map(Color(0.01f, 0.02f, 5.0f))).repairs.spike.count, 0);
}

TEST(Environment, ScalesByExposureAndHoldsWhatWouldOverflow) {
  EnvironmentOptions options;
  options.exposure_ev = 3;
  const Environment e =
      build_environment(make_map(8, 4, [](int x, int) { return Color(float(x), 1, 1e36f); }), options);
  EXPECT_EQ(e.texels[5].radiance.x, 40);
  EXPECT_EQ(e.texels[5].radiance.z, 1e35f);
  EXPECT_EQ(e.repairs.infinite.count, 0) << "it is finite";
  ASSERT_EQ(e.doubts.size(), 1u);
  EXPECT_EQ(e.doubts[0], "32 pixels finite and above 1e+35, brighter than any light: held there, first at 0 0");
}

TEST(Environment, TakesOneAndTwoChannelsAsGreyAndThreeOfMore) {
  for (int channels = 1; channels <= 5; ++channels) {
    Image map(4, 2, channels);
    for (size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = float(i % size_t(channels)) + 1;
    const Color expected = channels < 3 ? Color(1, 1, 1) : Color(1, 2, 3);
    EXPECT_EQ(build_environment(map).texels[0].radiance, expected) << channels;
  }
  EXPECT_THROW(build_environment(Image()), InputError);
}

TEST(Environment, ShowsASmoothBackdropAcrossTheSeamAndOverThePoles) {
  const Environment e = build_environment(make_map(
      16, 8, [](int x, int y) { return Color(2 + std::sin(2 * pi * (float(x) + 0.5f) / 16), float(y), 1); }));
  // At texel centres it is the texel, everywhere it is continuous.
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 16; ++x) {
      const float t = pi * (float(y) + 0.5f) / 8, l = 2 * pi * ((float(x) + 0.5f) / 16 - 0.5f);
      const Vec3 d(std::sin(t) * std::sin(l), std::cos(t), -std::sin(t) * std::cos(l));
      EXPECT_NEAR(environment_backdrop(e, d).x, environment_radiance(e, d).x, 1e-5f);
      EXPECT_NEAR(environment_backdrop(e, d).y, float(y), 1e-5f);
    }
  Color last = environment_backdrop(e, Vec3(0.3f, 0, 1));
  for (int i = 1; i <= 2000; ++i) {  // a path over the seam and the pole
    const float a = 2 * pi * float(i) / 2000;
    const Color c = environment_backdrop(e, Vec3(0.3f * std::cos(a), std::sin(a), std::cos(a)));
    EXPECT_LT(std::abs(c.x - last.x) + std::abs(c.y - last.y), 0.12f) << i;
    last = c;
  }
}

TEST(Metering, ReadsAConstantMapAsItsRadiance) {
  for (int size : {1, 2, 16, 256}) {
    const Environment e =
        build_environment(make_map(2 * size, size, [](int, int) { return Color(0.25f, 0.25f, 0.25f); }));
    EXPECT_NEAR(metered_exposure_ev(e), 2, 2e-4f) << size;
  }
}

TEST(Metering, HearsTheCameraSideOnlyAndFollowsRotationAndExposure) {
  const Image behind =
      make_map(64, 32, [](int x, int y) { return x == 32 && y == 16 ? Color(50, 50, 50) : Color(0, 0, 0); });
  EXPECT_EQ(metered_exposure_ev(build_environment(behind)), 0);  // nothing to read
  EnvironmentOptions options;
  options.rotation = pi;
  const float front = metered_exposure_ev(build_environment(behind, options));
  options.rotation = 2.0f;
  EXPECT_GT(metered_exposure_ev(build_environment(behind, options)), front);  // light from the side counts for less
  options.rotation = pi;
  options.exposure_ev = 1.5f;
  EXPECT_NEAR(metered_exposure_ev(build_environment(behind, options)), front - 1.5f, 1e-4f);
}

}  // namespace
}  // namespace sateen
