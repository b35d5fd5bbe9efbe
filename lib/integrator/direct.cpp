#include "integrator/direct.h"

#include <array>
#include <cmath>

#include "integrator/light_rays.h"

namespace sateen {

namespace {

/// Share of light that gaps let pass along a shadow ray.
float transmittance(const Scene& scene, Ray ray, RayCounts& counts) {
  float passed = 1;
  while (const std::optional<Hit> hit = scene.rays->closest_hit(ray)) {
    const SurfacePoint surface = surface_point(*scene.mesh, *hit);
    const bool back = dot(surface.geometric_normal, ray.direction) > 0;
    passed *= back && scene.back ? scene.back->gap : scene.front.gap;
    if (passed < 1e-6f) return 0;
    ray.origin = offset_origin(surface, ray.direction);
    ++counts.shadow;
  }
  return passed;
}

/// Share of light that comes from the environment to every point along its chosen rays: 0 or 1, or what gaps let
/// pass.
using Seen = std::array<std::array<float, 2>, batch_size>;
void trace_shadows(const Scene& scene, std::span<const ClothPoint> points, std::span<const LightRays> rays,
                   RayCounts& counts, Seen& seen) {
  static_assert(RayTracer::stream_size == 2 * batch_size);
  std::array<Ray, 2 * batch_size> shadow;
  std::array<float*, 2 * batch_size> result;
  size_t n = 0;
  for (size_t k = 0; k < points.size(); ++k)
    for (size_t j = 0; j < rays[k].chosen().size(); ++j) {
      const Vec3& direction = rays[k].rays[j].world;
      seen[k][j] = 0;
      // Above the shading horizon but below the triangle's: the cloth itself is in the way.
      if (dot(direction, points[k].facing) <= 0) continue;
      shadow[n].origin = offset_origin(points[k].surface, direction);
      shadow[n].direction = direction;
      result[n++] = &seen[k][j];
    }
  if (!scene.self_shadowing) {
    for (size_t k = 0; k < n; ++k) *result[k] = 1;
    return;
  }
  counts.shadow += std::int64_t(n);
  if (counts.log) counts.log->insert(counts.log->end(), shadow.begin(), shadow.begin() + std::ptrdiff_t(n));
  if (scene.has_gaps) {
    for (size_t k = 0; k < n; ++k) *result[k] = transmittance(scene, shadow[k], counts);
    return;
  }
  std::array<bool, 2 * batch_size> blocked;
  scene.rays->occluded_each({shadow.data(), n}, blocked.data());
  for (size_t k = 0; k < n; ++k) *result[k] = blocked[k] ? 0.0f : 1.0f;
}

/// F times `light` at a direction, split into lobes.
void add_lobes(const FabricView& view, const ClothPoint& point, const Vec3& wi, const Color& light, LobeLight& sum) {
  const ThreadSums<float> parts = evaluate_parts(view, point.yarn, wi);
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
  Seen seen;
  trace_shadows(scene, points, rays, scratch.counts, seen);
  for (size_t k = 0; k < points.size(); ++k) {
    light[k] = {};
    bool prepared = false;
    // A blocked direction costs no evaluation, and a point in full shadow not even the view's terms.
    for (size_t j = 0; j < rays[k].chosen().size(); ++j) {
      if (seen[k][j] == 0) continue;
      if (!prepared) prepare_threads(*points[k].fabric, points[k].wo, scratch.view);
      prepared = true;
      add_lobes(scratch.view, points[k], rays[k].rays[j].wi, rays[k].rays[j].light * seen[k][j], light[k]);
    }
  }
}

}  // namespace sateen
