#include "scene/scene.h"

namespace sateen {

namespace {
// Where the interpolated normal turns away from the viewer although the triangle does not (silhouettes), it is bent
// back until wo grazes it at this cosine: a third of a degree, less than a texel of the direction table.
constexpr float smallest_cosine = 5e-3f;

// The warp lies in the surface along dP/du, turned by the look's angle towards dP/dv.
Frame cloth_frame(const SurfacePoint& surface, const Vec3& normal, float angle) {
  const Frame straight = frame_from(normal, surface.dpdu);
  const Vec3 y = dot(straight.y, surface.dpdv) < 0 ? -straight.y : straight.y;
  if (angle == 0) return {straight.x, y, normal};
  const float c = std::cos(angle), s = std::sin(angle);
  return {straight.x * c + y * s, y * c - straight.x * s, normal};
}

const SideMaps* side_maps(const Scene& scene, bool back) {
  return back && scene.back ? scene.back_maps.get() : scene.front_maps.get();
}
}  // namespace

std::vector<const Fabric*> fabrics_of(const Scene& scene) {
  std::vector<const Fabric*> all{&scene.front};
  if (scene.back) all.push_back(&*scene.back);
  for (const auto& side : {scene.front_maps, scene.back_maps})
    if (side && side->pattern) all.push_back(&side->pattern->fabric);
  return all;
}

ClothPoint cloth_point(const Scene& scene, const Hit& hit, const Vec3& direction) {
  ClothPoint point;
  point.surface = surface_point(*scene.mesh, hit);
  const Vec3 to_viewer = -normalize(direction);
  const bool back = dot(point.surface.geometric_normal, to_viewer) < 0;
  const float side = back ? -1.0f : 1.0f;
  point.facing = point.surface.geometric_normal * side;
  point.on_back = back;
  point.fabric = back && scene.back ? &*scene.back : &scene.front;

  Vec3 normal = point.surface.normal * side;
  if (const float cosine = dot(normal, to_viewer); cosine < smallest_cosine)
    normal = normalize(normal + to_viewer * (smallest_cosine - cosine));

  point.frame = cloth_frame(point.surface, normal, point.fabric->warp_angle);
  point.wo = point.frame.to_local(to_viewer);
  point.wo.z = std::max(point.wo.z, smallest_cosine / 2);
  point.gap = point.fabric->gap;
  point.mapped = false;
  return point;
}

void apply_maps(const Scene& scene, const Vec3& direction, const Footprint& footprint, double& choice,
                ClothPoint& point) {
  const SideMaps* side = side_maps(scene, point.on_back);
  if (!side) return;
  const Vec2& uv = point.surface.uv;
  const FabricMaps* maps = &side->own;
  const float angle_before = point.fabric->warp_angle;
  if (side->pattern) {
    const double share = double(pattern_share(*side->pattern, uv, footprint));
    if (choice < share) {
      choice /= share;
      point.fabric = &side->pattern->fabric;
      maps = &side->pattern->maps;
    } else {
      choice = (choice - share) / (1 - share);
    }
  }
  if (const float angle = warp_angle_at(*maps, *point.fabric, uv, footprint); angle != angle_before) {
    point.frame = cloth_frame(point.surface, point.frame.z, angle);
    point.wo = point.frame.to_local(-normalize(direction));
    point.wo.z = std::max(point.wo.z, smallest_cosine / 2);
  }
  point.mapped = maps->any_values();
  if (point.mapped) point.values = values_at(*maps, uv, footprint);
  // Gaps that are switched off still darken: they are part of the threads' own light.
  point.gap = !scene.has_gaps ? 0 : point.mapped ? point.values.gap : point.fabric->gap;
}

float gap_along(const Scene& scene, const SurfacePoint& surface, const Vec3& direction) {
  const bool back = dot(surface.geometric_normal, direction) > 0;
  const Fabric& fabric = back && scene.back ? *scene.back : scene.front;
  const SideMaps* side = side_maps(scene, back);
  return side ? gap_at(*side, fabric, surface.uv, {}) : fabric.gap;
}

void pass_gaps(const Scene& scene, std::span<const Ray> rays, float* passed) {
  // Where all gaps are alike it does not matter what is met.
  if (!scene.has_maps && !scene.back)
    return scene.rays->passed_each(
        rays, [gap = scene.front.gap](const Hit&, const Ray&) { return gap; }, passed);
  scene.rays->passed_each(
      rays,
      [&](const Hit& hit, const Ray& ray) {
        return gap_along(scene, surface_point(*scene.mesh, hit), ray.direction);
      },
      passed);
}

void turn_point(ClothPoint& point, const YTurn& object) {
  point.object = object;
  point.facing = turned(point.facing, object);
  for (Vec3* axis : {&point.frame.x, &point.frame.y, &point.frame.z}) *axis = turned(*axis, object);
}

}  // namespace sateen
