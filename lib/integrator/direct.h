#pragma once
#include <span>
#include <vector>

#include "integrator/light_rays.h"
#include "sampling/sampler.h"
#include "scene/scene.h"

namespace sateen {

/// Light of one estimate, split by thread family and lobe: warp and weft, surface and volume [working space].
struct LobeLight {
  Color surface[2] = {Color(0), Color(0)}, volume[2] = {Color(0), Color(0)};

  Color total() const { return surface[0] + surface[1] + volume[0] + volume[1]; }
};

/// Rays that were traced, for the benchmark to trace them bare.
struct RayLog {
  std::vector<Ray> shadow, bounce;
};

/// Counts of one thread; merged at the end of a pass.
struct RayCounts {
  RayLog* log = nullptr;  ///< where given, rays are kept here
  std::int64_t camera = 0, shadow = 0, bounce = 0;
  std::int64_t lit = 0;                          ///< points of cloth whose direct light was estimated
  std::int64_t shadow_after = 0, lit_after = 0;  ///< how many of them belong to points that bounces met
  std::int64_t non_finite = 0;  ///< estimates that were not finite and were dropped: a fault, reported

  void add(const RayCounts& more) {
    camera += more.camera;
    shadow += more.shadow;
    bounce += more.bounce;
    lit += more.lit;
    shadow_after += more.shadow_after;
    lit_after += more.lit_after;
    non_finite += more.non_finite;
  }
};

/// What a thread needs to trace; large, so one is kept a thread.
struct PathScratch {
  FabricView view;                               ///< of the hit that is being lit
  FabricView vertex;                             ///< of the vertex that a path leaves
  std::array<SamplerView, batch_size> samplers;  ///< of a batch of hits
  MovingRays moving;                             ///< of a batch, under a shutter
  std::array<ClothPoint, batch_size> cloth;      ///< of a batch, that its camera rays met
  std::array<GroundPoint, batch_size> ground;
  LightRays light;  ///< of a batch
  RayCounts counts;
};

/// Share of the environment's light that the cloth lets pass along up to RayTracer::stream_size rays: 0 or 1, or what
/// gaps let pass.
void trace_shadow_rays(const Scene& scene, std::span<const Ray> rays, RayCounts& counts, float* passed);

/// One unbiased estimate for each of up to batch_size points of the environment's light by way of the cloth,
/// shadowed by the cloth and the ground. `samples` holds each point's sequence and its place in it. An estimate has
/// the same bits in any batch.
void direct_light(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                  const SequenceBatch& samples, PathScratch& scratch, LobeLight* light);

}  // namespace sateen
