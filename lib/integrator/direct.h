#pragma once
#include <vector>

#include "integrator/strategy.h"
#include "sampling/sampler.h"
#include "scene/scene.h"

namespace sateen {

/// Light of one estimate, split by thread family and lobe: warp and weft, surface and volume [working space].
struct LobeLight {
  Color surface[2] = {Color(0), Color(0)}, volume[2] = {Color(0), Color(0)};

  Color total() const { return surface[0] + surface[1] + volume[0] + volume[1]; }
};

/// Counts of one thread; merged at the end of a pass.
struct RayCounts {
  std::vector<Ray>* log = nullptr;  ///< where given, every shadow ray is kept here (the benchmark traces them bare)
  std::int64_t camera = 0, shadow = 0, bounce = 0;
  std::int64_t non_finite = 0;  ///< estimates that were not finite and were dropped: a fault, reported
};

/// One unbiased estimate of the environment's light by way of the cloth at `point`, shadowed by the cloth.
/// `view` is prepared for the strategy's sampler at point.wo. `index` is the sample's place in the pixel's sequence.
LobeLight direct_light(const Scene& scene, const ClothPoint& point, const FabricView& view,
                       const LightSettings& settings, Sequence sequence, std::uint32_t index, RayCounts& counts);

/// Share of light that passes from a point along a world direction to the environment: 0 or 1, or what gaps let pass.
float transmittance(const Scene& scene, const ClothPoint& point, const Vec3& direction, RayCounts& counts);

}  // namespace sateen
