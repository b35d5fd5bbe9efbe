#pragma once
#include <string>
#include <vector>

#include "integrator/strategy.h"
#include "scene/scene.h"

namespace sateen {

/// What the pilot found of one strategy.
struct StrategyTrial {
  Strategy strategy = Strategy::mis_compensated;
  int samples = 0;           ///< a pixel: few where it was soon seen to lose
  double squared_error = 0;  ///< E^2 (film/film.h) over the pilot's pixels at so many samples
  double cost = 0;           ///< a sample, [ns] of one core where the costs were measured
  double price() const { return squared_error * cost; }  ///< E^2 at equal time, up to a constant
};

/// How light will be sampled, and why.
struct StrategyChoice {
  Strategy strategy = Strategy::mis_compensated;
  std::string reason;  ///< one sentence for people
  std::vector<StrategyTrial> trials;
};

/// No strategy wins under every light (docs/numbers.md). Tries three on some thousand pixels spread over the picture,
/// direct light alone, and takes the one with the least error at equal time; mis-compensated stays unless another is
/// better by a tenth, more than the pilot's own noise. Time is counted in rays and proposals at measured costs, never
/// by a clock: the same scene gives the same choice on every machine and any number of threads, and never by the
/// samples that are asked for, so that ranges of one picture agree. Costs at most as much as half a sample a pixel of
/// a picture of 960x540.
StrategyChoice choose_strategy(const Scene& scene, const LightSettings& light, std::uint32_t seed, int threads);

}  // namespace sateen
