#pragma once
#include <vector>

#include "math/vector.h"

namespace sateen {

/// One corner of a polygon: its vertex, and its texture coordinate or -1.
struct PolygonCorner {
  int vertex = 0, uv = -1;
};

/// Cuts a polygon that meets vertices twice, as a polygon with holes is written (a bridge leads to each hole and
/// back), into faces of the same area that meet no vertex twice: by diagonals, in the plane that fits it best; pieces
/// that are convex together stay together. Spikes that lead nowhere are dropped. Empty where the polygon crosses
/// itself or has no area, or above 1,000 corners.
std::vector<std::vector<PolygonCorner>> cut_polygon(std::vector<PolygonCorner> polygon,
                                                    const std::vector<Vec3>& positions);

}  // namespace sateen
