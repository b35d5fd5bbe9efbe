#include "integrator/direct.h"

#include <array>
#include <cmath>

#include "integrator/light_rays.h"

namespace sateen {

namespace {

/// Share of light that passes from a point along a world direction to the environment: 0 or 1, or what gaps let pass.
float transmittance(const Scene& scene, const ClothPoint& point, const Vec3& direction, RayCounts& counts) {
  // Above the shading horizon but below the triangle's: the cloth itself is in the way.
  if (dot(direction, point.facing) <= 0) return 0;
  ++counts.shadow;
  Ray ray;
  ray.origin = offset_origin(point.surface, direction);
  ray.direction = direction;
  if (counts.log) counts.log->push_back(ray);
  if (!scene.has_gaps) return scene.rays->occluded(ray) ? 0.0f : 1.0f;

  float passed = 1;
  while (const std::optional<Hit> hit = scene.rays->closest_hit(ray)) {
    const SurfacePoint surface = surface_point(*scene.mesh, *hit);
    const bool back = dot(surface.geometric_normal, direction) > 0;
    passed *= back && scene.back ? scene.back->gap : scene.front.gap;
    if (passed < 1e-6f) return 0;
    ray.origin = offset_origin(surface, direction);
    ++counts.shadow;
  }
  return passed;
}

/// F times `light` at a direction, split into lobes.
void add_lobes(const FabricView& view, const Vec3& wi, const Color& light, LobeLight& sum) {
  const ThreadSums<float> parts = evaluate_parts(view, wi);
  for (int family = 0; family < 2; ++family) {
    sum.surface[family] += light * parts.surface[family];
    sum.volume[family] += light * view.fabric->A[family] * parts.volume[family];
  }
}

}  // namespace

void direct_light(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                  const SequenceBatch& samples, PathScratch& scratch, LobeLight* light) {
  std::array<LightRays, batch_size> rays;
  choose_light_rays(scene, points, settings, samples, scratch.samplers, rays);
  for (size_t k = 0; k < points.size(); ++k) {
    light[k] = {};
    bool prepared = false;
    // Shadow ray first: a blocked direction costs no evaluation, and a point in full shadow not even the view's
    // terms.
    for (const LightRay& ray : rays[k].chosen()) {
      const float seen = transmittance(scene, points[k], ray.world, scratch.counts);
      if (seen == 0) continue;
      if (!prepared) prepare_threads(*points[k].fabric, points[k].wo, scratch.view);
      prepared = true;
      add_lobes(scratch.view, ray.wi, ray.light * seen, light[k]);
    }
  }
}

}  // namespace sateen
