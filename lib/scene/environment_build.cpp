#include "scene/environment_build.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "scene/environment_repair.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;

// Rounding a direction to float moves it by up to 1e-7 rad and fast_atan2 errs by 4e-9: a sample that stays this far
// [rad] from a cell's border is found in that cell again.
constexpr double edge = 2e-7;

// Above this, products of radiance with a BSDF or a reciprocal pdf could leave float's range.
constexpr float brightest = 1e35f;

// Side of the blocks that a large map is drawn by: a map of 16384 x 8192 is drawn as finely as one of 4096 x 2048,
// and a sun of half a degree still covers 30 blocks.
constexpr int large_block = 4;

double weighted(const Color& c, const double (&weights)[3]) {
  return double(c.x) * weights[0] + double(c.y) * weights[1] + double(c.z) * weights[2];
}

double solid_angle_of_cell(const Environment& e, int x, int y) {
  const int x0 = x * e.block, x1 = std::min(x0 + e.block, e.width);
  const int y0 = y * e.block, y1 = std::min(y0 + e.block, e.height);
  double rows = 0;
  for (int row = y0; row < y1; ++row) rows += environment_row_weight(row, e.height);
  return 2 * pi_d / e.width * (x1 - x0) * rows;
}

void fill_pdfs(Environment& e) {
  const Distribution2D& compensated = drawable(e.by_compensated) ? e.by_compensated : e.by_radiance;
  const int across = e.by_radiance.width;
  const bool by_blocks = e.texels.empty();
  const std::span<Environment::Density> blocks =
      by_blocks ? e.blocks.make(size_t(across) * size_t(e.by_radiance.height)) : std::span<Environment::Density>();
  const std::span<Environment::Texel> texels = e.texels.edit();
  for (int y = 0; y < e.by_radiance.height; ++y) {
    const double whole = solid_angle_of_cell(e, 0, y), last = solid_angle_of_cell(e, across - 1, y);
    for (int x = 0; x < across; ++x) {
      const double solid_angle = x + 1 < across ? whole : last;
      const size_t i = size_t(y) * size_t(across) + size_t(x);
      Environment::Density& density = by_blocks ? blocks[i] : texels[i];
      density.pdf_radiance = float(cell_probability(e.by_radiance, std::uint32_t(x), std::uint32_t(y)) / solid_angle);
      density.pdf_compensated =
          float(cell_probability(compensated, std::uint32_t(x), std::uint32_t(y)) / solid_angle);
    }
  }
}
}  // namespace

Environment begin_environment(int width, int height, const EnvironmentOptions& options) {
  if (width < 1 || height < 1) throw InputError(fmt::format("the environment map {} has no pixels", options.name));
  Environment e;
  e.width = width;
  e.height = height;
  e.name = options.name;
  e.luminance = options.luminance;
  e.rotation = options.rotation;
  const double turns = double(options.rotation) / (2 * pi_d);
  e.rotation_turns = turns - std::floor(turns);
  const std::int64_t texels = std::int64_t(width) * height;
  if (texels > options.most_texels) {
    e.block = large_block;
    e.fine.make(size_t(texels));
  } else {
    e.texels.make(size_t(texels));
  }
  e.edge_x = std::min(0.25, edge * e.width / (2 * pi_d) / e.block);
  e.edge_y = std::min(0.25, 2 * edge * e.height / pi_d / e.block);
  e.row_cosines.resize(size_t(e.height) + 1);
  for (int y = 0; y <= e.height; ++y) e.row_cosines[size_t(y)] = std::cos(pi_d * y / e.height);
  return e;
}

Color scaled_radiance(const float* rgb, float gain, int x, int y, EnvironmentRepairs::Kind& held) {
  Color c(rgb[0], rgb[1], rgb[2]);
  bool beyond = false;
  for (int i = 0; i < 3; ++i) {
    c[i] *= gain;
    beyond = beyond || c[i] > brightest;
    c[i] = std::min(c[i], brightest);
    // Render threads flush subnormals: flushed here, everyone sees the same map.
    if (c[i] < std::numeric_limits<float>::min()) c[i] = 0;
  }
  if (beyond) count_repair(held, x, y);
  return c;
}

