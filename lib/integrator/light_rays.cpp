#include "integrator/light_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace sateen {

namespace {

constexpr int most_candidates = 64;
constexpr float least_open = 0.05f;  // what a direction that looks closed is worth: measured, 0.02 to 0.1 are alike

float brightness(const Color& c) {
  return mean_component(c);
}

void add_ray(LightRays& rays, const Vec3& wi, const Vec3& world, const Color& radiance, float weight) {
  if (weight > 0 && max_component(radiance) > 0) rays.rays[size_t(rays.count++)] = {wi, world, radiance * weight};
}

/// Directions of a batch that the map proposes.
using Picks = std::array<EnvironmentPick, batch_size>;
void pick_each(const Environment& environment, EnvironmentDensity density, const SequenceBatch& samples,
               Picks& picks) {
  const Batch2 u = draw2(samples, Dimension::environment);
  for (size_t k = 0; k < size_t(samples.count); ++k) {
    picks[k] = pick_environment(environment, density, u[k][0], u[k][1]);
    if (picks[k].texel) prefetch_texel(picks[k].texel);
  }
}

/// Directions of a batch that the fabric's sampler proposes, with the texels that they fall into.
struct FabricPick {
  std::optional<Vec3> wi;
  Vec3 world;
  const Environment::Texel* texel = nullptr;
};
using FabricPicks = std::array<FabricPick, batch_size>;
template <class View, class Frame>
void sample_each(const Environment& environment, FabricSampler sampler, const SequenceBatch& samples, View&& view_of,
                 Frame&& frame_of, FabricPicks& picks) {
  Batch1 choice{};
  Batch2 thread{}, direction{};
  switch (sampler) {
    case FabricSampler::uniform:
      direction = draw2(samples, Dimension::uniform);
      break;
    case FabricSampler::talk:
      thread = draw2(samples, Dimension::talk_thread);
      direction = draw2(samples, Dimension::talk);
      break;
    case FabricSampler::table:
      choice = draw(samples, Dimension::table_view);
      direction = draw2(samples, Dimension::table);
      break;
  }
  for (size_t k = 0; k < size_t(samples.count); ++k) {
    FabricPick& pick = picks[k];
    pick.wi = sample(view_of(k), {choice[k], thread[k], direction[k]});
    if (!pick.wi) continue;
    pick.world = frame_of(k).to_world(*pick.wi);
    pick.texel = &environment_texel(environment, pick.world);
    prefetch_texel(pick.texel);
  }
}

/// Resampled importance sampling (Talbot et al. 2005) over `count` candidates of the table and `count` of the
/// compensated map, target = table density times radiance times how open the direction is, balance weights
/// (cloth-model.md section 6). Unbiased: the table's floor and `least_open` keep the target positive wherever the
/// integrand is.
void resample(const Scene& scene, const ClothPoint& point, const SamplerView& view, Sequence sequence,
              std::uint32_t index, int count, LightRays& out) {
  const Environment& environment = scene.environment;
  struct Candidate {
    Vec3 wi, world;
    const Environment::Texel* texel;
    float running;  ///< sum of the weights up to this one
    float target;
  };
  // Filled as far as candidates are found; all directions come first, so that their texels arrive together.
  std::array<Candidate, 2 * most_candidates> kept;
  size_t n = 0;
  const std::uint32_t first = index * std::uint32_t(count);
  for (int done = 0; done < count; done += batch_size) {
    SequenceBatch candidates;
    candidates.count = std::min(count - done, batch_size);
    candidates.seed.fill(sequence.seed);
    for (size_t j = 0; j < batch_size; ++j) candidates.index[j] = first + std::uint32_t(done) + std::uint32_t(j);
    Picks picks;
    pick_each(environment, EnvironmentDensity::compensated, candidates, picks);
    FabricPicks drawn;
    sample_each(
        environment, FabricSampler::table, candidates, [&](size_t) -> const SamplerView& { return view; },
        [&](size_t) -> const Frame& { return point.frame; }, drawn);
    for (size_t j = 0; j < size_t(candidates.count); ++j) {
      if (!picks[j].texel) continue;
      if (const Vec3 wi = point.frame.to_local(picks[j].direction); wi.z > 0)
        kept[n++] = {wi, picks[j].direction, picks[j].texel, 0, 0};
    }
    for (size_t j = 0; j < size_t(candidates.count); ++j)
      kept[n++] = {*drawn[j].wi, drawn[j].world, drawn[j].texel, 0, 0};
  }
  const OpenDirections* const open = open_directions(scene, point);
  float sum = 0;
  for (size_t i = 0; i < n; ++i) {
    Candidate& c = kept[i];
    const float p_table = table_pdf(view.table, c.wi);
    c.target = p_table * brightness(c.texel->radiance);
    if (open) c.target *= std::max(openness_along(scene, point, *open, c.world), least_open);
    const float both = p_table + c.texel->pdf_compensated;
    if (c.target > 0) sum += c.target / (float(count) * both);
    c.running = sum;
  }
  if (!(sum > 0)) return;
  const float place = float(draw(sequence, Dimension::choice, index)) * sum;
  size_t chosen = 0;
  while (chosen < n - 1 && kept[chosen].running <= place) ++chosen;
  const Candidate& c = kept[chosen];
  if (c.target > 0) add_ray(out, c.wi, c.world, c.texel->radiance, sum / c.target);
}

/// The points of a batch with their samplers' views.
struct Batch {
  const Environment& environment;
  std::span<const ClothPoint> points;
  const SequenceBatch& samples;
  std::span<SamplerView> views;
  std::span<LightRays> out;

