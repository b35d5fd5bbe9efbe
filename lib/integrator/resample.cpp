#include "integrator/resample.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

constexpr size_t most_candidates = batch_size;  // of each kind
constexpr float least_open = 0.05f;  // what a direction that looks closed is worth: measured, 0.02 to 0.1 are alike

struct Candidates {
  size_t count = 0;
  std::array<Vec3, 2 * most_candidates> wi, world;
  std::array<const Environment::Texel*, 2 * most_candidates> texel;
};

void propose_lights(const Environment& environment, const ClothPoint& point, Sequence sequence, std::uint32_t first,
                    size_t count, Candidates& found) {
  std::array<std::array<double, 2>, most_candidates> u;
  draw2(sequence, Dimension::environment, first, {u.data(), count});
  for (size_t j = 0; j < count; ++j) {
    const EnvironmentPick pick = pick_environment(environment, EnvironmentDensity::compensated, u[j][0], u[j][1]);
    if (!pick.texel) return;
    const Vec3 wi = point.frame.to_local(pick.direction);
    if (!(wi.z > 0)) continue;
    prefetch_texel(pick.texel);
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

void resample(const Scene& scene, const ClothPoint& point, const TableView& table, Sequence sequence,
              std::uint32_t index, int count, LightRays& out) {
  const Environment& environment = scene.environment;
  // Nothing of a constant map stands out from its mean: all of it is the table's.
  const bool has_lights = drawable(environment.by_compensated);
  const std::uint32_t first = index * std::uint32_t(count);
  Candidates c;
  if (has_lights) propose_lights(environment, point, sequence, first, size_t(count), c);
  propose_scattering(environment, point, table, sequence, first, size_t(count), c);

  std::array<float, 2 * most_candidates> density, target, running;
  table_pdfs(table, {c.wi.data(), c.count}, density.data());
  if (c.count <= size_t(LightRays::most)) {  // room for all: plain multiple importance sampling
    for (size_t i = 0; i < c.count; ++i) {
      const float both = density[i] + (has_lights ? c.texel[i]->pdf_compensated : 0);
      if (both > 0) out.add(c.wi[i], c.world[i], c.texel[i]->radiance, 1 / (float(count) * both));
    }
    return;
  }
  for (size_t i = 0; i < c.count; ++i) target[i] = density[i] * mean_component(c.texel[i]->radiance);
  if (const OpenDirections* const open = open_directions(scene, point))
    for (size_t i = 0; i < c.count; ++i)
      target[i] *= std::max(openness_along(scene, point, *open, c.world[i]), least_open);
  if (has_lights)
    for (size_t i = 0; i < c.count; ++i) density[i] += c.texel[i]->pdf_compensated;
  float sum = 0;
  size_t last = 0;
  for (size_t i = 0; i < c.count; ++i) {
    if (target[i] > 0) sum += target[i] / density[i], last = i;
    running[i] = sum;
  }
  if (!(sum > 0)) return;

  constexpr int kept = LightRays::most;
  const float step = sum / float(kept), start = float(draw(sequence, Dimension::choice, index)) * step;
  const float share = step / float(count);  // what each that is kept stands for, times its target
  int k = 0;
  for (size_t i = 0; k < kept; ++i) {
    const int before = k;
    while (k < kept && (running[i] > start + step * float(k) || i == last)) ++k;
    if (k > before) out.add(c.wi[i], c.world[i], c.texel[i]->radiance, float(k - before) * share / target[i]);
  }
}

}  // namespace sateen
