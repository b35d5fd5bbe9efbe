#include "scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;

// Rounding a direction to float moves it by up to 1e-7 rad and fast_atan2 errs by 4e-9: a sample that stays this far
// [rad] from a texel's border is found in that texel again.
constexpr double edge = 2e-7;

// Above this, products of radiance with a BSDF or a reciprocal pdf could leave float's range.
constexpr float brightest = 1e35f;

double texel_solid_angle(int y, int width, int height) {
  return 2 * pi_d / width * environment_row_weight(y, height);
}

Color color_at(const Image& map, int x, int y) {
  const float* p = map.at(x, y);
  return map.channels < 3 ? Color(p[0], p[0], p[0]) : Color(p[0], p[1], p[2]);
}

double weighted(const Color& c, const double (&weights)[3]) {
  return double(c.x) * weights[0] + double(c.y) * weights[1] + double(c.z) * weights[2];
}

void fill_texels(Environment& e, const Image& map, float gain) {
  e.texels.resize(size_t(e.width) * size_t(e.height));
  for (int y = 0; y < e.height; ++y)
    for (int x = 0; x < e.width; ++x) {
      Color c = color_at(map, x, y);
      bool held = false;
      for (int i = 0; i < 3; ++i) {
        c[i] *= gain;
        held = held || c[i] > brightest;
        c[i] = std::min(c[i], brightest);
        // Render threads flush subnormals: flushed here, everyone sees the same map.
        if (c[i] < std::numeric_limits<float>::min()) c[i] = 0;
      }
      if (held && e.repairs.infinite.count++ == 0) {
        e.repairs.infinite.first_x = x;
        e.repairs.infinite.first_y = y;
      }
      e.texels[size_t(y) * size_t(e.width) + size_t(x)].radiance = c;
    }
}

void fill_pdfs(Environment& e) {
  const Distribution2D& compensated = drawable(e.by_compensated) ? e.by_compensated : e.by_radiance;
  for (int y = 0; y < e.height; ++y) {
    const double solid_angle = texel_solid_angle(y, e.width, e.height);
    for (int x = 0; x < e.width; ++x) {
      Environment::Texel& t = e.texels[size_t(y) * size_t(e.width) + size_t(x)];
      t.pdf_radiance = float(cell_probability(e.by_radiance, std::uint32_t(x), std::uint32_t(y)) / solid_angle);
      t.pdf_compensated = float(cell_probability(compensated, std::uint32_t(x), std::uint32_t(y)) / solid_angle);
    }
  }
}
}  // namespace

double environment_row_weight(int y, int height) {
  // The difference of two cosines as a product, without its cancellation near the poles.
  return 2 * std::sin(pi_d * (y + 0.5) / height) * std::sin(pi_d * 0.5 / height);
}

