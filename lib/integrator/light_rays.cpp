#include "integrator/light_rays.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "integrator/resample.h"

namespace sateen {

namespace {

/// Directions of a batch that the map proposes.
using Picks = std::array<EnvironmentPick, batch_size>;
void pick_each(const Environment& environment, EnvironmentDensity density, const SequenceBatch& samples,
               Picks& picks) {
  const Batch2 u = draw2(samples, Dimension::environment);
  pick_environment(environment, density, {u.data(), size_t(samples.count)}, picks.data());
}

/// Directions of a batch that the fabric's sampler proposes, with the texels that they fall into.
struct FabricPick {
  std::optional<Vec3> wi;
  Vec3 world;
  MapTexel texel;
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
    pick.texel = environment_texel(environment, pick.world);
    prefetch_texel(pick.texel);
  }
}

/// The points of a batch with their samplers' views.
struct Batch {
  const Scene& scene;
  std::span<const ClothPoint> points;
  const SequenceBatch& samples;
  std::span<SamplerView> views;
  LightRays& out;

  /// Calls `add` for one point after the other and notes where the rays of each begin.
  template <class Add>
  void for_each_point(Add&& add) const {
    out.rays.clear();
    for (size_t k = 0; k < points.size(); ++k) {
      add(k);
      out.first[k + 1] = out.rays.size();
    }
  }

  void sample_fabric(FabricSampler sampler, FabricPicks& picks) const {
    sample_each(
        scene.environment, sampler, samples, [&](size_t k) -> const SamplerView& { return views[k]; },
        [&](size_t k) -> const Frame& { return points[k].frame; }, picks);
  }

  void by_fabric(FabricSampler sampler) const {
    FabricPicks picks;
    sample_fabric(sampler, picks);
    for_each_point([&](size_t k) {
      if (!picks[k].wi) return;
      const float density = pdf(views[k], *picks[k].wi);
      out.add(*picks[k].wi, picks[k].world, *picks[k].texel.radiance, density > 0 ? 1 / density : 0);
    });
  }

  void by_environment() const {
    Picks picks;
    pick_each(scene.environment, EnvironmentDensity::radiance, samples, picks);
    for_each_point([&](size_t k) {
      if (!picks[k].texel) return;
      if (const Vec3 wi = points[k].frame.to_local(picks[k].direction); wi.z > 0)
        out.add(wi, picks[k].direction, *picks[k].texel.radiance, 1 / picks[k].texel.density->pdf_radiance);
    });
  }

  void by_candidates(const LightSettings& settings) const {
    const Batch1 u = draw(samples, Dimension::shadows);
    for_each_point([&](size_t k) {
      propose_candidates(scene, points[k], views[k].table, samples.sequence(int(k)), samples.index[k], settings, u[k],
                         out);
    });
  }

  /// One direction of each kind, balance heuristic: each weighs 1 / (sum of both densities).
  void by_both(FabricSampler sampler, EnvironmentDensity density) const {
    Picks picks;
    pick_each(scene.environment, density, samples, picks);
    FabricPicks drawn;
    sample_fabric(sampler, drawn);
    for_each_point([&](size_t k) {
      const auto weight = [&](const Vec3& wi, const MapTexel& texel) {
        const float both = pdf(views[k], wi) + texel_pdf(texel, density);
        return both > 0 ? 1 / both : 0;
      };
      if (picks[k].texel)
        if (const Vec3 wi = points[k].frame.to_local(picks[k].direction); wi.z > 0)
          out.add(wi, picks[k].direction, *picks[k].texel.radiance, weight(wi, picks[k].texel));
      if (drawn[k].wi)
        out.add(*drawn[k].wi, drawn[k].world, *drawn[k].texel.radiance, weight(*drawn[k].wi, drawn[k].texel));
    });
  }
};

}  // namespace

void propose_light_rays(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                        const SequenceBatch& samples, std::span<SamplerView> views, LightRays& out) {
  const FabricSampler sampler = strategy_sampler(settings.strategy);
  if (settings.strategy != Strategy::environment)
    for (size_t k = 0; k < points.size(); ++k) prepare_sampler(*points[k].fabric, points[k].wo, sampler, views[k]);
  const Batch batch{scene, points, samples, views, out};
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
      // Nothing of a constant map stands out from its mean: all of it is the table's.
      if (!drawable(scene.environment.by_compensated)) return batch.by_fabric(sampler);
      return batch.by_both(sampler, EnvironmentDensity::compensated);
    case Strategy::resampled:
    case Strategy::automatic:
      return batch.by_candidates(settings);
  }
}

}  // namespace sateen
