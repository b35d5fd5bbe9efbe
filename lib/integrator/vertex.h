#pragma once
#include <variant>

#include "scene/scene.h"

namespace sateen {

/// Where a path scatters: on the cloth or on the ground.
using Vertex = std::variant<ClothPoint, GroundPoint>;

/// The cloth as a camera ray met it, pixel by pixel: `eye` is the ray as it left the camera, as it is traced.
/// `object` says how the object stands under a shutter; `choice` is the random number of patterns (apply_maps).
void seen_cloth(const Scene& scene, const Hit& hit, const Ray& eye, const YTurn& object, double& choice,
                ClothPoint& point);

/// The cloth as a ray met it that has scattered before: textures are looked up widely.
ClothPoint bounced_cloth(const Scene& scene, const Hit& hit, const Ray& ray, const YTurn& object, double& choice);

/// The ground that a ray meets before `t_max`; the ray as it is traced.
std::optional<GroundPoint> met_ground(const Scene& scene, const Ground& ground, const Ray& ray, const YTurn& object,
                                      float t_max);

/// What a ray meets first; `cloth` makes a ClothPoint of a hit. `ground` may be null; a catcher is met only where
/// there is no cloth.
template <class ToCloth>
std::optional<Vertex> meet(const Scene& scene, const Ray& ray, const YTurn& object, const Ground* ground,
                           const ToCloth& cloth) {
  const std::optional<Hit> hit = scene.rays->closest_hit(ray);
  if (ground) {
    const float t_max = !hit ? far_away : ground->blocks_light() ? hit->t : 0;
    if (std::optional<GroundPoint> point = met_ground(scene, *ground, ray, object, t_max)) return *point;
  }
  if (!hit) return std::nullopt;
  return cloth(*hit);
}

/// The ray, as it is traced, that leaves a vertex in a direction of the world.
Ray leave(const Scene& scene, const Vertex& vertex, const Vec3& direction);

/// How the object stands while this vertex is lit.
inline const YTurn& object_turn(const Vertex& vertex) {
  return std::visit([](const auto& point) -> const YTurn& { return point.object; }, vertex);
}

}  // namespace sateen
