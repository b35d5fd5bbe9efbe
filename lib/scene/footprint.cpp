#include "scene/footprint.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

/// (u, v) of a step in the tangent plane: least squares, for dpdu and dpdv need not span the flat triangle's plane.
Vec2 uv_step(const SurfacePoint& s, const Vec3& step) {
  const float uu = dot(s.dpdu, s.dpdu), uv = dot(s.dpdu, s.dpdv), vv = dot(s.dpdv, s.dpdv);
  const float pu = dot(s.dpdu, step), pv = dot(s.dpdv, step), area2 = uu * vv - uv * uv;
  // Parallel derivatives: each direction by itself, so that the step is at least as long as the true one.
  if (!(area2 > 1e-6f * uu * vv)) return {pu / uu, pv / vv};
  return {(pu * vv - pv * uv) / area2, (pv * uu - pu * uv) / area2};
}

}  // namespace

Footprint camera_footprint(const Camera& camera, const Ray& ray, const SurfacePoint& surface) {
  constexpr float longest = 0.25f;  // of the ray's length: beyond, a pixel sees the plane edge on
  const Vec3 to_hit = surface.position - ray.origin;
  const Vec3& n = surface.geometric_normal;
  const float height = dot(to_hit, n), reach = longest * length(to_hit);
  const auto step = [&](const Vec3& change) {
    const Vec3 neighbour = ray.direction + change;
    const float t = height / dot(neighbour, n);
    Vec3 way = neighbour * t - to_hit;
    const float far = length(way);
    if (!(t > 0) || !(far <= reach)) {
      // Along the plane in the way that the pixel's edge points, as long as it may be.
      const Vec3 along = change - n * dot(change, n);
      const float size = length(along);
      way = size > 0 ? along * (reach / size) : Vec3(0);
    }
    return uv_step(surface, way);
  };
  return {step(camera.right * (2 * camera.tan_x / float(camera.width))),
          step(camera.up * (-2 * camera.tan_y / float(camera.height)))};
}

Footprint round_footprint(const SurfacePoint& surface, float radius) {
  return {Vec2(radius / length(surface.dpdu), 0), Vec2(0, radius / length(surface.dpdv))};
}

}  // namespace sateen
