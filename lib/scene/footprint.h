#pragma once
#include "scene/camera.h"
#include "scene/surface.h"

namespace sateen {

/// How far the texture coordinates of a surface move from one pixel to the next along the film's two axes, to first
/// order: on the plane that touches the surface at the point.
struct Footprint {
  Vec2 x{0, 0}, y{0, 0};  ///< duv per pixel along film x and y
};

/// Of the point that a camera ray of `direction` (Camera::ray; through cloth in front, too) met, with the shading
/// normal `normal`. Grows without bound towards the horizon and is cut off there at a million times its size seen
/// straight on; 1e30 where dP/du and dP/dv span no plane.
Footprint camera_footprint(const Camera& camera, const Vec3& direction, const SurfacePoint& point,
                           const Vec3& normal);

}  // namespace sateen
