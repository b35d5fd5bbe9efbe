#pragma once
#include "math/angles.h"
#include "scene/environment.h"

namespace sateen {

/// Place in the map's pixels, x in [0, width), y in [0, height]; y from atan2 and not from acos, which cannot tell
/// rows near the poles apart.
struct MapPlace {
  double x, y;
};

inline MapPlace environment_place(const Environment& environment, const Vec3& direction) {
  const double dx = double(direction.x), dy = double(direction.y), dz = double(direction.z);
  double u = fast_atan2(dx, -dz) * (0.5 / std::numbers::pi) + 0.5 - environment.rotation_turns;
  u = u < 0 ? u + 1 : u;
  const double v = fast_atan2(std::sqrt(dx * dx + dz * dz), dy) * (1 / std::numbers::pi);
  return {u * environment.width, v * environment.height};
}

inline const Environment::Texel& environment_texel(const Environment& environment, const Vec3& direction) {
  const MapPlace place = environment_place(environment, direction);
  // Written so that a NaN falls to 0.
  const int x = place.x > 0 ? std::min(int(std::min(place.x, 1e6)), environment.width - 1) : 0;
  const int y = place.y > 0 ? std::min(int(std::min(place.y, 1e6)), environment.height - 1) : 0;
  return environment.texels[std::size_t(y) * std::size_t(environment.width) + std::size_t(x)];
}

}  // namespace sateen
