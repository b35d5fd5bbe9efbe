#include "integrator/vertex.h"

#include "scene/near_weave.h"

namespace sateen {

namespace {
constexpr float bounce_cone = 0.1f;  // radius of what a bounced ray stands for, over its length

/// The camera as the turned object sees it.
Camera turned_camera(const Camera& camera, const YTurn& object) {
  Camera turned = camera;
  for (Vec3* axis : {&turned.right, &turned.up, &turned.forward}) *axis = turned_back(*axis, object);
  return turned;
}
}  // namespace

void seen_cloth(const Scene& scene, const Hit& hit, const Ray& eye, const YTurn& object, double& choice,
                ClothPoint& point) {
  point = cloth_point(scene, hit, eye.direction);
  const bool near = may_show_yarns(scene, hit.t);
  if (scene.has_maps || near) {
    const Footprint pixel = scene.shutter ? camera_footprint(turned_camera(scene.camera, object), eye, point.surface)
                                          : camera_footprint(scene.camera, eye, point.surface);
    if (scene.has_maps) apply_maps(scene, eye.direction, pixel, choice, point);
    if (near) place_yarn(scene, pixel, point);
  }
  if (scene.shutter) turn_point(point, object);
}

ClothPoint bounced_cloth(const Scene& scene, const Hit& hit, const Ray& ray, const YTurn& object, double& choice) {
  ClothPoint point = cloth_point(scene, hit, ray.direction);
  if (scene.has_maps)
    apply_maps(scene, ray.direction, round_footprint(point.surface, bounce_cone * hit.t), choice, point);
  if (scene.shutter) turn_point(point, object);
  return point;
}

std::optional<GroundPoint> met_ground(const Scene& scene, const Ground& ground, const Ray& ray, const YTurn& object,
                                      float t_max) {
  Vec3 origin = ray.origin, direction = ray.direction;
  if (scene.shutter) {
    origin = scene.shutter->to_world(origin, object);
    direction = turned(direction, object);
  }
  std::optional<GroundPoint> point = meet_ground(ground, origin, direction, t_max);
  if (point) point->object = object;
  return point;
}

Ray leave(const Scene& scene, const Vertex& vertex, const Vec3& direction) {
  const YTurn& object = object_turn(vertex);
  Ray ray;
  ray.direction = scene.shutter ? turned_back(direction, object) : direction;
  if (const auto* cloth = std::get_if<ClothPoint>(&vertex)) {
    ray.origin = offset_origin(cloth->surface, ray.direction);
  } else {
    const Vec3& position = std::get<GroundPoint>(vertex).position;
    ray.origin = scene.shutter ? scene.shutter->to_object(position, object) : position;
  }
  return ray;
}

}  // namespace sateen
