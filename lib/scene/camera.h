#pragma once
#include <vector>

#include "math/frame.h"
#include "mesh/detail.h"
#include "mesh/mesh.h"
#include "scene/ray_tracer.h"

namespace sateen {

/// A camera as people place it: around the object, by angles.
struct CameraSettings {
  float azimuth_deg = 0;     ///< 0 looks along -Z; positive walks to the right around the object
  float elevation_deg = 18;  ///< above the horizon, -89 to 89
  float fov_deg = 26;        ///< of the picture's longer side, 1 to 150
  float margin = 0.06f;      ///< of the picture, kept free around the object
  float zoom = 1;            ///< above 1 comes closer than the framing
};

/// Pinhole camera, compiled. Film coordinates: x from 0 (left) to width, y from 0 (top) to height, in pixels.
struct Camera {
  Vec3 position;
  Vec3 right, up, forward;     ///< unit
  float tan_x = 1, tan_y = 1;  ///< half extents of the picture at distance 1
  int width = 1, height = 1;

  Ray ray(float film_x, float film_y) const;  ///< its direction reaches the plane at distance 1; it is not unit
  float pixel_size(const Vec3& point) const;  ///< scene units at the point; not positive behind the camera
};

/// What of a mesh this camera shows: the picture and a twentieth of it on each side. `from_all_around`: the object or
/// the camera will turn, so that all of it will be seen from any side.
DetailView detail_view(const Camera& camera, bool from_all_around);

/// Places the camera so that all `points` (the object) stay within the margin, at the smallest distance.
Camera frame_points(const std::vector<Vec3>& points, const CameraSettings& settings, int width, int height);

}  // namespace sateen
