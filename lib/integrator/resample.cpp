#include "integrator/resample.h"

#include <algorithm>

namespace sateen {

namespace {

static_assert(most_candidates <= batch_size);  // that many numbers are drawn at once
constexpr float least_open = 0.05f;  // what a direction that looks closed is worth: measured, 0.02 to 0.1 are alike
constexpr size_t few = 8;            // candidates whose shadows are all traced

struct Candidates {
  size_t count = 0;
  std::array<Vec3, 2 * most_candidates> wi, world;
  std::array<MapTexel, 2 * most_candidates> texel;
};

void propose_lights(const Environment& environment, const ClothPoint& point, Sequence sequence, std::uint32_t first,
                    size_t count, Candidates& found) {
  std::array<std::array<double, 2>, most_candidates> u;
  draw2(sequence, Dimension::environment, first, {u.data(), count});
  std::array<EnvironmentPick, most_candidates> picks;
  pick_environment(environment, EnvironmentDensity::compensated, {u.data(), count}, picks.data());
  for (const EnvironmentPick& pick : std::span(picks).first(count)) {
    if (!pick.texel) return;
    const Vec3 wi = point.frame.to_local(pick.direction);
    if (!(wi.z > 0)) continue;
    found.wi[found.count] = wi;
    found.world[found.count] = pick.direction;
    found.texel[found.count++] = pick.texel;
  }
}

void propose_scattering(const Environment& environment, const ClothPoint& point, const TableView& table,
                        Sequence sequence, std::uint32_t first, size_t count, Candidates& found) {
  std::array<double, most_candidates> u_view;
  std::array<std::array<double, 2>, most_candidates> u;
  draw(sequence, Dimension::table_view, first, {u_view.data(), count});
  draw2(sequence, Dimension::table, first, {u.data(), count});
  const size_t from = found.count;
  sample_table(table, {u_view.data(), count}, {u.data(), count}, &found.wi[from]);
  for (size_t j = from; j < from + count; ++j) found.world[j] = point.frame.to_world(found.wi[j]);
  environment_texels(environment, {&found.world[from], count}, &found.texel[from]);
  for (size_t j = from; j < from + count; ++j) prefetch_texel(found.texel[j]);
  found.count += count;
}

}  // namespace

void propose_candidates(const Scene& scene, const ClothPoint& point, const TableView& table, Sequence sequence,
                        std::uint32_t index, const LightSettings& settings, double u, LightRays& out) {
  const Environment& environment = scene.environment;
  // Nothing of a constant map stands out from its mean: all of it is the table's.
  const auto by_table = std::uint32_t(settings.candidates.table);
  const auto by_map = drawable(environment.by_compensated) ? std::uint32_t(settings.candidates.map) : 0;
  Candidates c;
  if (by_map > 0) propose_lights(environment, point, sequence, index * by_map, by_map, c);
  propose_scattering(environment, point, table, sequence, index * by_table, by_table, c);
  std::array<float, 2 * most_candidates> density;
  table_pdfs(table, {c.wi.data(), c.count}, density.data());
  const size_t before = out.rays.size();
  for (size_t i = 0; i < c.count; ++i) {
    const float both =
        float(by_table) * density[i] + (by_map > 0 ? float(by_map) * c.texel[i].density->pdf_compensated : 0);
    if (both > 0) out.add(c.wi[i], c.world[i], *c.texel[i].radiance, 1 / both, density[i]);
  }
  const std::span<LightRay> proposed = std::span(out.rays).subspan(before);
  if (proposed.size() <= few) return;
  if (const OpenDirections* const open = open_directions(scene, point))
    for (LightRay& ray : proposed) ray.odds = std::max(openness_along(scene, point, *open, ray.world), least_open);
  out.rays.resize(before + thin_out(proposed, settings.shadows, u));
}

size_t thin_out(std::span<LightRay> rays, int most, double u) {
  double sum = 0;
  for (const LightRay& ray : rays) sum += double(ray.worth * ray.odds);
  const double enough = sum / most;
  double passed = u * enough;
  size_t kept = 0;
  // Without a branch, for none would foresee who is kept.
  for (const LightRay& ray : rays) {
    const double worth = double(ray.worth * ray.odds);
    const bool surely = !(worth < enough);
    passed += worth * !surely;
    const bool next = passed >= enough;
    passed -= enough * next;
    const float stands_for[] = {1, float(enough / worth)};
    LightRay& to = rays[kept];
    to = ray;
    to.light *= stands_for[next];
    to.worth *= stands_for[next];
    kept += (surely || next) && worth > 0;
  }
  return kept;
}

}  // namespace sateen
