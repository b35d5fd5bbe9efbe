#include "render/ray_time.h"

namespace sateen {

namespace {

// Of a ray from the camera, of a point of cloth that is lit, without and with its sampler's proposals, of a shadow
// ray with its share of evaluations, and of a ray that leaves a point, with F there and the way to the next [ns].
constexpr double camera = 60, point = 270, bounce = 870;
// Of a shadow ray that looks for gaps, besides: dupioni and organza on the drape.
constexpr double gap = 270;

double proposals(const LightSettings& light) {
  switch (light.strategy) {
    case Strategy::table:
      return 90;
    case Strategy::environment:
      return 30;
    case Strategy::resampled:
      return 900 + 86 * light.candidates.table + 69 * light.candidates.map;
    default:
      return 220;
  }
}

double shadow(const LightSettings& light) {
  switch (light.strategy) {
    case Strategy::environment:  // towards the same few lights rays run together
      return 320;
    case Strategy::resampled:  // streams are longer, and F, of a few of them, is with the point
      return 102;
    default:
      return 390;
  }
}

}  // namespace

double direct_time(const RayCounts& rays, const LightSettings& light) {
  return 1e-9 * (double(rays.camera) * camera + double(rays.lit - rays.lit_after) * (point + proposals(light)) +
                 double(rays.shadow - rays.shadow_after) * shadow(light));
}

double bounce_time(const RayCounts& rays, const LightSettings& light) {
  return 1e-9 * (double(rays.bounce) * bounce + double(rays.lit_after) * (point + proposals(light)) +
                 double(rays.shadow_after) * shadow(light));
}

double gap_time(const RayCounts& rays) {
  return 1e-9 * double(rays.shadow) * gap;
}

}  // namespace sateen
