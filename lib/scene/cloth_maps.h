#pragma once
#include <memory>
#include <optional>

#include "fabric/fabric.h"
#include "scene/uv_texture.h"

namespace sateen {

/// The textures of one fabric, by warp and weft; null where the value is the same everywhere.
struct FabricMaps {
  using Map = std::shared_ptr<const UvTexture>;
  std::array<Map, 2> A;                                     ///< solved already where the look gives a colour
  std::array<Map, 2> coverage, k_d, eta, gamma_s, gamma_v;  ///< radians
  Map warp_angle;        ///< cosine and sine, so that 179 and -179 degrees filter to 180
  PointValues constant;  ///< what no texture says

  bool any() const { return warp_angle || any_values(); }
  bool any_values() const;   ///< some of PointValues
  bool any_numbers() const;  ///< some of FamilyValues
};

/// A number that may have a texture, and its place among the values of a point.
struct NumberMap {
  std::array<FabricMaps::Map, 2> FabricMaps::*map;
  float FamilyValues::*value;
};
inline constexpr NumberMap number_maps[] = {{&FabricMaps::coverage, &FamilyValues::coverage},
                                            {&FabricMaps::k_d, &FamilyValues::k_d},
                                            {&FabricMaps::eta, &FamilyValues::eta},
                                            {&FabricMaps::gamma_s, &FamilyValues::gamma_s},
                                            {&FabricMaps::gamma_v, &FamilyValues::gamma_v}};

/// The look that a pattern weaves in.
struct PatternMaps {
  Fabric fabric;
  FabricMaps maps;
  FabricMaps::Map mask;  ///< null: `share` everywhere
  float share = 0;       ///< 0 to 1, of the pattern's look
};

/// The textures of one side of the cloth, and its pattern.
struct SideMaps {
  FabricMaps own;
  std::optional<PatternMaps> pattern;
};

/// Brings the coverage of both families within 1; what is left are gaps.
void settle_gap(PointValues& values);

PointValues values_at(const FabricMaps& maps, const Vec2& uv, const Footprint& footprint);

/// Angle by which the warp is turned there [radians].
float warp_angle_at(const FabricMaps& maps, const Fabric& fabric, const Vec2& uv, const Footprint& footprint);

/// Share of the pattern's look there, 0 to 1.
float pattern_share(const PatternMaps& pattern, const Vec2& uv, const Footprint& footprint);

/// Share of the area without threads there: of the look and of its pattern's by their shares.
float gap_at(const SideMaps& side, const Fabric& fabric, const Vec2& uv, const Footprint& footprint);

}  // namespace sateen
