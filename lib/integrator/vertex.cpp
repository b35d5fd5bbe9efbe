#include "integrator/vertex.h"

#include "integrator/direct.h"

namespace sateen {

std::optional<Vertex> meet(const Scene& scene, const Ray& ray, const YTurn& object, const Ground* ground) {
  const std::optional<Hit> hit = scene.rays->closest_hit(ray);
  if (ground) {
    Vec3 origin = ray.origin, direction = ray.direction;
    if (scene.shutter) {
      origin = scene.shutter->to_world(origin, object);
      direction = turned(direction, object);
    }
    const float t_max = !hit ? far_away : ground->blocks_light() ? hit->t : 0;
    if (std::optional<GroundPoint> point = meet_ground(*ground, origin, direction, t_max)) {
      point->object = object;
      return *point;
    }
  }
  if (!hit) return std::nullopt;
  ClothPoint point = cloth_point(scene, *hit, ray.direction);
  if (scene.shutter) turn_point(point, object);
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