Environment build_environment(Image map, const EnvironmentOptions& options) {
  if (map.width < 1 || map.height < 1 || map.channels < 1)
    throw InputError(fmt::format("the environment map {} has no pixels", options.name));
  Environment e;
  e.repairs = repair_radiance(map);
  e.width = map.width;
  e.height = map.height;
  e.name = options.name;
  e.luminance = options.luminance;
  e.rotation = options.rotation;
  const double turns = double(options.rotation) / (2 * pi_d);
  e.rotation_turns = turns - std::floor(turns);
  e.edge_x = std::min(0.25, edge * e.width / (2 * pi_d));
  e.edge_y = std::min(0.25, 2 * edge * e.height / pi_d);
  e.row_cosines.resize(size_t(e.height) + 1);
  for (int y = 0; y <= e.height; ++y) e.row_cosines[size_t(y)] = std::cos(pi_d * y / e.height);
  fill_texels(e, map, std::exp2(options.exposure_ev));

  const double weights[3] = {std::max(0.02, double(e.luminance.x)), std::max(0.02, double(e.luminance.y)),
                             std::max(0.02, double(e.luminance.z))};
  double mean = 0, mean_rgb[3] = {0, 0, 0};
  for (int y = 0; y < e.height; ++y) {
    double row = 0, row_rgb[3] = {0, 0, 0};
    for (int x = 0; x < e.width; ++x) {
      const Color& c = e.texels[size_t(y) * size_t(e.width) + size_t(x)].radiance;
      row += weighted(c, weights);
      for (int i = 0; i < 3; ++i) row_rgb[i] += double(c[i]);
    }
    const double share = environment_row_weight(y, e.height) / (2.0 * e.width);
    mean += row * share;
    for (int i = 0; i < 3; ++i) mean_rgb[i] += row_rgb[i] * share;
  }
  e.mean_radiance = Color(float(mean_rgb[0]), float(mean_rgb[1]), float(mean_rgb[2]));

  const auto build = [&](double subtracted) {
    return build_distribution(e.width, e.height, [&](int y, std::span<double> out) {
      const double weight = environment_row_weight(y, e.height);
      for (int x = 0; x < e.width; ++x) {
        const double l = weighted(e.texels[size_t(y) * size_t(e.width) + size_t(x)].radiance, weights);
        out[size_t(x)] = std::max(0.0, l - subtracted) * weight;
      }
    });
  };
  e.by_radiance = build(0);
  // A little above the mean, so that rounding does not leave a constant map with a few lucky texels.
  e.by_compensated = build(mean * (1 + 1e-9));
  if (!drawable(e.by_compensated)) e.by_compensated = {};
  e.black = !drawable(e.by_radiance);
  fill_pdfs(e);
  return e;
}

void pick_environment(const Environment& e, EnvironmentDensity density, std::span<const std::array<double, 2>> u,
                      EnvironmentPick* picks) {
  constexpr size_t together = 16;
  const bool compensated = density == EnvironmentDensity::compensated && drawable(e.by_compensated);
  for (; !u.empty(); picks += together, u = u.subspan(std::min(u.size(), together))) {
    const size_t count = std::min(u.size(), together);
    std::array<CellSample2D, together> cells;
    sample_cells(compensated ? e.by_compensated : e.by_radiance, u.first(count), cells.data());
    for (size_t k = 0; k < count; ++k) {
      const CellSample2D& cell = cells[k];
      picks[k] = {};
      if (cell.probability == 0) continue;
      picks[k].texel = &e.texels[size_t(cell.y) * size_t(e.width) + cell.x];
      prefetch_texel(picks[k].texel);
      const double top = e.row_cosines[cell.y], bottom = e.row_cosines[cell.y + 1];
      const double cosine = top + (bottom - top) * std::clamp(cell.offset_y, e.edge_y, 1 - e.edge_y);
      const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
      const double offset = std::clamp(cell.offset_x, e.edge_x, 1 - e.edge_x);
      const SineCosine longitude = fast_sincos_turns((cell.x + offset) / e.width - 0.5 + e.rotation_turns);
      picks[k].direction = Vec3(float(sine * longitude.sine), float(cosine), float(-sine * longitude.cosine));
    }
  }
}

EnvironmentSample sample_environment(const Environment& e, EnvironmentDensity density, double u0, double u1) {
  EnvironmentPick pick;
  const std::array u{u0, u1};
  pick_environment(e, density, {&u, 1}, &pick);
  if (!pick.texel) return {};
  return {pick.direction, pick.texel->radiance, texel_pdf(*pick.texel, density)};
}

Color environment_backdrop(const Environment& e, const Vec3& direction) {
  const MapPlace place = environment_place(e, direction);
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return Color(0, 0, 0);
  const double x = place.x - 0.5, y = place.y - 0.5;
  const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
  const auto fx = float(x - x0), fy = float(y - y0);
  // Over a pole the neighbour is the same row half a turn away.
  const auto at = [&](int column, int row) -> const Color& {
    if (row < 0 || row >= e.height) column += e.width / 2;
    row = std::clamp(row, 0, e.height - 1);
    column = (column % e.width + e.width) % e.width;
    return e.texels[size_t(row) * size_t(e.width) + size_t(column)].radiance;
  };
  const Color above = at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx;
  const Color below = at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx;
  return above * (1 - fy) + below * fy;
}

}  // namespace sateen
