#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "render/compare.h"
#include "render/effects.h"

namespace sateen {

/// What the plan's pilot measured: shares of the picture's light, and what it costs to leave bounces out.
struct PlanPilot {
  std::optional<Interval> weft, surface, volume, back, through_gaps, backdrop;  ///< empty where there is no light
  std::optional<Interval> indirect;                  ///< empty where no bounce was followed
  std::array<Interval, tracked_bounces> lost_after;  ///< E of the picture that ends paths after so many bounces
  float bounce_share = 1;  ///< of the samples that should follow bounces: least error at equal time
  double bounce_cost = 0;  ///< of following all bounces, as a share of a sample's time with direct light alone

  GridPicture whole;  ///< what was traced, to compare others with
  LightSettings light;
  std::uint32_t seed = 1;
  double error_floor = default_error_floor;
};

/// Traces a grid of pixels (render/pixel_grid.h) through the whole scene and follows so many bounces.
PlanPilot run_plan_pilot(const Scene& scene, const LightSettings& light, double error_floor, int bounces,
                         std::uint32_t seed, int threads);

/// What the pilot's picture is without one of the scene's effects.
struct Removal {
  Interval loss;     ///< E of the picture without it
  Interval share;    ///< of the light that it loses
  double saves = 0;  ///< time, as a share of a sample's with direct light alone and without the effect
};

/// Traces the pilot's grid, with the same random numbers, without one effect of `scene`, which the pilot was run on;
/// up to four times its samples, in both, until the loss is surely above or below `allowed`.
Removal remove_and_compare(const Scene& scene, Effect effect, double allowed, int threads, PlanPilot& pilot);

}  // namespace sateen
