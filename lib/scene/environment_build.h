#pragma once
#include <span>

#include "scene/environment.h"

namespace sateen {

/// A map is built in three steps, so that it can come a row at a time: begun, its rows set, finished.
Environment begin_environment(int width, int height, const EnvironmentOptions& options);

/// Radiance as a map holds it: scaled by `gain`, held at 1e35 (counted as `held` with its place), subnormals 0.
Color scaled_radiance(const float* rgb, float gain, int x, int y, EnvironmentRepairs::Kind& held);

/// One row of the map, of its width.
void set_row(Environment& environment, int y, std::span<const Color> radiance);

/// Mean, distributions and densities, once all radiance is set.
void finish_environment(Environment& environment);

/// What was held at 1e35 becomes one of the map's doubts.
void tell_held(Environment& environment, const EnvironmentRepairs::Kind& held);

/// Adds one pixel to a kind of repair.
inline void count_repair(EnvironmentRepairs::Kind& kind, int x, int y) {
  if (kind.count++ > 0) return;
  kind.first_x = x;
  kind.first_y = y;
}

}  // namespace sateen
