#include "integrator/path.h"

#include <cmath>

#include "film/filter.h"

namespace sateen {

namespace {

constexpr int most_layers = 64;          // of sheer cloth along one ray
constexpr int roulette_after = 3;        // bounces that are always followed

bool finite(const Color& c) { return std::isfinite(c.x + c.y + c.z); }

// A value that is not finite is a fault somewhere below: it is dropped, counted and reported, never masked in silence.
bool keep(const LobeLight& light, RayCounts& counts) {
  if (finite(light.total())) return true;
  ++counts.non_finite;
  return false;
}

/// Light after two and more meetings: from `point`, whose view is in scratch, on. Overwrites the view.
Color indirect_light(const Scene& scene, const LightSettings& settings, ClothPoint point, std::uint32_t seed, int x,
                     int y, int replicate, std::uint32_t index, PathScratch& scratch) {
  const FabricSampler sampler = strategy_sampler(settings.strategy);
  Color light(0), throughput(1);
  for (int bounce = 1; bounce <= settings.bounces; ++bounce) {
    // The numbers of the vertex that is left may also have served its direct light, which is added to this. Those of
    // the vertex that is met must be others: its light is multiplied by what was drawn on the way to it.
    const Sequence left = pixel_sequence(seed, x, y, replicate, bounce - 1);
    const Sequence met = pixel_sequence(seed, x, y, replicate, bounce);
    FabricRandom u;
    u.choice = draw(left, Dimension::table_view, index);
    u.thread = draw2(left, Dimension::talk_thread, index);
    const Dimension used = sampler == FabricSampler::table  ? Dimension::table
                           : sampler == FabricSampler::talk ? Dimension::talk
                                                            : Dimension::uniform;
    u.direction = draw2(left, used, index);
    const std::optional<Vec3> wi = sample(scratch.view, sampler, u);
    if (!wi) break;
    const BsdfValue value = evaluate(scratch.view, sampler, *wi);
    if (!(value.pdf > 0)) break;
    throughput *= value.f_cos / value.pdf;
    if (bounce > roulette_after) {
      const float stay = std::min(max_component(throughput), 0.95f);
      if (!(float(draw(met, Dimension::roulette, index)) < stay)) break;
      throughput /= stay;
    }
    if (!(max_component(throughput) > 0)) break;

    const Vec3 direction = point.frame.to_world(*wi);
    if (dot(direction, point.facing) <= 0) break;
    Ray ray;
    ray.origin = offset_origin(point.surface, direction);
    ray.direction = direction;
    ++scratch.counts.bounce;
    std::optional<Hit> hit = scene.rays->closest_hit(ray);
    if (!hit) break;  // the environment was counted at the vertex before
    point = cloth_point(scene, *hit, direction);
    // Each layer of sheer cloth is passed with its gaps' probability.
    double pass = point.fabric->gap > 0 ? draw(met, Dimension::gap, index) : 1;
    for (int layer = 0; hit && pass < double(point.fabric->gap) && layer < most_layers; ++layer) {
      pass /= double(point.fabric->gap);
      ray.origin = offset_origin(point.surface, direction);
      ++scratch.counts.bounce;
      hit = scene.rays->closest_hit(ray);
      if (hit) point = cloth_point(scene, *hit, direction);
    }
    if (!hit) break;
    // What scatters here was chosen with the probability of not passing; F holds the gaps' share already.
    throughput /= 1 - point.fabric->gap;

    prepare_view(*point.fabric, point.wo, sampler, scratch.view);
    const LobeLight direct = direct_light(scene, point, scratch.view, settings, met, index, scratch.counts);
    if (keep(direct, scratch.counts)) light += throughput * direct.total();
  }
  return light;
}

}  // namespace

CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed, int x, int y,
                          int replicate, std::uint32_t index, PathScratch& scratch) {
  CameraSample out;
  const Sequence sequence = pixel_sequence(seed, x, y, replicate);
  const Vec2 place = sample_filter(draw2(sequence, Dimension::film, index));
  Ray ray = scene.camera.ray(float(x) + 0.5f + place.x, float(y) + 0.5f + place.y);
  float passed = 1;
  for (int layer = 0; layer < most_layers; ++layer) {
    ++scratch.counts.camera;
    const std::optional<Hit> hit = scene.rays->closest_hit(ray);
    if (!hit) {
      if (scene.backdrop == Backdrop::environment)
        out.backdrop = environment_backdrop(scene.environment, ray.direction) * passed;
      else if (scene.backdrop == Backdrop::plain)
        out.backdrop = scene.backdrop_color * passed;
      out.alpha = scene.backdrop == Backdrop::none ? 1 - passed : 1;
      return out;
    }
    const ClothPoint point = cloth_point(scene, *hit, ray.direction);
    prepare_view(*point.fabric, point.wo, strategy_sampler(settings.strategy), scratch.view);
    // A sheer layer behind another gets numbers of its own.
    const Sequence here = layer == 0 ? sequence : pixel_sequence(seed, x, y, replicate, -layer);
    const LobeLight direct = direct_light(scene, point, scratch.view, settings, here, index, scratch.counts);
    if (keep(direct, scratch.counts))
      for (int family = 0; family < 2; ++family) {
        out.direct.surface[family] += direct.surface[family] * passed;
        out.direct.volume[family] += direct.volume[family] * passed;
      }
    if (!out.hit) {
      out.hit = true;
      out.position = point.surface.position;
      out.normal = point.frame.z;
      out.warp = point.frame.x;
      out.uv = point.surface.uv;
      out.wo = point.wo;
      out.back = scene.back && point.fabric == &*scene.back;
    }
    if (settings.bounces > 0) {
      const Color indirect =
          indirect_light(scene, settings, point, seed, x, y, replicate, index, scratch) * passed;
      if (finite(indirect))
        out.indirect += indirect;
      else
        ++scratch.counts.non_finite;
    }
    passed *= point.fabric->gap;
    if (!(passed > 0)) break;
    ray.origin = offset_origin(point.surface, ray.direction);
  }
  out.alpha = 1;
  return out;
}

}  // namespace sateen
