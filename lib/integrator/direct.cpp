#include "integrator/direct.h"

#include <array>
#include <cmath>

#include "integrator/light_rays.h"

namespace sateen {

namespace {

/// Share of light that comes from the environment to every point along its chosen rays: 0 or 1, or what gaps let
/// pass.
using Seen = std::array<std::array<float, LightRays::most>, batch_size>;
void trace_shadows(const Scene& scene, std::span<const ClothPoint> points, std::span<const LightRays> rays,
                   RayCounts& counts, Seen& seen) {
  static_assert(RayTracer::stream_size == LightRays::most * batch_size);
  std::array<Ray, LightRays::most * batch_size> shadow;
  std::array<float*, LightRays::most * batch_size> result;
  size_t n = 0;
  const Ground* const ground = solid_ground(scene);
  const bool moves = scene.shutter.has_value();
  for (size_t k = 0; k < points.size(); ++k)
    for (size_t j = 0; j < rays[k].chosen().size(); ++j) {
      const Vec3& direction = rays[k].rays[j].world;
      seen[k][j] = 0;
      // Above the shading horizon but below the triangle's: the cloth itself is in the way.
      if (dot(direction, points[k].facing) <= 0) continue;
      const Vec3 traced = moves ? turned_back(direction, points[k].object) : direction;
      shadow[n].origin = offset_origin(points[k].surface, traced);
      shadow[n].direction = traced;
      if (ground) {
        const Vec3 from = moves ? scene.shutter->to_world(shadow[n].origin, points[k].object) : shadow[n].origin;
        if (meet_ground(*ground, from, direction, far_away)) continue;
      }
      result[n++] = &seen[k][j];
    }
  if (!scene.self_shadowing) {
    for (size_t k = 0; k < n; ++k) *result[k] = 1;
    return;
  }
  std::array<float, LightRays::most * batch_size> passed;
  trace_shadow_rays(scene, {shadow.data(), n}, counts, passed.data());
  for (size_t k = 0; k < n; ++k) *result[k] = passed[k];
}

/// F times `light` at a direction, split into lobes.
void add_lobes(const FabricView& view, const ClothPoint& point, const Vec3& wi, const Color& light, LobeLight& sum) {
  const ThreadSums<float> parts = evaluate_parts(view, point.yarn, wi);
  for (int family = 0; family < 2; ++family) {
    sum.surface[family] += light * parts.surface[family];
    sum.volume[family] += light * view.A[size_t(family)] * parts.volume[family];
  }
}

}  // namespace

void trace_shadow_rays(const Scene& scene, std::span<const Ray> rays, RayCounts& counts, float* passed) {
  counts.shadow += std::int64_t(rays.size());
  if (counts.log) counts.log->shadow.insert(counts.log->shadow.end(), rays.begin(), rays.end());
  if (scene.has_gaps) return pass_gaps(scene, rays, passed);
  std::array<bool, RayTracer::stream_size> blocked;
  scene.rays->occluded_each(rays, blocked.data());
  for (size_t k = 0; k < rays.size(); ++k) passed[k] = blocked[k] ? 0.0f : 1.0f;
}

void direct_light(const Scene& scene, std::span<const ClothPoint> points, const LightSettings& settings,
                  const SequenceBatch& samples, PathScratch& scratch, LobeLight* light) {
  std::array<LightRays, batch_size> rays;
  choose_light_rays(scene, points, settings, samples, scratch.samplers, rays);
  Seen seen;
  scratch.counts.lit += std::int64_t(points.size());
  trace_shadows(scene, points, rays, scratch.counts, seen);
  for (size_t k = 0; k < points.size(); ++k) {
    light[k] = {};
    bool prepared = false;
    // A blocked direction costs no evaluation, and a point in full shadow not even the view's terms.
    for (size_t j = 0; j < rays[k].chosen().size(); ++j) {
      if (seen[k][j] == 0) continue;
      if (!prepared) prepare_threads(*points[k].fabric, points[k].wo, scratch.view, points[k].own_values());
      prepared = true;
      add_lobes(scratch.view, points[k], rays[k].rays[j].wi, rays[k].rays[j].light * seen[k][j], light[k]);
    }
  }
}

}  // namespace sateen
