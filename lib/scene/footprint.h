#pragma once
#include "scene/camera.h"
#include "scene/surface.h"

namespace sateen {

/// How far one step leads on the cloth: the differences of (u, v) along two edges of an area.
struct Footprint {
  Vec2 dx{0, 0}, dy{0, 0};
};

/// Of one pixel to the right and one down, where a camera ray from `origin` along `direction` (not normalised, as the
/// camera gives it) meets the surface: the neighbouring pixels' rays are met with the plane of the triangle. At the
/// silhouette, where they miss it or meet it far away, the step ends at a few times the ray's own length.
Footprint camera_footprint(const Camera& camera, const Ray& ray, const SurfacePoint& surface);

/// Of a cone of `radius` scene units around a hit, whatever its slant.
Footprint round_footprint(const SurfacePoint& surface, float radius);

}  // namespace sateen