void tell_held(Environment& e, const EnvironmentRepairs::Kind& held) {
  if (held.count > 0)
    e.doubts.push_back(
        fmt::format("{} pixel{} finite and above {:g}, brighter than any light: held there, first at {} {}",
                    held.count, held.count == 1 ? "" : "s", brightest, held.first_x, held.first_y));
}

void set_row(Environment& e, int y, std::span<const Color> radiance) {
  const size_t first = size_t(y) * size_t(e.width);
  const std::span<Color> fine = e.fine.edit();
  const std::span<Environment::Texel> texels = e.texels.edit();
  for (size_t x = 0; x < radiance.size(); ++x)
    (texels.empty() ? fine[first + x] : texels[first + x].radiance) = radiance[x];
}

void finish_environment(Environment& e) {
  const double weights[3] = {std::max(0.02, double(e.luminance.x)), std::max(0.02, double(e.luminance.y)),
                             std::max(0.02, double(e.luminance.z))};
  double mean = 0, mean_rgb[3] = {0, 0, 0};
  for (int y = 0; y < e.height; ++y) {
    double row = 0, row_rgb[3] = {0, 0, 0};
    for (int x = 0; x < e.width; ++x) {
      const Color& c = e.radiance_at(x, y);
      row += weighted(c, weights);
      for (int i = 0; i < 3; ++i) row_rgb[i] += double(c[i]);
    }
    const double share = environment_row_weight(y, e.height) / (2.0 * e.width);
    mean += row * share;
    for (int i = 0; i < 3; ++i) mean_rgb[i] += row_rgb[i] * share;
  }
  e.mean_radiance = Color(float(mean_rgb[0]), float(mean_rgb[1]), float(mean_rgb[2]));

  const int across = (e.width + e.block - 1) / e.block, down = (e.height + e.block - 1) / e.block;
  const auto build = [&](double subtracted) {
    return build_distribution(across, down, [&](int cell_y, std::span<double> out) {
      std::fill(out.begin(), out.end(), 0.0);
      for (int y = cell_y * e.block; y < std::min((cell_y + 1) * e.block, e.height); ++y) {
        const double weight = environment_row_weight(y, e.height);
        for (int x = 0; x < e.width; ++x) {
          const double l = weighted(e.radiance_at(x, y), weights);
          out[size_t(x / e.block)] += std::max(0.0, l - subtracted) * weight;
        }
      }
    });
  };
  e.by_radiance = build(0);
  // A little above the mean, so that rounding does not leave a constant map with a few lucky texels.
  e.by_compensated = build(mean * (1 + 1e-9));
  if (!drawable(e.by_compensated)) e.by_compensated = {};
  e.black = !drawable(e.by_radiance);
  fill_pdfs(e);
}

Environment build_environment(Image map, const EnvironmentOptions& options) {
  if (map.width < 1 || map.height < 1 || map.channels < 1)
    throw InputError(fmt::format("the environment map {} has no pixels", options.name));
  if (map.channels != 3) {
    Image colour(map.width, map.height, 3);
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        for (int c = 0; c < 3; ++c) colour.at(x, y)[c] = map.at(x, y)[map.channels < 3 ? 0 : c];
    map = std::move(colour);
  }
  Environment e = begin_environment(map.width, map.height, options);
  RadianceMender mender(map.height);
  mender.look(map);
  mender.mend_in_file_space(map, 0);
  mender.mend_in_working_space(map, 0);
  e.repairs = mender.repairs();
  const float gain = std::exp2(options.exposure_ev);
  EnvironmentRepairs::Kind held;
  std::vector<Color> row(static_cast<size_t>(e.width));
  for (int y = 0; y < e.height; ++y) {
    for (int x = 0; x < e.width; ++x) row[size_t(x)] = scaled_radiance(map.at(x, y), gain, x, y, held);
    set_row(e, y, row);
  }
  finish_environment(e);
  tell_held(e, held);
  return e;
}

}  // namespace sateen
