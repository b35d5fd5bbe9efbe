#pragma once
#include <array>
#include <span>

#include "integrator/strategy.h"
#include "sampling/sampler.h"
#include "scene/scene.h"

namespace sateen {

/// A direction in which to look for light: F there times `light` is the estimate, if nothing is in the way.
struct LightRay {
  Vec3 wi, world;  ///< the direction in the cloth's frame and in the world's
  Color light;     ///< radiance times the direction's weight
};

/// What a strategy chose for one point, none with black light.
struct LightRays {
  static constexpr int most = 8;
  int count = 0;
  std::array<LightRay, most> rays;

  void add(const Vec3& wi, const Vec3& world, const Color& radiance, float weight) {
    if (weight > 0 && max_component(radiance) > 0) rays[size_t(count++)] = {wi, world, radiance * weight};
  }

  std::span<const LightRay> chosen() const { return {rays.data(), size_t(count)}; }
};

/// Chooses for each of up to batch_size points by the strategy asked for. Works through the whole batch step by step:
/// texels of a large map are asked for all together, long before they are needed. `views` is room for the samplers'
/// view terms.
void choose_light_rays(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                       const SequenceBatch& samples, std::span<SamplerView> views, std::span<LightRays> out);

}  // namespace sateen
