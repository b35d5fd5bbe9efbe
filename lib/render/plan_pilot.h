#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "film/error.h"
#include "integrator/strategy.h"
#include "scene/scene.h"

namespace sateen {

/// What the plan's pilot measured: shares of the picture's light, and what it costs to leave bounces out.
struct PlanPilot {
  std::optional<Interval> weft, surface, volume, back, through_gaps, backdrop;  ///< empty where there is no light
  std::optional<Interval> indirect;                  ///< empty where no bounce was followed
  std::array<Interval, tracked_bounces> lost_after;  ///< E of the picture that ends paths after so many bounces
  float bounce_share = 1;  ///< of the samples that should follow bounces: least error at equal time
  double bounce_cost = 0;  ///< of following all bounces, as a share of a sample's time with direct light alone
};

/// Traces a grid of pixels (render/pixel_grid.h) through the whole scene and follows so many bounces.
PlanPilot run_plan_pilot(const Scene& scene, const LightSettings& light, int bounces, std::uint32_t seed,
                         int threads);

}  // namespace sateen
