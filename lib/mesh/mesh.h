#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vector.h"
#include "mesh/placement.h"

namespace sateen {

/// The surface that is rendered: quads (a triangle repeats its last corner) with values of the limit surface at
/// every vertex. Compiled and immutable; vertices are split where UVs are. Lengths are those of `placement`.
struct Mesh {
  std::vector<std::array<std::uint32_t, 4>> quads;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< unit, from the limit tangents
  std::vector<Vec3> dpdu;     ///< length per UV unit: the warp direction; never zero, never NaN
  std::vector<Vec3> dpdv;     ///< length per UV unit
  std::vector<Vec2> uvs;
  float metres_per_uv = 0;  ///< 0: unknown
  Vec3 bounds_min{0, 0, 0}, bounds_max{0, 0, 0};
  Placement placement;              ///< the cage's
  bool refined = true;              ///< false: OpenSubdiv refuses the cage, and this is the cage itself
  std::int64_t fallback_warps = 0;  ///< vertices whose warp direction had to be made up (no or degenerate UVs)
  std::string name;
  std::vector<std::string> warnings;

  std::int64_t triangles() const;
};

}  // namespace sateen
