#pragma once
#include "mesh/mesh.h"
#include "scene/ray_tracer.h"

namespace sateen {

/// The cloth at a hit. All of it is interpolated linearly on the triangle that was hit (see Hit).
struct SurfacePoint {
  Vec3 position;          ///< from the corners, not from the ray; off the triangle by at most `error`
  Vec3 geometric_normal;  ///< unit, of the flat triangle, on the side from which the corners run counter-clockwise
  Vec3 normal;            ///< unit, interpolated: the limit surface's
  Vec3 dpdu, dpdv;        ///< scene units per UV unit; not zero
  Vec2 uv;
  float error = 0;  ///< scene units; bounds the rounding of the position and of Embree around this triangle
};

SurfacePoint surface_point(const Mesh& mesh, const Hit& hit);

/// Where a ray that leaves the surface starts so that it cannot meet the triangle that it leaves, nor one coplanar
/// to it: moved along the geometric normal, to the side that `direction` looks to, by `error` and one more
/// step of the floating-point grid. No fixed epsilon: it holds at any scale and distance from the origin, and the
/// step stays a few units in the last place, so that layers closer than 1e-4 of the object's size still shadow one
/// another.
Vec3 offset_origin(const Vec3& position, const Vec3& geometric_normal, const Vec3& direction, float error);
inline Vec3 offset_origin(const SurfacePoint& point, const Vec3& direction) {
  return offset_origin(point.position, point.geometric_normal, direction, point.error);
}

}  // namespace sateen
