#include "scene/cloth_maps.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

float fabric_gap_at(const FabricMaps& maps, const Fabric& fabric, const Vec2& uv, const Footprint& footprint) {
  return maps.coverage[0] || maps.coverage[1] ? values_at(maps, uv, footprint).gap : fabric.gap;
}

}  // namespace

bool FabricMaps::any_numbers() const {
  return std::any_of(std::begin(number_maps), std::end(number_maps),
                     [&](const NumberMap& n) { return (this->*n.map)[0] || (this->*n.map)[1]; });
}

bool FabricMaps::any_values() const {
  return A[0] || A[1] || any_numbers();
}

PointValues values_at(const FabricMaps& maps, const Vec2& uv, const Footprint& footprint) {
  PointValues values = maps.constant;
  for (size_t family = 0; family < 2; ++family)
    if (maps.A[family]) {
      // Both families often share one texture.
      if (family == 1 && maps.A[1] == maps.A[0])
        values.A[1] = values.A[0];
      else
        maps.A[family]->look_up(uv, footprint, &values.A[family].x);
    }
  for (const NumberMap& n : number_maps)
    for (size_t family = 0; family < 2; ++family)
      if (const FabricMaps::Map& map = (maps.*n.map)[family])
        map->look_up(uv, footprint, &(values.family[family].*n.value));
  if (maps.coverage[0] || maps.coverage[1]) settle_gap(values);
  return values;
}

void settle_gap(PointValues& values) {
  const float sum = values.family[0].coverage + values.family[1].coverage;
  if (sum > 1)
    for (FamilyValues& family : values.family) family.coverage /= sum;
  values.gap = gap_of(values.family);
}

float warp_angle_at(const FabricMaps& maps, const Fabric& fabric, const Vec2& uv, const Footprint& footprint) {
  if (!maps.warp_angle) return fabric.warp_angle;
  float direction[2];
  maps.warp_angle->look_up(uv, footprint, direction);
  return std::atan2(direction[1], direction[0]);
}

float pattern_share(const PatternMaps& pattern, const Vec2& uv, const Footprint& footprint) {
  float share = pattern.share;
  if (pattern.mask) pattern.mask->look_up(uv, footprint, &share);
  return share;
}

float gap_at(const SideMaps& side, const Fabric& fabric, const Vec2& uv, const Footprint& footprint) {
  const float own = fabric_gap_at(side.own, fabric, uv, footprint);
  if (!side.pattern) return own;
  const float other = fabric_gap_at(side.pattern->maps, side.pattern->fabric, uv, footprint);
  const float share = pattern_share(*side.pattern, uv, footprint);
  return own + (other - own) * share;
}

}  // namespace sateen
