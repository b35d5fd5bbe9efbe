#include "scene/scene.h"

namespace sateen {

namespace {
// Where the interpolated normal turns away from the viewer although the triangle does not (silhouettes), it is bent
// back until wo grazes it at this cosine: a third of a degree, less than a texel of the direction table.
constexpr float smallest_cosine = 5e-3f;
}  // namespace

ClothPoint cloth_point(const Scene& scene, const Hit& hit, const Vec3& direction) {
  ClothPoint point;
  point.surface = surface_point(*scene.mesh, hit);
  const Vec3 to_viewer = -normalize(direction);
  const bool back = dot(point.surface.geometric_normal, to_viewer) < 0;
  const float side = back ? -1.0f : 1.0f;
  point.facing = point.surface.geometric_normal * side;
  point.fabric = back && scene.back ? &*scene.back : &scene.front;

  Vec3 normal = point.surface.normal * side;
  if (const float cosine = dot(normal, to_viewer); cosine < smallest_cosine)
    normal = normalize(normal + to_viewer * (smallest_cosine - cosine));

  // The warp lies in the surface along dP/du, turned by the look's angle towards dP/dv.
  const Frame straight = frame_from(normal, point.surface.dpdu);
  const Vec3 y = dot(straight.y, point.surface.dpdv) < 0 ? -straight.y : straight.y;
  const float angle = point.fabric->warp_angle;
  if (angle == 0) {
    point.frame = {straight.x, y, normal};
  } else {
    const float c = std::cos(angle), s = std::sin(angle);
    point.frame = {straight.x * c + y * s, y * c - straight.x * s, normal};
  }
  point.wo = point.frame.to_local(to_viewer);
  point.wo.z = std::max(point.wo.z, smallest_cosine / 2);
  return point;
}

void turn_point(ClothPoint& point, const YTurn& object) {
  point.object = object;
  point.facing = turned(point.facing, object);
  for (Vec3* axis : {&point.frame.x, &point.frame.y, &point.frame.z}) *axis = turned(*axis, object);
}

}  // namespace sateen
