#pragma once
#include <vector>

#include "integrator/path.h"

namespace sateen {

/// Parts of the reflectance of a fabric by view, for the layer `albedo`: computed only where that is asked for.
struct AlbedoMap {
  static constexpr int cosines = 8, azimuths = 16;
  const Fabric* fabric = nullptr;
  std::vector<Albedo> values;  ///< [cosine][azimuth]
};
using AlbedoMaps = std::vector<AlbedoMap>;  ///< one for each fabric of the scene

AlbedoMaps map_albedos(const Scene& scene, int threads);

/// Bilinear in cosine and azimuth of a unit wo in the cloth frame.
Albedo look_up(const AlbedoMap& map, const Vec3& wo);

/// Reflectance under white light of what a sample sees first, with the colours and the coverage that textures give it
/// and with its own yarn where that is seen from near; other numbers count by their means. Black where no map is the
/// fabric's.
Color sample_albedo(const AlbedoMaps& maps, const CameraSample& sample);

}  // namespace sateen
