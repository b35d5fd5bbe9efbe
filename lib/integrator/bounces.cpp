#include "integrator/bounces.h"

#include <cmath>

#include "integrator/ground_light.h"

namespace sateen {

namespace {

constexpr int roulette_after = 3;  // bounces that are always followed
// What is seen by way of other cloth needs fewer: E squared at equal time of the default picture with 4, 6, 8 and 16
// is 1, 1.03, 1.07 and 1.15.
constexpr int shadows_after_bounce = 4;

struct Path {
  Vertex vertex;
  Color throughput{1, 1, 1};
  SampleId id;
  size_t start = 0;
};

/// Random numbers of one step of all paths.
struct StepNumbers {
  // The numbers of the vertex that is left may also have served its direct light, which is added to this. Those of
  // the vertex that is met must be others: its light is multiplied by what was drawn on the way to it.
  SequenceBatch met;
  Batch1 view{}, roulette{}, gap{}, pattern{};
  Batch2 thread{}, direction{}, ground{};
};

StepNumbers draw_step(const Scene& scene, FabricSampler sampler, std::uint32_t seed, std::span<const Path> paths,
                      int bounce) {
  StepNumbers u;
  std::array<SampleId, batch_size> ids;
  for (size_t k = 0; k < paths.size(); ++k) ids[k] = paths[k].id;
  const SequenceBatch left = pixel_sequences(seed, {ids.data(), paths.size()}, bounce - 1);
  u.met = pixel_sequences(seed, {ids.data(), paths.size()}, bounce);
  u.view = draw(left, Dimension::table_view);
  if (sampler == FabricSampler::talk) u.thread = draw2(left, Dimension::talk_thread);
  u.direction = draw2(left, sampler == FabricSampler::table  ? Dimension::table
                            : sampler == FabricSampler::talk ? Dimension::talk
                                                             : Dimension::uniform);
  if (solid_ground(scene)) u.ground = draw2(left, Dimension::uniform);
  if (bounce > roulette_after) u.roulette = draw(u.met, Dimension::roulette);
  if (scene.has_gaps) u.gap = draw(u.met, Dimension::gap);
  if (scene.has_maps) u.pattern = draw(u.met, Dimension::pattern);
  return u;
}

/// A direction out of the cloth, in its frame and the world's, and its density.
struct Leaving {
  Vec3 wi, world;
  float pdf;
};
std::optional<Leaving> leave_cloth(const ClothPoint& point, FabricSampler sampler, const FabricRandom& u,
                                   SamplerView& view) {
  prepare_sampler(*point.fabric, point.wo, sampler, view);
  const std::optional<Vec3> wi = sample(view, u);
  if (!wi) return std::nullopt;
  const Leaving leaving{*wi, point.frame.to_world(*wi), pdf(view, *wi)};
  if (!(leaving.pdf > 0) || dot(leaving.world, point.facing) <= 0) return std::nullopt;
  return leaving;
}

/// What a path meets next; each layer of sheer cloth is passed with its gaps' probability `pass`.
std::optional<Vertex> meet_next(const Scene& scene, Ray ray, const YTurn& object, double pass, double choice,
                                RayCounts& counts) {
  const Ground* const ground = solid_ground(scene);
  const auto cloth = [&](const Hit& hit) { return bounced_cloth(scene, hit, ray, object, choice); };
  for (int layer = 0;; ++layer) {
    ++counts.bounce;
    if (counts.log) counts.log->bounce.push_back(ray);
    std::optional<Vertex> next = meet(scene, ray, object, ground, cloth);
    const ClothPoint* met = next && scene.has_gaps ? std::get_if<ClothPoint>(&*next) : nullptr;
    if (!met || !(pass < double(met->gap)) || layer == most_layers) return next;
    pass /= double(met->gap);
    ray.origin = offset_origin(met->surface, ray.direction);
  }
}

/// Takes a path to its next vertex; false where it ends.
bool step(const Scene& scene, FabricSampler sampler, int bounce, const StepNumbers& u, size_t k, PathScratch& scratch,
          Path& path) {
  const auto* cloth = std::get_if<ClothPoint>(&path.vertex);
  Leaving leaving{};
  if (cloth) {
    const std::optional<Leaving> drawn =
        leave_cloth(*cloth, sampler, {u.view[k], u.thread[k], u.direction[k]}, scratch.vertex.sampler);
    if (!drawn) return false;
    leaving = *drawn;
  } else {
    leaving.world = leave_ground(std::get<GroundPoint>(path.vertex), u.ground[k]);
    path.throughput *= scene.ground->albedo;
  }
  if (bounce > roulette_after) {
    const float stay = std::min(max_component(path.throughput), 0.95f);
    if (!(float(u.roulette[k]) < stay)) return false;
    path.throughput /= stay;
  }
  const std::optional<Vertex> next = meet_next(scene, leave(scene, path.vertex, leaving.world),
                                               object_turn(path.vertex), u.gap[k], u.pattern[k], scratch.counts);
  if (!next) return false;  // the environment was counted at the vertex before
  if (cloth) {
    prepare_threads(*cloth->fabric, cloth->wo, scratch.vertex, cloth->own_values());
    path.throughput *=
        combine_parts(scratch.vertex, evaluate_parts(scratch.vertex, cloth->yarn, leaving.wi)) / leaving.pdf;
  }
  path.vertex = *next;
  if (const auto* met = std::get_if<ClothPoint>(&path.vertex)) {
    // What scatters here was chosen with the probability of not passing; F holds the gaps' share already.
    if (!(met->gap < 1)) return false;
    path.throughput /= 1 - met->gap;
  }
  return max_component(path.throughput) > 0;
}

void add_light(const Color& sent, int bounce, RayCounts& counts, BounceLight& light) {
  if (std::isfinite(sent.x + sent.y + sent.z))
    light.bounce[std::min(bounce, tracked_bounces) - 1] += sent;
  else
    ++counts.non_finite;
}

/// Lights the vertices that the paths have met, cloth and ground each together.
void light_vertices(const Scene& scene, const LightSettings& settings, std::span<const Path> paths,
                    const SequenceBatch& met, int bounce, PathScratch& scratch, BounceLight* light) {
  std::array<ClothPoint, batch_size> cloth;
  std::array<GroundPoint, batch_size> ground;
  std::array<size_t, batch_size> cloth_of, ground_of;
  SequenceBatch on_cloth, on_ground;
  const auto take = [&](SequenceBatch& batch, std::array<size_t, batch_size>& of, size_t k) {
    const auto n = size_t(batch.count++);
    of[n] = k;
    batch.seed[n] = met.seed[k];
    batch.index[n] = met.index[k];
    return n;
  };
  for (size_t k = 0; k < paths.size(); ++k)
    if (const auto* point = std::get_if<ClothPoint>(&paths[k].vertex))
      cloth[take(on_cloth, cloth_of, k)] = *point;
    else
      ground[take(on_ground, ground_of, k)] = std::get<GroundPoint>(paths[k].vertex);
  if (on_cloth.count > 0) {
    std::array<LobeLight, batch_size> direct;
    LightSettings fewer = settings;
    fewer.shadows = std::min(settings.shadows, shadows_after_bounce);
    direct_light(scene, {cloth.data(), size_t(on_cloth.count)}, fewer, on_cloth, scratch, direct.data());
    for (size_t n = 0; n < size_t(on_cloth.count); ++n) {
      const Path& path = paths[cloth_of[n]];
      add_light(path.throughput * direct[n].total(), bounce, scratch.counts, light[path.start]);
    }
  }
  if (on_ground.count > 0) {
    std::array<GroundLight, batch_size> arriving;
    light_on_ground(scene, {ground.data(), size_t(on_ground.count)}, on_ground, scratch.counts, arriving.data());
    for (size_t n = 0; n < size_t(on_ground.count); ++n) {
      const Path& path = paths[ground_of[n]];
      add_light(path.throughput * arriving[n].reached * scene.ground->albedo, bounce, scratch.counts,
                light[path.start]);
    }
  }
}

}  // namespace

void follow_bounces(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                    std::span<const PathStart> starts, PathScratch& scratch, BounceLight* light) {
  const FabricSampler sampler = strategy_sampler(settings.strategy);
  std::array<Path, batch_size> paths;
  const std::int64_t shadow_before = scratch.counts.shadow, lit_before = scratch.counts.lit;
  size_t alive = starts.size();
  for (size_t k = 0; k < alive; ++k) {
    paths[k].vertex = starts[k].vertex;
    paths[k].id = starts[k].id;
    paths[k].start = k;
    light[k] = {};
  }
  for (int bounce = 1; bounce <= settings.bounces && alive > 0; ++bounce) {
    StepNumbers u = draw_step(scene, sampler, seed, {paths.data(), alive}, bounce);
    size_t kept = 0;
    for (size_t k = 0; k < alive; ++k) {
      if (!step(scene, sampler, bounce, u, k, scratch, paths[k])) continue;
      if (kept != k) paths[kept] = paths[k];
      u.met.seed[kept] = u.met.seed[k];
      u.met.index[kept] = u.met.index[k];
      ++kept;
    }
    alive = kept;
    u.met.count = int(alive);
    light_vertices(scene, settings, {paths.data(), alive}, u.met, bounce, scratch, light);
  }
  scratch.counts.shadow_after += scratch.counts.shadow - shadow_before;
  scratch.counts.lit_after += scratch.counts.lit - lit_before;
}

}  // namespace sateen
