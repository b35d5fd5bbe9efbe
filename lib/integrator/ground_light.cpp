#include "integrator/ground_light.h"

#include <array>

#include "sampling/disk.h"

namespace sateen {

namespace {

/// A direction that was chosen for a point, and what white ground shows of its light where nothing is in the way.
struct Choice {
  size_t point;
  Color light;
};

struct Choices {
  size_t count = 0;
  std::array<Ray, 2 * batch_size> rays;  // as the turned object sees them
  std::array<Choice, 2 * batch_size> choices;
};

void choose(const Scene& scene, std::span<const GroundPoint> points, size_t k, const Vec3& direction,
            const MapTexel& texel, bool with_map, Choices& all) {
  const GroundPoint& point = points[k];
  const float cosine = dot(direction, point.normal);
  if (!(cosine > 0)) return;
  const float p = cosine / pi, both = p + (with_map ? texel.density->pdf_compensated : 0);
  const Color light = *texel.radiance * (p / both);
  if (!(max_component(light) > 0)) return;
  // A cyclorama may shade itself.
  if (const Ground* solid = solid_ground(scene); solid && meet_ground(*solid, point.position, direction, far_away))
    return;
  Ray& ray = all.rays[all.count];
  ray = {point.position, direction};
  if (scene.shutter) {
    ray.origin = scene.shutter->to_object(ray.origin, point.object);
    ray.direction = turned_back(direction, point.object);
  }
  all.choices[all.count++] = {k, light};
}

}  // namespace

void light_on_ground(const Scene& scene, std::span<const GroundPoint> points, const SequenceBatch& samples,
                     RayCounts& counts, GroundLight* light) {
  const Environment& map = scene.environment;
  Choices all;
  // Nothing of a constant map stands out from its mean: all of it is the cosine's.
  const bool with_map = drawable(map.by_compensated);
  if (with_map) {
    const Batch2 u = draw2(samples, Dimension::environment);
    std::array<EnvironmentPick, batch_size> picks;
    pick_environment(map, EnvironmentDensity::compensated, {u.data(), points.size()}, picks.data());
    for (size_t k = 0; k < points.size(); ++k)
      choose(scene, points, k, picks[k].direction, picks[k].texel, with_map, all);
  }
  const Batch2 u = draw2(samples, Dimension::uniform);
  for (size_t k = 0; k < points.size(); ++k) {
    const Vec3 direction = leave_ground(points[k], u[k]);
    choose(scene, points, k, direction, environment_texel(map, direction), with_map, all);
  }
  std::array<float, 2 * batch_size> passed;
  trace_shadow_rays(scene, {all.rays.data(), all.count}, counts, passed.data());
  for (size_t k = 0; k < points.size(); ++k) light[k] = {};
  for (size_t n = 0; n < all.count; ++n) {
    const Choice& choice = all.choices[n];
    light[choice.point].reached += choice.light * passed[n];
    light[choice.point].held_back += choice.light * (1 - passed[n]);
  }
  if (!scene.ground || scene.ground->kind == GroundKind::cyclorama) return;
  // What would arrive without the cloth is known of a plane: where the sky is open, what this sample is off by is
  // taken out again, and no noise is left outside the shadows. The share is a matter of the place alone, so that the
  // mean stays what it is. (A control variate; under the cloth, where little arrives, it would add noise.)
  for (size_t k = 0; k < points.size(); ++k) {
    GroundLight& l = light[k];
    l.reached += (scene.ground->open_sky - l.reached - l.held_back) * openness(*scene.ground, points[k].position);
  }
}

float shadow_share(const Scene& scene, const GroundLight& light) {
  float open = 0, held = 0;
  for (int c = 0; c < 3; ++c) {
    open += scene.ground->open_sky[c] * scene.environment.luminance[c];
    held += light.held_back[c] * scene.environment.luminance[c];
  }
  return open > 0 ? held / open : 0;
}

Vec3 leave_ground(const GroundPoint& point, const std::array<double, 2>& u) {
  return frame_from(point.normal, Vec3(1, 0, 0)).to_world(cosine_direction(u));
}

}  // namespace sateen
