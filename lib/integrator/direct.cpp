#include "integrator/direct.h"

#include <array>
#include <cmath>

#include "integrator/resample.h"

namespace sateen {

namespace {

/// Takes the light of the rays by what is in their way: nothing is left, all, or what gaps let pass.
void trace_shadows(const Scene& scene, std::span<const ClothPoint> points, LightRays& light, RayCounts& counts) {
  std::array<Ray, RayTracer::stream_size> shadow;
  std::array<LightRay*, RayTracer::stream_size> of;
  std::array<float, RayTracer::stream_size> passed;
  size_t count = 0;
  const auto trace = [&] {
    trace_shadow_rays(scene, {shadow.data(), count}, counts, passed.data());
    for (size_t n = 0; n < count; ++n) {
      of[n]->light *= passed[n];
      of[n]->odds = passed[n];
    }
    count = 0;
  };
  const Ground* const ground = solid_ground(scene);
  const bool moves = scene.shutter.has_value();
  for (size_t k = 0; k < points.size(); ++k) {
    const ClothPoint& point = points[k];
    // They all leave on the side that is lit.
    const Vec3 origin = offset_origin(point.surface, moves ? turned_back(point.facing, point.object) : point.facing);
    const Vec3 from = moves ? scene.shutter->to_world(origin, point.object) : origin;
    for (LightRay& ray : light.of(k)) {
      // Above the shading horizon but below the triangle's: the cloth itself is in the way.
      if (dot(ray.world, point.facing) <= 0 || (ground && meet_ground(*ground, from, ray.world, far_away))) {
        ray.light = Color(0);
        continue;
      }
      ray.odds = 1;
      if (!scene.self_shadowing) continue;
      shadow[count].origin = origin;
      shadow[count].direction = moves ? turned_back(ray.world, point.object) : ray.world;
      of[count++] = &ray;
      if (count == shadow.size()) trace();
    }
  }
  trace();
}

/// The rays of a point that bring light, moved to the front.
std::span<LightRay> open_rays(std::span<LightRay> rays) {
  size_t count = 0;
  for (const LightRay& ray : rays)
    if (max_component(ray.light) > 0) rays[count++] = ray;
  return rays.first(count);
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
  propose_light_rays(scene, points, settings, samples, scratch.samplers, scratch.light);
  scratch.counts.lit += std::int64_t(points.size());
  trace_shadows(scene, points, scratch.light, scratch.counts);
  const bool chooses = settings.strategy == Strategy::resampled;
  Batch1 choice{};
  if (chooses) choice = draw(samples, Dimension::choice);
  for (size_t k = 0; k < points.size(); ++k) {
    light[k] = {};
    // A blocked direction costs no evaluation, and a point in full shadow not even the view's terms.
    std::span<LightRay> rays = open_rays(scratch.light.of(k));
    if (rays.empty()) continue;
    if (chooses && rays.size() > size_t(most_evaluations))
      rays = rays.first(thin_out(rays, most_evaluations, choice[k]));
    prepare_threads(*points[k].fabric, points[k].wo, scratch.view, points[k].own_values());
    for (const LightRay& ray : rays) add_lobes(scratch.view, points[k], ray.wi, ray.light, light[k]);
  }
}

}  // namespace sateen
