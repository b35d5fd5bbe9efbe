#include "integrator/path.h"

#include <cmath>

#include "integrator/bounces.h"
#include "integrator/ground_light.h"

namespace sateen {

namespace {

// A value that is not finite is a fault somewhere below: it is dropped, counted and reported, never masked in
// silence.
bool keep(const Color& light, RayCounts& counts) {
  if (std::isfinite(light.x + light.y + light.z)) return true;
  ++counts.non_finite;
  return false;
}

/// A batch of samples on their way through layers of sheer cloth; most see one surface and are done.
struct Sights {
  std::span<const SampleId> ids;
  const Ray* world;                       // camera rays
  const Ray* traced;                      // the same as the turned object sees them
  int layer = 0;                          // layers that have been passed
  std::array<float, batch_size> passed;   // by sample: share of what lies behind them that is seen
  std::array<float, batch_size> seen;     // by sample: share of what they meet now that is seen
  std::array<double, batch_size> follow;  // by sample: weight of indirect light
};

/// The samples of a batch that see one kind of surface: their vertices, which are large and kept in the scratch, and
/// where they come from.
template <class Point>
struct Seen {
  std::array<Point, batch_size>& points;
  std::array<size_t, batch_size> sample;
  SequenceBatch numbers = {};

  size_t count() const { return size_t(numbers.count); }
  std::span<const Point> met() const { return {points.data(), count()}; }
  /// Room for the point of sample k, which takes the n-th numbers.
  Point& add(size_t k, const SequenceBatch& all, size_t n) {
    const auto to = size_t(numbers.count++);
    sample[to] = k;
    numbers.seed[to] = all.seed[n];
    numbers.index[to] = all.index[n];
    return points[to];
  }
};

/// Decides which samples follow indirect light, and with what weight; the others get 0.
template <class Point>
void weigh_indirect(const LightSettings& settings, const Seen<Point>& seen, Sights& sights) {
  Batch1 choice{};  // 0 is always below the share
  if (settings.bounce_share < 1) choice = draw(seen.numbers, Dimension::bounces);
  for (size_t n = 0; n < seen.count(); ++n)
    sights.follow[seen.sample[n]] = choice[n] < double(settings.bounce_share) ? double(1 / settings.bounce_share) : 0;
}

/// Indirect light of the points that follow it, times their weights; the others get none.
template <class Point>
void indirect_light(const Scene& scene, const LightSettings& settings, std::uint32_t seed, const Seen<Point>& seen,
                    const Sights& sights, PathScratch& scratch, BounceLight* light) {
  std::array<PathStart, batch_size> starts;
  std::array<size_t, batch_size> of;
  std::array<BounceLight, batch_size> followed;
  size_t count = 0;
  for (size_t n = 0; n < seen.count(); ++n) {
    light[n] = {};
    if (sights.follow[seen.sample[n]] == 0) continue;
    of[count] = n;
    starts[count++] = {seen.points[n], sights.ids[seen.sample[n]]};
  }
  if (count == 0) return;
  follow_bounces(scene, settings, seed, {starts.data(), count}, scratch, followed.data());
  for (size_t m = 0; m < count; ++m) {
    light[of[m]] = followed[m];
    for (Color& bounce : light[of[m]].bounce) bounce *= float(sights.follow[seen.sample[of[m]]]);
  }
}

/// Sequences of a layer that some samples see.
SequenceBatch layer_sequences(std::uint32_t seed, std::span<const SampleId> ids, std::span<const size_t> sample,
                              int layer) {
  std::array<SampleId, batch_size> seen;
  for (size_t n = 0; n < sample.size(); ++n) seen[n] = ids[sample[n]];
  return pixel_sequences(seed, {seen.data(), sample.size()}, -layer);
}

/// The backdrop, of which `passed` reaches the eye.
void see_backdrop(const Scene& scene, const Vec3& direction, float passed, CameraSample& out) {
  if (scene.backdrop == Backdrop::environment)
    out.backdrop = environment_backdrop(scene.environment, direction) * passed;
  else if (scene.backdrop == Backdrop::plain)
    out.backdrop = scene.backdrop_color * passed;
  else if (scene.backdrop == Backdrop::blurred && scene.blurred)
    out.backdrop = blurred_radiance(*scene.blurred, scene.environment, direction) * passed;
  out.coverage = 1 - passed;
  out.alpha = scene.backdrop == Backdrop::none ? out.coverage : 1;
}

/// Ground that the eye sees along `direction`, `passed` of it, with the light that it got.
void see_ground(const Scene& scene, const GroundPoint& point, const GroundLight& light, const BounceLight& indirect,
                const Vec3& direction, float passed, PathScratch& scratch, CameraSample& out) {
  const bool catches = !scene.ground->blocks_light();
  const float covered = catches ? shadow_share(scene, light) : ground_opacity(*scene.ground, point.position);
  see_backdrop(scene, direction, passed * (1 - covered), out);
  if (catches) return;
  const Color radiance = light.reached * scene.ground->albedo;
  if (keep(radiance, scratch.counts)) out.backdrop += radiance * (covered * passed);
  if (out.hit) {
    out.through_gaps += indirect.total() * (covered * passed);
    for (int b = 0; b < tracked_bounces; ++b) out.bounced_behind.bounce[b] += indirect.bounce[b] * (covered * passed);
    return;
  }
  out.indirect = indirect;
  for (Color& bounce : out.indirect.bounce) bounce *= covered * passed;
}

void light_ground(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                  const Seen<GroundPoint>& seen, Sights& sights, PathScratch& scratch, CameraSample* out) {
  std::array<GroundLight, batch_size> light;
  light_on_ground(scene, seen.met(), seen.numbers, scratch.counts, light.data());
  std::array<BounceLight, batch_size> indirect{};
  if (scene.ground->blocks_light() && settings.bounces > 0) {
    if (sights.layer == 0) weigh_indirect(settings, seen, sights);
    indirect_light(scene, settings, seed, seen, sights, scratch, indirect.data());
  }
  for (size_t n = 0; n < seen.count(); ++n) {
    const size_t k = seen.sample[n];
    see_ground(scene, seen.points[n], light[n], indirect[n], sights.world[k].direction, sights.passed[k], scratch,
               out[k]);
  }
}

/// CameraSample::presence of a point.
std::array<float, 2> presence_of(const ClothPoint& point) {
  std::array<float, 2> presence{1, 1};
  const VaryingThreads* varying = point.mapped ? point.fabric->varying.get() : nullptr;
  for (size_t family = 0; family < 2; ++family) {
    const Weave& weave = point.fabric->weave;
    const float mean = varying ? varying->values[family].coverage : float(weave.coverage[family]);
    if (varying && mean > 0) presence[family] = point.values.family[family].coverage / mean;
    if (point.yarn.near == 0) continue;
    const float yarn = point.yarn.family == int(family) && mean > 0 ? point.yarn.light / mean : 0;
    presence[family] += (yarn - presence[family]) * point.yarn.near;
  }
  return presence;
}

/// The first cloth that a sample sees: what else is told of it.
void see_first(const Scene& scene, const ClothPoint& point, CameraSample& sample) {
  sample.hit = true;
  sample.position = scene.mesh->placement.to_scene(
      scene.shutter ? scene.shutter->to_world(point.surface.position, point.object) : point.surface.position);
  sample.normal = point.frame.z;
  sample.warp = point.frame.x;
  sample.uv = point.surface.uv;
  sample.wo = point.wo;
  sample.back = scene.back && point.on_back;
  sample.fabric = point.fabric;
  sample.A = point.mapped ? point.values.A : point.fabric->A;
  sample.presence = presence_of(point);
  sample.coverage = sample.alpha = 1;
}

void light_cloth(const Scene& scene, const LightSettings& settings, std::uint32_t seed, const Seen<ClothPoint>& seen,
                 Sights& sights, PathScratch& scratch, CameraSample* out) {
  std::array<LobeLight, batch_size> direct;
  direct_light(scene, seen.met(), settings, seen.numbers, scratch, direct.data());
  std::array<BounceLight, batch_size> indirect;
  if (settings.bounces > 0) {
    if (sights.layer == 0) weigh_indirect(settings, seen, sights);
    indirect_light(scene, settings, seed, seen, sights, scratch, indirect.data());
  }
  for (size_t n = 0; n < seen.count(); ++n) {
    const size_t k = seen.sample[n];
    const bool good = keep(direct[n].total(), scratch.counts);
    if (sights.layer == 0) {
      see_first(scene, seen.points[n], out[k]);
      if (good) out[k].direct = direct[n];
      if (settings.bounces > 0) out[k].indirect = indirect[n];
      continue;
    }
    if (good) out[k].through_gaps += direct[n].total();
    if (settings.bounces == 0) continue;
    out[k].through_gaps += indirect[n].total();
    for (int b = 0; b < tracked_bounces; ++b) out[k].bounced_behind.bounce[b] += indirect[n].bounce[b];
  }
}

/// Sends those rays on that see something through the gaps of the cloth that they met: returns how many, which
/// samples they are, and the rays.
size_t pass_layer(const Seen<ClothPoint>& seen, Sights& sights, size_t* sample, Ray* rays) {
  size_t count = 0;
  for (size_t n = 0; n < seen.count(); ++n) {
    const size_t k = seen.sample[n];
    const ClothPoint& point = seen.points[n];
    sights.seen[k] = sights.passed[k];
    if (!((sights.passed[k] *= passing(point.gap, point.yarn)) > 0)) continue;
    rays[count] = sights.traced[k];
    rays[count].origin = offset_origin(point.surface, rays[count].direction);
    sample[count++] = k;
  }
  return count;
}

/// Keeps of a deeper layer the points that are lit: as large a share of the samples as is seen of it, so that nothing
/// is left to weigh. Rays are cheap and light is not: on the drape half of the time for a tenth more noise. Sight and
/// alpha go through all layers.
void thin_out(Seen<ClothPoint>& layer, const Sights& sights) {
  const Batch1 u = draw(layer.numbers, Dimension::roulette);
  size_t kept = 0;
  for (size_t n = 0; n < layer.count(); ++n) {
    const size_t k = layer.sample[n];
    if (!(float(u[n]) < sights.seen[k])) continue;
    if (kept != n) layer.points[kept] = layer.points[n];
    layer.sample[kept] = k;
    layer.numbers.seed[kept] = layer.numbers.seed[n];
    layer.numbers.index[kept++] = layer.numbers.index[n];
  }
  layer.numbers.count = int(kept);
}

/// What the rays of the samples meet next. What meets the same kind of surface moves together.
void meet_layer(const Scene& scene, const Sights& sights, const SequenceBatch& numbers, const size_t* sample,
                const Ray* rays, PathScratch& scratch, Seen<ClothPoint>& cloth, Seen<GroundPoint>& ground,
                CameraSample* out) {
  const auto count = size_t(numbers.count);
  std::array<Hit, batch_size> hits;
  std::array<bool, batch_size> found;
  constexpr size_t packet = RayTracer::packet_size;
  for (size_t n = 0; n < count; n += packet)
    scene.rays->closest_hits({&rays[n], std::min(count - n, packet)}, &hits[n], &found[n]);
  scratch.counts.camera += std::int64_t(count);
  Batch1 pattern{};
  if (scene.has_maps) pattern = draw(numbers, Dimension::pattern);
  for (size_t n = 0; n < count; ++n) {
    const size_t k = sample[n];
    const YTurn object = scene.shutter ? scratch.moving.object[k] : YTurn();
    if (scene.ground) {
      const float t_max = !found[n] ? far_away : scene.ground->blocks_light() ? hits[n].t : 0;
      const std::optional<GroundPoint> point = met_ground(scene, *scene.ground, rays[n], object, t_max);
      if (point && ground_opacity(*scene.ground, point->position) > 0) {
        ground.add(k, numbers, n) = *point;
        continue;
      }
    }
    if (found[n])
      seen_cloth(scene, hits[n], sights.traced[k], object, pattern[n], cloth.add(k, numbers, n));
    else
      see_backdrop(scene, sights.world[k].direction, sights.passed[k], out[k]);
  }
}

}  // namespace

void trace_samples(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                   std::span<const SampleId> samples, PathScratch& scratch, CameraSample* out) {
  const SequenceBatch all = pixel_sequences(seed, samples);
  const Batch2 film = draw2(all, Dimension::film);
  std::array<Ray, batch_size> rays;
  for (size_t k = 0; k < samples.size(); ++k) {
    const Vec2 place = sample_filter(*scene.filter, film[k]);
    rays[k] = scene.camera.ray(float(samples[k].x) + 0.5f + place.x, float(samples[k].y) + 0.5f + place.y);
  }
  if (scene.lens) through_lens(scene.camera, *scene.lens, draw2(all, Dimension::lens), {rays.data(), samples.size()});
  Sights sights{samples, rays.data(), rays.data(), 0, {}, {}, {}};
  if (scene.shutter) {
    open_shutter(*scene.shutter, draw(all, Dimension::time), {rays.data(), samples.size()}, scratch.moving);
    sights.traced = scratch.moving.traced.data();
  }
  sights.passed.fill(1);
  std::array<size_t, batch_size> sample;
  std::array<Ray, batch_size> beyond;
  for (size_t k = 0; k < samples.size(); ++k) {
    out[k] = {};
    sample[k] = k;
  }
  const Ray* from = sights.traced;
  for (size_t count = samples.size(); count > 0 && sights.layer < most_layers; from = beyond.data()) {
    Seen<ClothPoint> cloth{scratch.cloth, {}};
    Seen<GroundPoint> ground{scratch.ground, {}};
    // Every layer gets numbers of its own.
    const SequenceBatch numbers =
        sights.layer == 0 ? all : layer_sequences(seed, samples, {sample.data(), count}, sights.layer);
    meet_layer(scene, sights, numbers, sample.data(), from, scratch, cloth, ground, out);
    if (ground.count() > 0) light_ground(scene, settings, seed, ground, sights, scratch, out);
    count = scene.has_gaps ? pass_layer(cloth, sights, sample.data(), beyond.data()) : 0;
    if (sights.layer > 0) thin_out(cloth, sights);
    if (cloth.count() > 0) light_cloth(scene, settings, seed, cloth, sights, scratch, out);
    ++sights.layer;
  }
}

CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                          const SampleId& sample, PathScratch& scratch) {
  CameraSample out;
  trace_samples(scene, settings, seed, {&sample, 1}, scratch, &out);
  return out;
}

}  // namespace sateen
