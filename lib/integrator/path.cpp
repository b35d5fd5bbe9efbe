#include "integrator/path.h"

#include <cmath>

#include "film/filter.h"
#include "integrator/ground_light.h"
#include "integrator/vertex.h"

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

/// A direction of the world in which a path leaves the cloth, drawn by the cloth's sampler; `throughput` takes its
/// weight. Numbers of `left`.
std::optional<Vec3> leave_cloth(const ClothPoint& point, FabricSampler sampler, Sequence left, std::uint32_t index,
                                FabricView& view, Color& throughput) {
  FabricRandom u;
  u.choice = draw(left, Dimension::table_view, index);
  u.thread = draw2(left, Dimension::talk_thread, index);
  const Dimension used = sampler == FabricSampler::table  ? Dimension::table
                         : sampler == FabricSampler::talk ? Dimension::talk
                                                          : Dimension::uniform;
  u.direction = draw2(left, used, index);
  prepare_view(*point.fabric, point.wo, sampler, view);
  const std::optional<Vec3> wi = sample(view.sampler, u);
  if (!wi) return std::nullopt;
  const BsdfValue value = evaluate_with_pdf(view, *wi);
  const Vec3 direction = point.frame.to_world(*wi);
  if (!(value.pdf > 0) || dot(direction, point.facing) <= 0) return std::nullopt;
  throughput *= value.f_cos / value.pdf;
  return direction;
}

