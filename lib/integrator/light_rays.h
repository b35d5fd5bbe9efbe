#pragma once
#include <array>
#include <span>
#include <vector>

#include "integrator/strategy.h"
#include "sampling/sampler.h"
#include "scene/scene.h"

namespace sateen {

/// A direction in which to look for light: F there times `light` is the estimate, if nothing is in the way.
struct LightRay {
  Vec3 wi, world;  ///< the direction in the cloth's frame and in the world's
  Color light;     ///< radiance times the direction's weight
  /// About what it brings if nothing is in the way, where a strategy proposes more than it keeps, and the odds of
  /// that or, once its shadow is traced, what is let pass.
  float worth = 0, odds = 1;
};

/// What a strategy proposes for the points of a batch, point after point; none with black light. Kept from batch to
/// batch, so that its room is got once.
struct LightRays {
  std::vector<LightRay> rays;
  std::array<size_t, batch_size + 1> first{};  ///< of each point's rays

  void add(const Vec3& wi, const Vec3& world, const Color& radiance, float weight, float density = 0) {
    if (!(weight > 0) || !(max_component(radiance) > 0)) return;
    const Color light = radiance * weight;
    rays.push_back({wi, world, light, density * mean_component(light), 1});
  }

  std::span<LightRay> of(size_t point) { return {rays.data() + first[point], first[point + 1] - first[point]}; }
};

/// Proposes for each of up to batch_size points by the strategy asked for. Works through the whole batch step by
/// step: texels of a large map are asked for all together, long before they are needed. `views` is room for the
/// samplers' view terms.
void propose_light_rays(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                        const SequenceBatch& samples, std::span<SamplerView> views, LightRays& out);

}  // namespace sateen
