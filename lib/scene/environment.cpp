#include "scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;

}  // namespace

double environment_row_weight(int y, int height) {
  // The difference of two cosines as a product, without its cancellation near the poles.
  return 2 * std::sin(pi_d * (y + 0.5) / height) * std::sin(pi_d * 0.5 / height);
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
      // A cell is a texel, or a block of them.
      const auto block = std::uint32_t(e.block);
      const std::uint32_t x0 = cell.x * block, x1 = std::min(x0 + block, std::uint32_t(e.width));
      const std::uint32_t y0 = cell.y * block, y1 = std::min(y0 + block, std::uint32_t(e.height));
      if (!e.texels.empty()) {
        const Environment::Texel& texel = e.texels[size_t(cell.y) * size_t(e.width) + cell.x];
        picks[k].texel = {&texel.radiance, &texel};
        prefetch_texel(picks[k].texel);
      }
      const double top = e.row_cosines[y0], bottom = e.row_cosines[y1];
      const double cosine = top + (bottom - top) * std::clamp(cell.offset_y, e.edge_y, 1 - e.edge_y);
      const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
      const double offset = std::clamp(cell.offset_x, e.edge_x, 1 - e.edge_x);
      const SineCosine longitude = fast_sincos_turns((x0 + (x1 - x0) * offset) / e.width - 0.5 + e.rotation_turns);
      picks[k].direction = Vec3(float(sine * longitude.sine), float(cosine), float(-sine * longitude.cosine));
      if (e.texels.empty()) picks[k].texel = environment_texel(e, picks[k].direction);
    }
  }
}

EnvironmentSample sample_environment(const Environment& e, EnvironmentDensity density, double u0, double u1) {
  EnvironmentPick pick;
  const std::array u{u0, u1};
  pick_environment(e, density, {&u, 1}, &pick);
  if (!pick.texel) return {};
  return {pick.direction, *pick.texel.radiance, texel_pdf(pick.texel, density)};
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
    return e.radiance_at(column, row);
  };
  const Color above = at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx;
  const Color below = at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx;
  return above * (1 - fy) + below * fy;
}

}  // namespace sateen