/// Light after two and more meetings, from `vertex` on, by bounce.
BounceLight indirect_light(const Scene& scene, const LightSettings& settings, Vertex vertex, std::uint32_t seed,
                           const SampleId& id, PathScratch& scratch) {
  const FabricSampler sampler = strategy_sampler(settings.strategy);
  const Ground* const ground = solid_ground(scene);
  const YTurn object = object_turn(vertex);
  BounceLight light;
  Color throughput(1);
  for (int bounce = 1; bounce <= settings.bounces; ++bounce) {
    // The numbers of the vertex that is left may also have served its direct light, which is added to this. Those of
    // the vertex that is met must be others: its light is multiplied by what was drawn on the way to it.
    const Sequence left = alone(seed, id, bounce - 1).sequence(0);
    const SequenceBatch met_batch = alone(seed, id, bounce);
    const Sequence met = met_batch.sequence(0);
    std::optional<Vec3> direction;
    if (const auto* cloth = std::get_if<ClothPoint>(&vertex)) {
      direction = leave_cloth(*cloth, sampler, left, id.index, scratch.vertex, throughput);
    } else {
      direction = leave_ground(std::get<GroundPoint>(vertex), draw2(left, Dimension::uniform, id.index));
      throughput *= ground->albedo;
    }
    if (!direction) break;
    if (bounce > roulette_after) {
      const float stay = std::min(max_component(throughput), 0.95f);
      if (!(float(draw(met, Dimension::roulette, id.index)) < stay)) break;
      throughput /= stay;
    }
    if (!(max_component(throughput) > 0)) break;

    Ray ray = leave(scene, vertex, *direction);
    ++scratch.counts.bounce;
    std::optional<Vertex> next = meet(scene, ray, object, ground);
    // Each layer of sheer cloth is passed with its gaps' probability.
    const ClothPoint* cloth = next ? std::get_if<ClothPoint>(&*next) : nullptr;
    double pass = cloth && cloth->fabric->gap > 0 ? draw(met, Dimension::gap, id.index) : 1;
    for (int layer = 0; cloth && pass < double(cloth->fabric->gap) && layer < most_layers; ++layer) {
      pass /= double(cloth->fabric->gap);
      ray.origin = offset_origin(cloth->surface, ray.direction);
      ++scratch.counts.bounce;
      next = meet(scene, ray, object, ground);
      cloth = next ? std::get_if<ClothPoint>(&*next) : nullptr;
    }
    if (!next) break;  // the environment was counted at the vertex before
    vertex = *next;
    Color direct;
    if (cloth) {
      // What scatters here was chosen with the probability of not passing; F holds the gaps' share already.
      throughput /= 1 - cloth->fabric->gap;
      direct = direct_light(scene, *cloth, settings, met_batch, scratch).total();
    } else {
      GroundLight arriving;
      light_on_ground(scene, {&std::get<GroundPoint>(vertex), 1}, met_batch, scratch.counts, &arriving);
      direct = arriving.reached * ground->albedo;
    }
    const Color sent = throughput * direct;
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
  else if (scene.backdrop == Backdrop::blurred && scene.blurred)
    out.backdrop = blurred_radiance(*scene.blurred, scene.environment, direction) * passed;
  out.alpha = scene.backdrop == Backdrop::none ? 1 - passed : 1;
}

/// Ground that the eye sees, `passed` of it; `follow` is the weight of its indirect light.
struct SeenGround {
  size_t sample;
  Vec3 direction;
  float passed, follow;
};

void see_ground(const Scene& scene, const LightSettings& settings, std::span<const SeenGround> seen,
                std::span<const GroundPoint> points, const SequenceBatch& samples, std::uint32_t seed,
                const SampleId* ids, PathScratch& scratch, CameraSample* out) {
  std::array<GroundLight, batch_size> light;
  light_on_ground(scene, points, samples, scratch.counts, light.data());
  for (size_t n = 0; n < seen.size(); ++n) {
    const SeenGround& s = seen[n];
    CameraSample& sample = out[s.sample];
    const bool catches = !scene.ground->blocks_light();
    const float covered = catches ? shadow_share(scene, light[n]) : ground_opacity(*scene.ground, points[n].position);
    see_backdrop(scene, s.direction, s.passed * (1 - covered), sample);
    if (catches) continue;
    const Color radiance = light[n].reached * scene.ground->albedo;
    if (finite(radiance))
      sample.backdrop += radiance * (covered * s.passed);
    else
      ++scratch.counts.non_finite;
    if (s.follow == 0) continue;
    BounceLight indirect = indirect_light(scene, settings, points[n], seed, ids[s.sample], scratch);
    for (Color& bounce : indirect.bounce) bounce *= covered * s.passed * s.follow;
    if (sample.hit)
      sample.through_gaps += indirect.total();
    else
      sample.indirect = indirect;
  }
}

/// What is seen through the gaps of the first layer of sheer cloth; `ray` as it is traced, `follow` the weight of
/// indirect light.
void look_through(const Scene& scene, const LightSettings& settings, ClothPoint point, Ray ray, std::uint32_t seed,
                  const SampleId& id, float follow, PathScratch& scratch, CameraSample& out) {
  const YTurn object = point.object;
  const Vec3 direction = scene.shutter ? turned(ray.direction, object) : ray.direction;
  float passed = point.fabric->gap;
  for (int layer = 1; passed > 0 && layer < most_layers; ++layer) {
    ray.origin = offset_origin(point.surface, ray.direction);
    ++scratch.counts.camera;
    const std::optional<Vertex> next = meet(scene, ray, object, scene.ground ? &*scene.ground : nullptr);
    if (!next) return see_backdrop(scene, direction, passed, out);
    // Another layer gets numbers of its own.
    const SequenceBatch numbers = alone(seed, id, -layer);
    if (const auto* ground = std::get_if<GroundPoint>(&*next)) {
      const SeenGround seen{0, direction, passed, follow};
      return see_ground(scene, settings, {&seen, 1}, {ground, 1}, numbers, seed, &id, scratch, &out);
    }
    point = std::get<ClothPoint>(*next);
    const LobeLight direct = direct_light(scene, point, settings, numbers, scratch);
    if (keep(direct, scratch.counts)) out.through_gaps += direct.total() * passed;
    if (follow > 0)
      out.through_gaps += indirect_light(scene, settings, point, seed, id, scratch).total() * (passed * follow);
    passed *= point.fabric->gap;
  }
}

/// Weights of the indirect light of a batch: 0 for the samples that do not follow it.
Batch1 follow_weights(const LightSettings& settings, const SequenceBatch& samples) {
  Batch1 weights{};
  if (settings.bounces == 0) return weights;
  Batch1 choice{};  // 0 is always below the share
  if (settings.bounce_share < 1) choice = draw(samples, Dimension::bounces);
  for (size_t k = 0; k < size_t(samples.count); ++k)
    if (choice[k] < double(settings.bounce_share)) weights[k] = double(1 / settings.bounce_share);
  return weights;
}

/// Lights the samples of a batch that see ground before cloth; returns their bits.
std::uint64_t look_at_ground(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                             std::span<const SampleId> samples, const SequenceBatch& all, const Ray* rays,
                             const Hit* hits, const bool* found, PathScratch& scratch, CameraSample* out) {
  std::array<SeenGround, batch_size> seen;
  std::array<GroundPoint, batch_size> points;
  SequenceBatch numbers;
  std::uint64_t bits = 0;
  for (size_t k = 0; k < samples.size(); ++k) {
    const float t_max = !found[k] ? far_away : scene.ground->blocks_light() ? hits[k].t : 0;
    const std::optional<GroundPoint> point = meet_ground(*scene.ground, rays[k].origin, rays[k].direction, t_max);
    if (!point || ground_opacity(*scene.ground, point->position) == 0) continue;
    const auto n = size_t(numbers.count++);
    seen[n] = {k, rays[k].direction, 1, 0};
    points[n] = *point;
    if (scene.shutter) points[n].object = scratch.moving.object[k];
    numbers.seed[n] = all.seed[k];
    numbers.index[n] = all.index[k];
    bits |= std::uint64_t(1) << k;
  }
  const auto count = size_t(numbers.count);
  const Batch1 follow = follow_weights(settings, numbers);
  for (size_t n = 0; n < count; ++n) seen[n].follow = float(follow[n]);
  see_ground(scene, settings, {seen.data(), count}, {points.data(), count}, numbers, seed, samples.data(), scratch,
             out);
  return bits;
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
  if (scene.lens) through_lens(scene.camera, *scene.lens, draw2(all, Dimension::lens), {rays.data(), samples.size()});
  const Ray* traced = rays.data();
  if (scene.shutter) {
    open_shutter(*scene.shutter, draw(all, Dimension::time), {rays.data(), samples.size()}, scratch.moving);
    traced = scratch.moving.traced.data();
  }
  std::array<Hit, batch_size> hits;
  std::array<bool, batch_size> found;
  constexpr size_t packet = RayTracer::packet_size;
  for (size_t k = 0; k < samples.size(); k += packet)
    scene.rays->closest_hits({&traced[k], std::min(samples.size() - k, packet)}, &hits[k], &found[k]);
  scratch.counts.camera += std::int64_t(samples.size());
  std::fill_n(out, samples.size(), CameraSample());
  std::uint64_t on_ground = 0;
  if (scene.ground)
    on_ground =
        look_at_ground(scene, settings, seed, samples, all, rays.data(), hits.data(), found.data(), scratch, out);

  // The hits move together.
  std::array<ClothPoint, batch_size> points;
  std::array<size_t, batch_size> sample_of;
  SequenceBatch met;
  for (size_t k = 0; k < samples.size(); ++k) {
    if (on_ground >> k & 1) continue;
    if (!found[k]) {
      see_backdrop(scene, rays[k].direction, 1, out[k]);
      continue;
    }
    const auto n = size_t(met.count++);
    points[n] = cloth_point(scene, hits[k], traced[k].direction);
    if (scene.shutter) turn_point(points[n], scratch.moving.object[k]);
    sample_of[n] = k;
    met.seed[n] = all.seed[k];
    met.index[n] = all.index[k];
  }
  if (met.count == 0) return;
  std::array<LobeLight, batch_size> direct;
  direct_light(scene, {points.data(), size_t(met.count)}, settings, met, scratch, direct.data());
  const Batch1 follow = follow_weights(settings, met);
  for (size_t n = 0; n < size_t(met.count); ++n) {
    const size_t k = sample_of[n];
    const ClothPoint& point = points[n];
    CameraSample& sample = out[k];
    sample.hit = true;
    sample.position =
        scene.shutter ? scene.shutter->to_world(point.surface.position, point.object) : point.surface.position;
    sample.normal = point.frame.z;
    sample.warp = point.frame.x;
    sample.uv = point.surface.uv;
    sample.wo = point.wo;
    sample.back = scene.back && point.fabric == &*scene.back;
    sample.alpha = 1;
    if (keep(direct[n], scratch.counts)) sample.direct = direct[n];
    const auto weight = float(follow[n]);
    if (weight > 0) {
      sample.indirect = indirect_light(scene, settings, point, seed, samples[k], scratch);
      for (Color& light : sample.indirect.bounce) light *= weight;
    }
    if (point.fabric->gap > 0)
      look_through(scene, settings, point, traced[k], seed, samples[k], weight, scratch, sample);
  }
}

CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                          const SampleId& sample, PathScratch& scratch) {
  CameraSample out;
  trace_samples(scene, settings, seed, {&sample, 1}, scratch, &out);
  return out;
}

}  // namespace sateen
