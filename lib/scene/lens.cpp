#include "scene/lens.h"

#include <fmt/format.h>

#include "base/error.h"
#include "sampling/disk.h"

namespace sateen {

float focus_distance(const Mesh& mesh, const RayTracer& rays, const Camera& camera) {
  const Ray middle = camera.ray(float(camera.width) / 2, float(camera.height) / 2);
  if (const std::optional<Hit> hit = rays.closest_hit(middle)) return hit->t;
  return dot((mesh.bounds_min + mesh.bounds_max) * 0.5f - camera.position, camera.forward);
}

Lens compile_lens(const LensSettings& settings, const Mesh& mesh, const RayTracer& rays, const Camera& camera) {
  constexpr float half_sensor = 0.018f;  // metres
  const float focal_length = half_sensor / std::max(camera.tan_x, camera.tan_y);
  Lens lens;
  const float metres_per_unit = float(double(settings.metres_per_unit) * mesh.placement.unit);
  lens.radius = focal_length / settings.f_stop / 2 / metres_per_unit;
  lens.blades = settings.blades;
  lens.focus = settings.focus ? *settings.focus / metres_per_unit : focus_distance(mesh, rays, camera);
  if (!(lens.focus > 0) || !std::isfinite(lens.focus))
    throw InputError(fmt::format("the focus is at {} units along the view, expected in front of the camera",
                                 double(lens.focus) * mesh.placement.unit),
                     "give --focus a distance in metres");
  return lens;
}

void through_lens(const Camera& camera, const Lens& lens, const Batch2& u, std::span<Ray> rays) {
  for (size_t k = 0; k < rays.size(); ++k) {
    const Vec2 place = (lens.blades > 0 ? regular_polygon(lens.blades, u[k]) : concentric_disk(u[k])) * lens.radius;
    const Vec3 aside = camera.right * place.x + camera.up * place.y;
    rays[k].origin += aside;
    rays[k].direction -= aside / lens.focus;
  }
}

}  // namespace sateen
