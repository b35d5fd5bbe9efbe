#include "integrator/path.h"

#include <cmath>

#include "integrator/bounces.h"
#include "integrator/ground_light.h"

namespace sateen {

namespace {

bool finite(const Color& c) {
  return std::isfinite(c.x + c.y + c.z);
}

// A value that is not finite is a fault somewhere below: it is dropped, counted and reported, never masked in
// silence.
bool keep(const Color& light, RayCounts& counts) {
  if (finite(light)) return true;
  ++counts.non_finite;
  return false;
}

/// The samples of a batch that see one kind of surface: their vertices, which are large and kept in the scratch, and
/// where they come from.
template <class Point>
struct Seen {
  std::array<Point, batch_size>& points;
  std::array<size_t, batch_size> sample;
  SequenceBatch numbers = {};

  size_t count() const { return size_t(numbers.count); }
  /// Room for the point of sample k.
  Point& add(size_t k, const SequenceBatch& all) {
    const auto n = size_t(numbers.count++);
    sample[n] = k;
    numbers.seed[n] = all.seed[k];
    numbers.index[n] = all.index[k];
    return points[n];
  }
};

/// Weights of the indirect light of a batch: 0 for the samples that do not follow it.
Batch1 follow_weights(const LightSettings& settings, const SequenceBatch& samples) {
  Batch1 weights{};
  Batch1 choice{};  // 0 is always below the share
  if (settings.bounce_share < 1) choice = draw(samples, Dimension::bounces);
  for (size_t k = 0; k < size_t(samples.count); ++k)
    if (choice[k] < double(settings.bounce_share)) weights[k] = double(1 / settings.bounce_share);
  return weights;
}

/// Indirect light of the points that follow it, times their weights; the others get none.
template <class Point>
void indirect_light(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                    std::span<const Point> points, const Batch1& weights, const SampleId* const* ids,
                    PathScratch& scratch, BounceLight* light) {
  std::array<PathStart, batch_size> starts;
  std::array<size_t, batch_size> of;
  std::array<BounceLight, batch_size> followed;
  size_t count = 0;
  for (size_t n = 0; n < points.size(); ++n) {
    light[n] = {};
    if (weights[n] == 0) continue;
    of[count] = n;
    starts[count++] = {points[n], *ids[n]};
  }
  if (count == 0) return;
  follow_bounces(scene, settings, seed, {starts.data(), count}, scratch, followed.data());
  for (size_t m = 0; m < count; ++m) {
    light[of[m]] = followed[m];
    for (Color& bounce : light[of[m]].bounce) bounce *= float(weights[of[m]]);
  }
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
    return;
  }
  out.indirect = indirect;
  for (Color& bounce : out.indirect.bounce) bounce *= covered * passed;
}

/// What is seen through the gaps of the first layer of sheer cloth; `eye` the camera ray as it is traced, `follow`
/// the weight of indirect light.
void look_through(const Scene& scene, const LightSettings& settings, ClothPoint point, const Ray& eye,
                  std::uint32_t seed, const SampleId& id, double follow, PathScratch& scratch, CameraSample& out) {
  const YTurn object = point.object;
  const Vec3 direction = scene.shutter ? turned(eye.direction, object) : eye.direction;
  const SampleId* const ids[] = {&id};
  Batch1 weight{};
  weight[0] = follow;
  float passed = passing(point.gap, point.yarn);
  for (int layer = 1; passed > 0 && layer < most_layers; ++layer) {
    Ray ray = eye;
    ray.origin = offset_origin(point.surface, ray.direction);
    ++scratch.counts.camera;
    // Another layer gets numbers of its own.
    const SequenceBatch numbers = alone(seed, id, -layer);
    double choice = scene.has_maps ? draw(numbers.sequence(0), Dimension::pattern, id.index) : 0;
    const std::optional<Vertex> next =
        meet(scene, ray, object, scene.ground ? &*scene.ground : nullptr, [&](const Hit& hit) {
          ClothPoint met;
          seen_cloth(scene, hit, eye, object, choice, met);
          return met;
        });
    if (!next) return see_backdrop(scene, direction, passed, out);
    BounceLight indirect;
    if (const auto* ground = std::get_if<GroundPoint>(&*next)) {
      GroundLight light;
      light_on_ground(scene, {ground, 1}, numbers, scratch.counts, &light);
      indirect_light<GroundPoint>(scene, settings, seed, {ground, 1}, weight, ids, scratch, &indirect);
      return see_ground(scene, *ground, light, indirect, direction, passed, scratch, out);
    }
    point = std::get<ClothPoint>(*next);
    LobeLight direct;
    direct_light(scene, {&point, 1}, settings, numbers, scratch, &direct);
    if (keep(direct.total(), scratch.counts)) out.through_gaps += direct.total() * passed;
    indirect_light<ClothPoint>(scene, settings, seed, {&point, 1}, weight, ids, scratch, &indirect);
    out.through_gaps += indirect.total() * passed;
    passed *= passing(point.gap, point.yarn);
  }
}

template <class Point>
std::array<const SampleId*, batch_size> ids_of(const Seen<Point>& seen, std::span<const SampleId> samples) {
  std::array<const SampleId*, batch_size> ids;
  for (size_t n = 0; n < seen.count(); ++n) ids[n] = &samples[seen.sample[n]];
  return ids;
}

void light_ground(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                  std::span<const SampleId> samples, const Seen<GroundPoint>& seen, const Ray* rays,
                  PathScratch& scratch, CameraSample* out) {
  const std::span<const GroundPoint> points{seen.points.data(), seen.count()};
  std::array<GroundLight, batch_size> light;
  light_on_ground(scene, points, seen.numbers, scratch.counts, light.data());
  std::array<BounceLight, batch_size> indirect;
  Batch1 weights{};
  if (scene.ground->blocks_light() && settings.bounces > 0) weights = follow_weights(settings, seen.numbers);
  indirect_light(scene, settings, seed, points, weights, ids_of(seen, samples).data(), scratch, indirect.data());
  for (size_t n = 0; n < seen.count(); ++n) {
    const size_t k = seen.sample[n];
    see_ground(scene, points[n], light[n], indirect[n], rays[k].direction, 1, scratch, out[k]);
  }
}

void light_cloth(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                 std::span<const SampleId> samples, const Seen<ClothPoint>& seen, const Ray* traced,
                 PathScratch& scratch, CameraSample* out) {
  const std::span<const ClothPoint> points{seen.points.data(), seen.count()};
  std::array<LobeLight, batch_size> direct;
  direct_light(scene, points, settings, seen.numbers, scratch, direct.data());
  Batch1 weights{};
  if (settings.bounces > 0) {
    std::array<BounceLight, batch_size> indirect;
    weights = follow_weights(settings, seen.numbers);
    indirect_light(scene, settings, seed, points, weights, ids_of(seen, samples).data(), scratch, indirect.data());
    for (size_t n = 0; n < seen.count(); ++n) out[seen.sample[n]].indirect = indirect[n];
  }
  for (size_t n = 0; n < seen.count(); ++n) {
    const size_t k = seen.sample[n];
    const ClothPoint& point = points[n];
    CameraSample& sample = out[k];
    sample.hit = true;
    sample.position =
        scene.shutter ? scene.shutter->to_world(point.surface.position, point.object) : point.surface.position;
    sample.normal = point.frame.z;
    sample.warp = point.frame.x;
    sample.uv = point.surface.uv;
    sample.wo = point.wo;
    sample.back = scene.back && point.on_back;
    sample.alpha = 1;
    if (keep(direct[n].total(), scratch.counts)) sample.direct = direct[n];
    if (scene.has_gaps && passing(point.gap, point.yarn) > 0)
      look_through(scene, settings, point, traced[k], seed, samples[k], weights[n], scratch, sample);
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
  Batch1 pattern{};
  if (scene.has_maps) pattern = draw(all, Dimension::pattern);

  // What meets the same kind of surface moves together.
  Seen<ClothPoint> cloth{scratch.cloth, {}};
  Seen<GroundPoint> ground{scratch.ground, {}};
  for (size_t k = 0; k < samples.size(); ++k) {
    out[k] = {};
    const YTurn object = scene.shutter ? scratch.moving.object[k] : YTurn();
    if (scene.ground) {
      const float t_max = !found[k] ? far_away : scene.ground->blocks_light() ? hits[k].t : 0;
      const std::optional<GroundPoint> point = met_ground(scene, *scene.ground, traced[k], object, t_max);
      if (point && ground_opacity(*scene.ground, point->position) > 0) {
        ground.add(k, all) = *point;
        continue;
      }
    }
    if (found[k])
      seen_cloth(scene, hits[k], traced[k], object, pattern[k], cloth.add(k, all));
    else
      see_backdrop(scene, rays[k].direction, 1, out[k]);
  }
  if (ground.count() > 0) light_ground(scene, settings, seed, samples, ground, rays.data(), scratch, out);
  if (cloth.count() > 0) light_cloth(scene, settings, seed, samples, cloth, traced, scratch, out);
}

CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                          const SampleId& sample, PathScratch& scratch) {
  CameraSample out;
  trace_samples(scene, settings, seed, {&sample, 1}, scratch, &out);
  return out;
}

}  // namespace sateen
