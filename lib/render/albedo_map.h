#pragma once
#include <vector>

#include "scene/scene.h"

namespace sateen {

/// Reflectance of a fabric under white light by view, for the layer `albedo`: computed only where that is asked for.
struct AlbedoMap {
  static constexpr int cosines = 8, azimuths = 16;
  std::vector<Color> values;  ///< [cosine][azimuth], working space
};
struct AlbedoMaps {
  AlbedoMap front, back;
};

AlbedoMaps map_albedos(const Scene& scene, int threads);

/// Bilinear in cosine and azimuth of a unit wo in the cloth frame; black for an empty map.
Color look_up(const AlbedoMap& map, const Vec3& wo);

}  // namespace sateen
