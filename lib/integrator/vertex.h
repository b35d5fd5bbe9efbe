#pragma once
#include <variant>

#include "scene/scene.h"

namespace sateen {

/// Where a path scatters: on the cloth or on the ground.
using Vertex = std::variant<ClothPoint, GroundPoint>;

/// What a ray meets first. Under a shutter the ray is the turned object's own, and `object` says how it stands.
/// `ground` may be null; a catcher is met only where there is no cloth.
std::optional<Vertex> meet(const Scene& scene, const Ray& ray, const YTurn& object, const Ground* ground);

/// The ray, as it is traced, that leaves a vertex in a direction of the world.
Ray leave(const Scene& scene, const Vertex& vertex, const Vec3& direction);

/// How the object stands while this vertex is lit.
inline const YTurn& object_turn(const Vertex& vertex) {
  return std::visit([](const auto& point) -> const YTurn& { return point.object; }, vertex);
}

}  // namespace sateen
