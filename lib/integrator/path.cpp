#include "integrator/path.h"

#include <cmath>

#include "film/filter.h"
#include "scene/near_weave.h"

namespace sateen {

namespace {

constexpr int most_layers = 64;    // of sheer cloth along one ray
constexpr int roulette_after = 3;  // bounces that are always followed

bool finite(const Color& c) {
  return std::isfinite(c.x + c.y + c.z);
}

// A value that is not finite is a fault somewhere below: it is dropped, counted and reported, never masked in
// silence.
bool keep(const LobeLight& light, RayCounts& counts) {
  if (finite(light.total())) return true;
  ++counts.non_finite;
  return false;
}

/// A batch of one: sample `id` at its `bounce`-th vertex, or its layer -bounce.
SequenceBatch alone(std::uint32_t seed, const SampleId& id, int bounce) {
  SequenceBatch batch;
  batch.count = 1;
  batch.seed[0] = pixel_sequence(seed, id.x, id.y, id.replicate, bounce).seed;
  batch.index[0] = id.index;
  return batch;
}

LobeLight direct_light(const Scene& scene, const ClothPoint& point, const LightSettings& settings,
                       const SequenceBatch& sample, PathScratch& scratch) {
  LobeLight light;
  direct_light(scene, {&point, 1}, settings, sample, scratch, &light);
  return light;
}

/// Light after two and more meetings, from `point` on, by bounce.
BounceLight indirect_light(const Scene& scene, const LightSettings& settings, ClothPoint point, std::uint32_t seed,
                           const SampleId& id, PathScratch& scratch) {
  const FabricSampler sampler = strategy_sampler(settings.strategy);
  BounceLight light;
  Color throughput(1);
  for (int bounce = 1; bounce <= settings.bounces; ++bounce) {
    // The numbers of the vertex that is left may also have served its direct light, which is added to this. Those of
    // the vertex that is met must be others: its light is multiplied by what was drawn on the way to it.
    const Sequence left = alone(seed, id, bounce - 1).sequence(0);
    const SequenceBatch met_batch = alone(seed, id, bounce);
    const Sequence met = met_batch.sequence(0);
    FabricRandom u;
    u.choice = draw(left, Dimension::table_view, id.index);
    u.thread = draw2(left, Dimension::talk_thread, id.index);
    const Dimension used = sampler == FabricSampler::table  ? Dimension::table
                           : sampler == FabricSampler::talk ? Dimension::talk
                                                            : Dimension::uniform;
    u.direction = draw2(left, used, id.index);
    prepare_view(*point.fabric, point.wo, sampler, scratch.vertex);
    const std::optional<Vec3> wi = sample(scratch.vertex.sampler, u);
    if (!wi) break;
    const BsdfValue value = evaluate_with_pdf(scratch.vertex, point.yarn, *wi);
    if (!(value.pdf > 0)) break;
    throughput *= value.f_cos / value.pdf;
    if (bounce > roulette_after) {
      const float stay = std::min(max_component(throughput), 0.95f);
      if (!(float(draw(met, Dimension::roulette, id.index)) < stay)) break;
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
    double pass = point.fabric->gap > 0 ? draw(met, Dimension::gap, id.index) : 1;
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

    const LobeLight direct = direct_light(scene, point, settings, met_batch, scratch);
    const Color sent = throughput * direct.total();
    if (finite(sent))
      light.bounce[std::min(bounce, tracked_bounces) - 1] += sent;
    else
      ++scratch.counts.non_finite;
  }
  return light;
}

/// The backdrop, of which `passed` reaches the eye.
void see_backdrop(const Scene& scene, const Vec3& direction, float passed, CameraSample& out) {
  if (scene.backdrop == Backdrop::environment)
    out.backdrop = environment_backdrop(scene.environment, direction) * passed;
  else if (scene.backdrop == Backdrop::plain)
    out.backdrop = scene.backdrop_color * passed;
  out.alpha = scene.backdrop == Backdrop::none ? 1 - passed : 1;
}

/// What is seen through the gaps of the first layer of sheer cloth; `follow` is the weight of its indirect light.
void look_through(const Scene& scene, const LightSettings& settings, ClothPoint point, Ray ray, std::uint32_t seed,
                  const SampleId& id, float follow, PathScratch& scratch, CameraSample& out) {
  float passed = passing(point.fabric->gap, point.yarn);
  for (int layer = 1; passed > 0 && layer < most_layers; ++layer) {
    ray.origin = offset_origin(point.surface, ray.direction);
    ++scratch.counts.camera;
    const std::optional<Hit> hit = scene.rays->closest_hit(ray);
    if (!hit) return see_backdrop(scene, ray.direction, passed, out);
    point = cloth_point(scene, *hit, ray.direction);
    if (scene.near_weave_pixel > 0) place_yarn(scene, ray.direction, point);
    // Another layer gets numbers of its own.
    const LobeLight direct = direct_light(scene, point, settings, alone(seed, id, -layer), scratch);
    if (keep(direct, scratch.counts)) out.through_gaps += direct.total() * passed;
    if (follow > 0)
      out.through_gaps += indirect_light(scene, settings, point, seed, id, scratch).total() * (passed * follow);
    passed *= passing(point.fabric->gap, point.yarn);
  }
}

}  // namespace

void trace_samples(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                   std::span<const SampleId> samples, PathScratch& scratch, CameraSample* out) {
  const SequenceBatch all = pixel_sequences(seed, samples);
  const Batch2 film = draw2(all, Dimension::film);
  std::array<Ray, batch_size> rays;
  for (size_t k = 0; k < samples.size(); ++k) {
    const Vec2 place = sample_filter(film[k]);
    rays[k] = scene.camera.ray(float(samples[k].x) + 0.5f + place.x, float(samples[k].y) + 0.5f + place.y);
  }
  std::array<Hit, batch_size> hits;
  std::array<bool, batch_size> found;
  constexpr size_t packet = RayTracer::packet_size;
  for (size_t k = 0; k < samples.size(); k += packet)
    scene.rays->closest_hits({&rays[k], std::min(samples.size() - k, packet)}, &hits[k], &found[k]);
  scratch.counts.camera += std::int64_t(samples.size());

  // The hits move together.
  std::array<ClothPoint, batch_size> points;
  std::array<size_t, batch_size> sample_of;
  SequenceBatch met;
  for (size_t k = 0; k < samples.size(); ++k) {
    out[k] = {};
    if (!found[k]) {
      see_backdrop(scene, rays[k].direction, 1, out[k]);
      continue;
    }
    const auto n = size_t(met.count++);
    points[n] = cloth_point(scene, hits[k], rays[k].direction);
    sample_of[n] = k;
    met.seed[n] = all.seed[k];
    met.index[n] = all.index[k];
  }
  if (met.count == 0) return;
  if (scene.near_weave_pixel > 0)
    for (size_t n = 0; n < size_t(met.count); ++n)
      if (const size_t k = sample_of[n]; may_show_yarns(scene, hits[k].t))
        place_yarn(scene, rays[k].direction, points[n]);
  std::array<LobeLight, batch_size> direct;
  direct_light(scene, {points.data(), size_t(met.count)}, settings, met, scratch, direct.data());
  Batch1 choice{};  // 0 is always below the share
  if (settings.bounces > 0 && settings.bounce_share < 1) choice = draw(met, Dimension::bounces);
  for (size_t n = 0; n < size_t(met.count); ++n) {
    const size_t k = sample_of[n];
    const ClothPoint& point = points[n];
    CameraSample& sample = out[k];
    sample.hit = true;
    sample.position = point.surface.position;
    sample.normal = point.frame.z;
    sample.warp = point.frame.x;
    sample.uv = point.surface.uv;
    sample.wo = point.wo;
    sample.back = scene.back && point.fabric == &*scene.back;
    sample.alpha = 1;
    if (keep(direct[n], scratch.counts)) sample.direct = direct[n];
    const float follow =
        settings.bounces > 0 && choice[n] < double(settings.bounce_share) ? 1 / settings.bounce_share : 0.0f;
    if (follow > 0) {
      sample.indirect = indirect_light(scene, settings, point, seed, samples[k], scratch);
      for (Color& light : sample.indirect.bounce) light *= follow;
    }
    if (point.fabric->gap > 0)
      look_through(scene, settings, point, rays[k], seed, samples[k], follow, scratch, sample);
  }
}

CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                          const SampleId& sample, PathScratch& scratch) {
  CameraSample out;
  trace_samples(scene, settings, seed, {&sample, 1}, scratch, &out);
  return out;
}

}  // namespace sateen
