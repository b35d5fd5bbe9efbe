#include "render/albedo_map.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace sateen {

namespace {
// A layer to look at: 1 % is enough, and it is computed before the first pass.
constexpr int map_thetas = 72;

AlbedoMap map_albedo(const Fabric& fabric, int threads) {
  AlbedoMap map;
  map.fabric = &fabric;
  map.values.resize(size_t(AlbedoMap::cosines * AlbedoMap::azimuths));
  parallel_for(int(map.values.size()), threads, [&](int i) {
    const float z = (float(i / AlbedoMap::azimuths) + 0.5f) / AlbedoMap::cosines;
    const float angle = 2 * pi * float(i % AlbedoMap::azimuths) / AlbedoMap::azimuths, r = std::sqrt(1 - z * z);
    map.values[size_t(i)] = albedo(fabric.threads, Vec3(r * std::cos(angle), r * std::sin(angle), z), map_thetas);
  });
  return map;
}
}  // namespace

AlbedoMaps map_albedos(const Scene& scene, int threads) {
  AlbedoMaps maps;
  for (const Fabric* fabric : fabrics_of(scene)) maps.push_back(map_albedo(*fabric, threads));
  return maps;
}

Albedo look_up(const AlbedoMap& map, const Vec3& wo) {
  const float row = std::clamp(wo.z * AlbedoMap::cosines - 0.5f, 0.0f, float(AlbedoMap::cosines - 1));
  float column = std::atan2(wo.y, wo.x) * (AlbedoMap::azimuths / (2 * pi));
  if (column < 0) column += AlbedoMap::azimuths;
  const int r0 = std::min(int(row), AlbedoMap::cosines - 2), c0 = int(column) % AlbedoMap::azimuths;
  const int c1 = (c0 + 1) % AlbedoMap::azimuths;
  const float fr = row - float(r0), fc = column - std::floor(column);
  const auto blend = [&](const auto& part) {
    const auto at = [&](int r, int c) { return part(map.values[size_t(r * AlbedoMap::azimuths + c)]); };
    return (at(r0, c0) * (1 - fc) + at(r0, c1) * fc) * (1 - fr) +
           (at(r0 + 1, c0) * (1 - fc) + at(r0 + 1, c1) * fc) * fr;
  };
  Albedo out;
  out.surface = blend([](const Albedo& a) { return a.surface; });
  for (size_t family = 0; family < 2; ++family) {
    out.volume[family] = blend([&](const Albedo& a) { return a.volume[family]; });
    out.surface_of[family] = blend([&](const Albedo& a) { return a.surface_of[family]; });
  }
  return out;
}

Color sample_albedo(const AlbedoMaps& maps, const CameraSample& sample) {
  Color sum(0);
  for (const AlbedoMap& map : maps) {
    if (map.fabric != sample.fabric) continue;
    const Albedo parts = look_up(map, sample.wo);
    for (size_t family = 0; family < 2; ++family)
      sum += (Color(parts.surface_of[family]) + sample.A[family] * parts.volume[family]) * sample.presence[family];
  }
  return sum;
}

}  // namespace sateen
