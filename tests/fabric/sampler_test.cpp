#include <gtest/gtest.h>

#include <algorithm>

#include "cloth.h"
#include "statistics.h"

// Every sampler against its own density: chi-square, total mass, and the reflectance that it estimates.

namespace sateen::test {
namespace {

constexpr int theta_bins = 80, phi_bins = 160;
constexpr double half_pi = M_PI / 2;
constexpr FabricSampler samplers[] = {FabricSampler::uniform, FabricSampler::talk, FabricSampler::table};
const char* name_of(FabricSampler s) {
  return s == FabricSampler::uniform ? "uniform" : s == FabricSampler::talk ? "talk" : "table";
}

struct View {
  double polar_deg, azimuth_deg;
};
const std::vector<View>& chi_square_views() {
  static const std::vector<View> views{{0, 0}, {31, 17}, {60, 100}, {78, 200}, {87, 275}, {89.5, 355}};
  return views;
}

// The look with both families' lobes `gamma` wide on the surface and twice that inside; as authored where gamma is 0.
Look with_width(Look look, float gamma) {
  if (gamma > 0)
    for (ThreadFamily* f : {&look.warp, &look.weft}) {
      f->gamma_s_deg = gamma;
      f->gamma_v_deg = std::min(2 * gamma, 180.0f);
    }
  look.warp.color.reset();
  look.weft.color.reset();
  return look;
}

Vec3 warp_direction(double theta, double phi) {
  const double c = std::cos(theta);
  return Vec3(float(std::sin(theta)), float(c * std::sin(phi)), float(c * std::cos(phi)));
}

// Lines between which the table's density times cos theta is constant: the bins' edges and those of its own cells.
std::vector<double> merged(std::vector<double> lines, int bins) {
  for (int i = 0; i <= bins; ++i) lines.push_back(-half_pi + M_PI * i / bins);
  std::sort(lines.begin(), lines.end());
  return lines;
}
std::vector<double> table_rows(const TableView& view) {
  std::vector<double> lines;
  for (int k = 0; k < 4; ++k)
    for (int a = 0; a < DirectionTable::theta_cells; ++a)
      lines.push_back(std::remainder(-half_pi + M_PI * a / DirectionTable::theta_cells - double(view.turn[k]), M_PI) *
                      view.flip_x);
  return merged(lines, theta_bins);
}
std::vector<double> table_columns() {
  std::vector<double> lines;
  for (const float h : column_heights())
    for (const double side : {-1.0, 1.0}) lines.push_back(side * (half_pi - double(h)));
  return merged(lines, phi_bins);
}

// Mass of the sampler's density in every bin of the upper hemisphere, by theta and phi of the warp.
std::vector<double> expected_mass(const FabricView& view, FabricSampler sampler, double tolerance) {
  std::vector<double> mass(theta_bins * phi_bins, 0);
  const auto density = [&](double theta, double phi) {
    return double(pdf(view.sampler, warp_direction(theta, phi))) * std::cos(theta);
  };
  const auto bin = [](double x, int bins) { return std::clamp(int((x + half_pi) / M_PI * bins), 0, bins - 1); };
  if (sampler == FabricSampler::table) {
    const std::vector<double> rows = table_rows(view.sampler.table), columns = table_columns();
    for (size_t i = 0; i + 1 < rows.size(); ++i)
      for (size_t j = 0; j + 1 < columns.size(); ++j) {
        const double theta = (rows[i] + rows[i + 1]) / 2, phi = (columns[j] + columns[j + 1]) / 2;
        mass[bin(theta, theta_bins) * phi_bins + bin(phi, phi_bins)] +=
            density(theta, phi) * (rows[i + 1] - rows[i]) * (columns[j + 1] - columns[j]);
      }
    return mass;
  }
  for (int a = 0; a < theta_bins; ++a)
    for (int b = 0; b < phi_bins; ++b) {
      const double theta = -half_pi + M_PI * a / theta_bins, phi = -half_pi + M_PI * b / phi_bins;
      if (sampler == FabricSampler::uniform)
        mass[a * phi_bins + b] = (std::sin(theta + M_PI / theta_bins) - std::sin(theta)) / (2 * phi_bins);
      else
        mass[a * phi_bins + b] =
            integrate(density, theta, theta + M_PI / theta_bins, phi, phi + M_PI / phi_bins, tolerance);
    }
  return mass;
}

ChiSquare test_sampler(const FabricView& view, FabricSampler sampler, int samples, std::uint64_t seed) {
  std::vector<double> expected = expected_mass(view, sampler, 0.02 / samples), observed(expected.size(), 0);
  double above = 0;
  for (double& e : expected) {
    above += e;
    e *= samples;
  }
  expected.push_back(std::max(1 - above, 0.0) * samples);  // below the horizon: the talk's lost share
  observed.push_back(0);
  Random random{seed};
  for (int i = 0; i < samples; ++i) {
    FabricRandom u;
    u.choice = random.uniform();
    u.thread = {random.uniform(), random.uniform()};
    u.direction = {random.uniform(), random.uniform()};
    const std::optional<Vec3> wi = sample(view.sampler, u);
    if (!wi) {
      ++observed.back();
      continue;
    }
    const double theta = std::asin(std::clamp(double(wi->x), -1.0, 1.0)), phi = std::atan2(wi->y, wi->z);
    const int a = std::clamp(int((theta + half_pi) / M_PI * theta_bins), 0, theta_bins - 1);
    const int b = std::clamp(int((phi + half_pi) / M_PI * phi_bins), 0, phi_bins - 1);
    ++observed[a * phi_bins + b];
  }
  if (sampler != FabricSampler::talk) expected.pop_back(), observed.pop_back();
  return chi_square(observed, expected);
}

// False alarms: 1 % for each of the tests below, whatever the number of configurations (Sidak).
void chi_square_over(const std::vector<std::pair<const Look*, float>>& configurations, const std::vector<View>& views,
                     int samples, std::uint64_t seed) {
  const double level = sidak_level(0.01, double(3 * configurations.size() * views.size()));
  auto view = std::make_unique<FabricView>();
  double smallest = 1;
  for (const auto& [look, width] : configurations) {
    const Fabric own = width > 0 ? compile_fabric(with_width(*look, width), same_space) : Fabric();
    const Fabric& fabric = width > 0 ? own : fabric_of(*look);
    for (const View& v : views)
      for (const FabricSampler sampler : samplers) {
        prepare_view(fabric, direction(v.polar_deg, v.azimuth_deg), sampler, *view);
        const ChiSquare result = test_sampler(*view, sampler, samples, ++seed);
        smallest = std::min(smallest, result.tail);
        EXPECT_FALSE(result.impossible) << look->name << " " << name_of(sampler);
        EXPECT_GT(result.tail, level) << name_of(sampler) << " of " << look->name << ", width " << width << ", view "
                                      << v.polar_deg << " " << v.azimuth_deg << ": chi-square " << result.value
                                      << " of " << result.freedom;
      }
  }
  printf("chi-square: %zu configurations of 3 samplers, smallest tail %.2e, level %.2e\n",
         configurations.size() * views.size(), smallest, level);
}

TEST(ChiSquare, TailIsThatOfTheDistribution) {
  // Percentage points of tables.
  EXPECT_NEAR(chi_square_tail(6.634897, 1), 0.01, 1e-7);
  EXPECT_NEAR(chi_square_tail(18.307038, 10), 0.05, 1e-7);
  EXPECT_NEAR(chi_square_tail(149.449253, 100), 0.001, 1e-7);
  EXPECT_NEAR(chi_square_tail(82.358136, 100), 0.9, 1e-7);
}

TEST(Samplers, DrawFromTheirOwnDensities) {
  std::vector<std::pair<const Look*, float>> looks;
  for (const Look& look : all_looks()) looks.emplace_back(&look, 0.0f);
  if (long_tests()) {
    chi_square_over(looks, chi_square_views(), 1000000, 0);
  } else {
    for (size_t i = 0; i < chi_square_views().size(); ++i) {
      std::vector<std::pair<const Look*, float>> some;
      for (size_t k = i; k < looks.size(); k += chi_square_views().size()) some.push_back(looks[k]);
      chi_square_over(some, {chi_square_views()[i]}, 200000, 1000 * i);
    }
  }
}

TEST(Samplers, DrawFromTheirOwnDensitiesAtEveryWidthOfTheLobes) {
  std::vector<std::pair<const Look*, float>> all;
  const std::vector<Look>& looks = all_looks();
  const float widths[] = {0.5f, 1.5f, 4, 12, 35, 90};
  for (size_t k = 0; k < looks.size(); ++k)
    for (size_t w = 0; w < 6; ++w)
      if (long_tests() || (widths[w] > 1 && k == 3 * w)) all.emplace_back(&looks[k], widths[w]);
  if (long_tests())
    chi_square_over(all, chi_square_views(), 1000000, 20000);
  else
    chi_square_over(all, {{40, 70}, {89.5, 15}}, 200000, 20000);
}

std::vector<View> integral_views() {
  std::vector<View> views;
  for (const double polar : {0.0, 25.0, 50.0, 70.0, 85.0, 89.5})
    for (const double azimuth : {3.0, 95.0, 170.0, 310.0}) views.push_back({polar, azimuth});
  return views;
}

double total_mass(const FabricView& view, FabricSampler sampler) {
  double total = 0;
  for (const double m : expected_mass(view, sampler, 1e-7)) total += m;
  if (sampler != FabricSampler::talk) return total;
  const auto density = [&](double theta, double phi) {
    return double(talk_pdf(view.fabric->talk, view.sampler.talk, warp_direction(theta, phi + M_PI))) * std::cos(theta);
  };
  for (int a = 0; a < 40; ++a)
    for (int b = 0; b < 40; ++b) {
      const double theta = -half_pi + M_PI * a / 40, phi = -half_pi + M_PI * b / 40;
      total += integrate(density, theta, theta + M_PI / 40, phi, phi + M_PI / 40, 1e-7);
    }
  return total;
}

TEST(Samplers, DensitiesIntegrateToOne) {
  double worst[3] = {0, 0, 0};
  auto view = std::make_unique<FabricView>();
  const float widths[] = {0.5f, 1.5f, 4, 12, 35, 90};
  const std::vector<Look>& looks = all_looks();
  for (size_t k = 0; k < looks.size(); ++k)
    for (int w = -1; w < 6; ++w) {
      const bool wanted = long_tests() || w < 0 ? w >= 0 || long_tests() || k % 2 == 0 : k == size_t(3 * w);
      if (!wanted) continue;
      const Fabric own = w >= 0 ? compile_fabric(with_width(looks[k], widths[w]), same_space) : Fabric();
      const Fabric& fabric = w >= 0 ? own : fabric_of(looks[k]);
      const std::vector<View> views = integral_views();
      for (size_t i = 0; i < views.size(); ++i)
        for (const FabricSampler sampler : {FabricSampler::talk, FabricSampler::table}) {
          if (sampler == FabricSampler::talk && !long_tests() && (i + k) % 24) continue;
          prepare_view(fabric, direction(views[i].polar_deg, views[i].azimuth_deg), sampler, *view);
          const double error = std::abs(total_mass(*view, sampler) - 1);
          worst[int(sampler)] = std::max(worst[int(sampler)], error);
          EXPECT_LT(error, 2e-3) << name_of(sampler) << " of " << looks[k].name << ", width "
                                 << (w < 0 ? 0 : widths[w]) << ", view " << views[i].polar_deg << " "
                                 << views[i].azimuth_deg;
        }
    }
  printf("mass of the densities: off by at most %.2e (talk), %.2e (table)\n", worst[1], worst[2]);
}

// Weighted by F, every sampler estimates the same reflectance: an error of any density, or of F between sampling and
// evaluation, moves one of them. z-tests against the quadrature of albedo(); false alarms 1 % in all.
TEST(Samplers, EstimateTheSameReflectance) {
  auto view = std::make_unique<FabricView>();
  const int samples = long_tests() ? 400000 : 20000;
  const std::vector<View> views{{10, 40}, {55, 130}, {80, 250}};
  const double limit = sidak_deviate(0.01, double(3 * all_looks().size() * views.size()));
  double worst = 0;
  std::uint64_t seed = 100;
  for (const Look& look : all_looks())
    for (const View& v : views) {
      const Fabric& fabric = fabric_of(look);
      const Vec3 wo = direction(v.polar_deg, v.azimuth_deg);
      const Albedo a = albedo(fabric.threads, wo);
      const double truth = double(a.surface) + double(mean_component(fabric.A[0])) * a.volume[0] +
                           double(mean_component(fabric.A[1])) * a.volume[1];
      for (const FabricSampler sampler : samplers) {
        prepare_view(fabric, wo, sampler, *view);
        Random random{++seed};
        double sum = 0, squares = 0;
        for (int i = 0; i < samples; ++i) {
          FabricRandom u;
          u.choice = random.uniform();
          u.thread = {random.uniform(), random.uniform()};
          u.direction = {random.uniform(), random.uniform()};
          const std::optional<Vec3> wi = sample(view->sampler, u);
          if (!wi) continue;
          const double w = brightness(fabric, evaluate_parts(*view, *wi)) / double(pdf(view->sampler, *wi));
          sum += w;
          squares += w * w;
        }
        const double mean = sum / samples, error = std::sqrt((squares / samples - mean * mean) / samples);
        // 2e-4 of slack for the quadrature of albedo() itself.
        const double deviate = std::max(std::abs(mean - truth) - 2e-4 * truth, 0.0) / error;
        worst = std::max(worst, deviate);
        EXPECT_LT(deviate, limit) << name_of(sampler) << " of " << look.name << ", view " << v.polar_deg << " "
                                  << v.azimuth_deg << ": " << mean << " +- " << error << " for " << truth;
      }
    }
  printf("reflectance by three samplers: largest deviate %.2f, limit %.2f\n", worst, limit);
}

}  // namespace
}  // namespace sateen::test
