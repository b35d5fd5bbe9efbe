#include "scene/footprint.h"

#include <cmath>

namespace sateen {

Footprint camera_footprint(const Camera& camera, const Vec3& direction, const SurfacePoint& point,
                           const Vec3& normal) {
  // The neighbour's ray has the direction d + s; where the plane is met it has moved by t (s - d (n.s) / (n.d))
  // (Igehy 1999), t being the depth since d reaches the plane at distance 1.
  const Vec3d n(normal), d(direction), to_point = Vec3d(point.position) - Vec3d(camera.position);
  const double depth = std::abs(to_point.dot(Vec3d(camera.forward)));
  double facing = n.dot(d);
  const double least = 1e-6 * d.length();
  if (std::abs(facing) < least) facing = facing < 0 ? -least : least;
  const Vec3d u(point.dpdu), v(point.dpdv);
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  constexpr float unknown = 1e30f;
  if (!(det > 1e-12 * uu * vv)) return {Vec2(unknown), Vec2(unknown)};
  const auto moved = [&](const Vec3d& step) {
    const Vec3d p = (step - d * (n.dot(step) / facing)) * depth;
    const double pu = p.dot(u), pv = p.dot(v);
    return Vec2(float((pu * vv - pv * uv) / det), float((pv * uu - pu * uv) / det));
  };
  return {moved(Vec3d(camera.right) * (2 * double(camera.tan_x) / camera.width)),
          moved(Vec3d(camera.up) * (-2 * double(camera.tan_y) / camera.height))};
}

}  // namespace sateen