  void sample_fabric(FabricSampler sampler, FabricPicks& picks) const {
    sample_each(
        environment, sampler, samples, [&](size_t k) -> const SamplerView& { return views[k]; },
        [&](size_t k) -> const Frame& { return points[k].frame; }, picks);
  }

  void by_fabric(FabricSampler sampler) const {
    FabricPicks picks;
    sample_fabric(sampler, picks);
    for (size_t k = 0; k < points.size(); ++k) {
      if (!picks[k].wi) continue;
      const float density = pdf(views[k], *picks[k].wi);
      add_ray(out[k], *picks[k].wi, picks[k].world, picks[k].texel->radiance, density > 0 ? 1 / density : 0);
    }
  }

  void by_environment() const {
    Picks picks;
    pick_each(environment, EnvironmentDensity::radiance, samples, picks);
    for (size_t k = 0; k < points.size(); ++k) {
      if (!picks[k].texel) continue;
      if (const Vec3 wi = points[k].frame.to_local(picks[k].direction); wi.z > 0)
        add_ray(out[k], wi, picks[k].direction, picks[k].texel->radiance, 1 / picks[k].texel->pdf_radiance);
    }
  }

  /// One direction of each kind, balance heuristic: each weighs 1 / (sum of both densities).
  void by_both(FabricSampler sampler, EnvironmentDensity density) const {
    Picks picks;
    pick_each(environment, density, samples, picks);
    FabricPicks drawn;
    sample_fabric(sampler, drawn);
    for (size_t k = 0; k < points.size(); ++k) {
      const auto weight = [&](const Vec3& wi, const Environment::Texel& texel) {
        const float both = pdf(views[k], wi) + texel_pdf(texel, density);
        return both > 0 ? 1 / both : 0;
      };
      if (picks[k].texel)
        if (const Vec3 wi = points[k].frame.to_local(picks[k].direction); wi.z > 0)
          add_ray(out[k], wi, picks[k].direction, picks[k].texel->radiance, weight(wi, *picks[k].texel));
      if (drawn[k].wi)
        add_ray(out[k], *drawn[k].wi, drawn[k].world, drawn[k].texel->radiance,
                weight(*drawn[k].wi, *drawn[k].texel));
    }
  }
};

}  // namespace

void choose_light_rays(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                       const SequenceBatch& samples, std::span<SamplerView> views, std::span<LightRays> out) {
  const FabricSampler sampler = strategy_sampler(settings.strategy);
  if (settings.strategy != Strategy::environment)
    for (size_t k = 0; k < points.size(); ++k) prepare_sampler(*points[k].fabric, points[k].wo, sampler, views[k]);
  const Batch batch{scene.environment, points, samples, views, out};
  switch (settings.strategy) {
    case Strategy::uniform:
    case Strategy::talk:
    case Strategy::table:
      return batch.by_fabric(sampler);
    case Strategy::environment:
      return batch.by_environment();
    case Strategy::mis:
    case Strategy::mis_talk:
      return batch.by_both(sampler, EnvironmentDensity::radiance);
    case Strategy::mis_compensated:
    case Strategy::automatic:
      // Nothing of a constant map stands out from its mean: all of it is the table's.
      if (!drawable(scene.environment.by_compensated)) return batch.by_fabric(sampler);
      return batch.by_both(sampler, EnvironmentDensity::compensated);
    case Strategy::resampled:
      for (size_t k = 0; k < points.size(); ++k)
        resample(scene, points[k], views[k], samples.sequence(int(k)), samples.index[k], settings.candidates, out[k]);
  }
}

}  // namespace sateen
