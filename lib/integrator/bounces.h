#pragma once
#include "film/film.h"
#include "integrator/direct.h"
#include "integrator/vertex.h"

namespace sateen {

/// Where a sample's path begins that is followed from surface to surface.
struct PathStart {
  Vertex vertex;
  SampleId id;
};

/// Most layers of sheer cloth that a ray passes.
inline constexpr int most_layers = 64;

/// Light that comes to the start of each of up to batch_size paths after one more meeting with cloth or ground and
/// further ones, by bounce: one unbiased estimate each, the same bits in any batch. The paths take every step side by
/// side; F is evaluated only where a path meets something.
void follow_bounces(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                    std::span<const PathStart> starts, PathScratch& scratch, BounceLight* light);

}  // namespace sateen
