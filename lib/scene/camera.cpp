#include "scene/camera.h"

#include <algorithm>
#include <cmath>

namespace sateen {

Ray Camera::ray(float film_x, float film_y) const {
  const float x = (2 * film_x / float(width) - 1) * tan_x, y = (1 - 2 * film_y / float(height)) * tan_y;
  Ray ray;
  ray.origin = position;
  ray.direction = forward + right * x + up * y;
  return ray;
}

float Camera::pixel_size(const Vec3& point) const {
  return dot(point - position, forward) * 2 * tan_x / float(width);
}

DetailView detail_view(const Camera& camera, bool from_all_around) {
  DetailView view;
  if (from_all_around) {
    view.pixel_size = [camera](const Vec3& p) { return camera.pixel_size(p); };
    return view;
  }
  view.eye = camera.position;
  view.pixel_size = [camera](const Vec3& p) {
    constexpr float beside = 1.1f;
    const Vec3 d = p - camera.position;
    const float depth = dot(d, camera.forward);
    const bool seen = std::abs(dot(d, camera.right)) <= beside * camera.tan_x * depth &&
                      std::abs(dot(d, camera.up)) <= beside * camera.tan_y * depth;
    return seen ? camera.pixel_size(p) : 0.0f;
  };
  return view;
}

Camera frame_points(const std::vector<Vec3>& points, const CameraSettings& settings, int width, int height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  const float half = std::tan(radians(settings.fov_deg) / 2), longer = float(std::max(width, height));
  camera.tan_x = half * float(width) / longer;
  camera.tan_y = half * float(height) / longer;
  const float azimuth = radians(settings.azimuth_deg), elevation = radians(settings.elevation_deg);
  const Vec3 back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                  std::cos(azimuth) * std::cos(elevation));
  camera.forward = -back;
  camera.right = normalize(cross(camera.forward, Vec3(0, 1, 0)));
  camera.up = cross(camera.right, camera.forward);

  // A point at (x, y, z) in the camera's axes, seen from (cx, cy) at distance d, is inside while
  // |x - cx| <= (d - z) tx: the four planes give the extremes, their middle is the centre.
  const float tx = camera.tan_x * (1 - 2 * settings.margin), ty = camera.tan_y * (1 - 2 * settings.margin);
  constexpr float low = -3e38f;
  float right = low, left = low, top = low, bottom = low, nearest = low;
  for (const Vec3& p : points) {
    const float x = dot(p, camera.right), y = dot(p, camera.up), z = dot(p, back);
    right = std::max(right, x / tx + z);
    left = std::max(left, -x / tx + z);
    top = std::max(top, y / ty + z);
    bottom = std::max(bottom, -y / ty + z);
    nearest = std::max(nearest, z);
  }
  if (points.empty()) right = left = top = bottom = 1, nearest = 0;
  const float cx = (right - left) / 2 * tx, cy = (top - bottom) / 2 * ty;
  float distance = std::max((right + left) / 2, (top + bottom) / 2);
  const float depth = distance - nearest;
  distance = nearest + std::max(depth, 1e-6f * std::abs(distance) + 1e-20f) / settings.zoom;
  camera.position = camera.right * cx + camera.up * cy + back * distance;
  return camera;
}

}  // namespace sateen
