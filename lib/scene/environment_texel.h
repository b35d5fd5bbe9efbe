#pragma once
#include <span>

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

inline MapTexel texel_at(const Environment& environment, const MapPlace& place) {
  // Written so that a NaN falls to 0.
  const int x = place.x > 0 ? std::min(int(std::min(place.x, 1e6)), environment.width - 1) : 0;
  const int y = place.y > 0 ? std::min(int(std::min(place.y, 1e6)), environment.height - 1) : 0;
  const std::size_t i = std::size_t(y) * std::size_t(environment.width) + std::size_t(x);
  if (!environment.texels.empty()) return {&environment.texels[i].radiance, &environment.texels[i]};
  const std::size_t cell = std::size_t(y / environment.block) * std::size_t(environment.by_radiance.width) +
                           std::size_t(x / environment.block);
  return {&environment.fine[i], &environment.blocks[cell]};
}

inline MapTexel environment_texel(const Environment& environment, const Vec3& direction) {
  return texel_at(environment, environment_place(environment, direction));
}

/// The same for many directions, of which eight are computed side by side.
inline void environment_texels(const Environment& environment, std::span<const Vec3> directions, MapTexel* texels) {
  constexpr std::size_t width = 8;
  for (std::size_t from = 0; from < directions.size(); from += width) {
    const std::size_t count = std::min(directions.size() - from, width);
    double x[width], y[width];
    Vec3 direction[width];
    for (std::size_t i = 0; i < width; ++i) direction[i] = directions[from + std::min(i, count - 1)];
    for (std::size_t i = 0; i < width; ++i) {
      const MapPlace place = environment_place(environment, direction[i]);
      x[i] = place.x, y[i] = place.y;
    }
    for (std::size_t i = 0; i < count; ++i) texels[from + i] = texel_at(environment, {x[i], y[i]});
  }
}

}  // namespace sateen
