#include "integrator/direct.h"

#include <array>
#include <cmath>

namespace sateen {

namespace {

constexpr int most_candidates = 64;

float brightness(const Color& c) { return mean_component(c); }

/// F L weight at a direction, split into lobes.
LobeLight lobes(const FabricView& view, const Vec3& wi, const Color& light) {
  const ThreadSums<float> parts = evaluate_parts(view, wi);
  LobeLight out;
  for (int family = 0; family < 2; ++family) {
    out.surface[family] = light * parts.surface[family];
    out.volume[family] = light * view.fabric->A[family] * parts.volume[family];
  }
  return out;
}

void add(LobeLight& to, const LobeLight& from) {
  for (int family = 0; family < 2; ++family) {
    to.surface[family] += from.surface[family];
    to.volume[family] += from.volume[family];
  }
}

/// What every strategy needs at one hit.
struct Estimator {
  const Scene& scene;
  const ClothPoint& point;
  const FabricView& view;
  Sequence sequence;
  RayCounts& counts;

  /// Shadow ray first: a blocked direction costs no evaluation.
  LobeLight contribution(const Vec3& wi, const Vec3& world, const Color& radiance, float weight) const {
    if (!(weight > 0) || max_component(radiance) <= 0) return {};
    const float seen = transmittance(scene, point, world, counts);
    if (seen == 0) return {};
    return lobes(view, wi, radiance * (seen * weight));
  }

  std::optional<Vec3> fabric_direction(FabricSampler sampler, std::uint32_t index) const {
    FabricRandom u;
    switch (sampler) {
      case FabricSampler::uniform: u.direction = draw2(sequence, Dimension::uniform, index); break;
      case FabricSampler::talk:
        u.thread = draw2(sequence, Dimension::talk_thread, index);
        u.direction = draw2(sequence, Dimension::talk, index);
        break;
      case FabricSampler::table:
        u.choice = draw(sequence, Dimension::table_view, index);
        u.direction = draw2(sequence, Dimension::table, index);
        break;
    }
    return sample(view, sampler, u);
  }

  EnvironmentPick environment_direction(EnvironmentDensity density, std::uint32_t index) const {
    const std::array<double, 2> u = draw2(sequence, Dimension::environment, index);
    return pick_environment(scene.environment, density, u[0], u[1]);
  }

  LobeLight by_fabric(FabricSampler sampler, std::uint32_t index) const {
    const std::optional<Vec3> wi = fabric_direction(sampler, index);
    if (!wi) return {};
    const Vec3 world = point.frame.to_world(*wi);
    const float density = pdf(view, sampler, *wi);
    return contribution(*wi, world, environment_radiance(scene.environment, world), density > 0 ? 1 / density : 0);
  }

  LobeLight by_environment(std::uint32_t index) const {
    const EnvironmentPick pick = environment_direction(EnvironmentDensity::radiance, index);
    if (!pick.texel) return {};
    const Vec3 wi = point.frame.to_local(pick.direction);
    if (!(wi.z > 0)) return {};
    return contribution(wi, pick.direction, pick.texel->radiance, 1 / pick.texel->pdf_radiance);
  }

  /// One direction of each kind, balance heuristic: each weighs 1 / (sum of both densities). Both directions are drawn
  /// before either texel is read, and each texel is asked for well before it is needed.
  LobeLight by_both(FabricSampler sampler, EnvironmentDensity density, std::uint32_t index) const {
    const EnvironmentPick pick = environment_direction(density, index);
    if (pick.texel) prefetch_texel(pick.texel);
    const std::optional<Vec3> wi = fabric_direction(sampler, index);
    Vec3 world;
    const Environment::Texel* texel = nullptr;
    if (wi) {
      world = point.frame.to_world(*wi);
      texel = &environment_texel(scene.environment, world);
      prefetch_texel(texel);
    }
    LobeLight sum;
    if (pick.texel)
      if (const Vec3 local = point.frame.to_local(pick.direction); local.z > 0)
        add(sum, contribution(local, pick.direction, pick.texel->radiance,
                              1 / (pdf(view, sampler, local) + texel_pdf(*pick.texel, density))));
    if (wi) {
      const float all = pdf(view, sampler, *wi) + texel_pdf(*texel, density);
      add(sum, contribution(*wi, world, texel->radiance, all > 0 ? 1 / all : 0));
    }
    return sum;
  }

  /// Resampled importance sampling (Talbot et al. 2005) over `count` candidates of the table and `count` of the
  /// compensated map, target = table density times radiance, balance weights (cloth-model.md section 6). Unbiased:
  /// the table's floor keeps the target positive wherever the integrand is.
  LobeLight by_resampling(int count, std::uint32_t index) const {
    struct Candidate {
      Vec3 wi, world;
      const Environment::Texel* texel;
      float running;  ///< sum of the weights up to this one
      float target;
    };
    // Filled as far as candidates are found; all directions come first, so that their texels arrive together.
    std::array<Candidate, 2 * most_candidates> kept;
    int n = 0;
    const auto offer = [&](const Vec3& wi, const Vec3& world, const Environment::Texel* texel) {
      prefetch_texel(texel);
      Candidate& c = kept[size_t(n++)];
      c.wi = wi;
      c.world = world;
      c.texel = texel;
    };
    const std::uint32_t first = index * std::uint32_t(count);
    for (int j = 0; j < count; ++j) {
      const EnvironmentPick pick = environment_direction(EnvironmentDensity::compensated, first + std::uint32_t(j));
      if (!pick.texel) continue;
      if (const Vec3 wi = point.frame.to_local(pick.direction); wi.z > 0) offer(wi, pick.direction, pick.texel);
    }
    for (int j = 0; j < count; ++j) {
      const Vec3 wi = *fabric_direction(FabricSampler::table, first + std::uint32_t(j));
      const Vec3 world = point.frame.to_world(wi);
      offer(wi, world, &environment_texel(scene.environment, world));
    }
    float sum = 0;
    for (int i = 0; i < n; ++i) {
      Candidate& c = kept[size_t(i)];
      const float p_table = table_pdf(view.table, c.wi);
      c.target = p_table * brightness(c.texel->radiance);
      const float both = p_table + c.texel->pdf_compensated;
      if (c.target > 0) sum += c.target / (float(count) * both);
      c.running = sum;
    }
    if (!(sum > 0)) return {};
    const float place = float(draw(sequence, Dimension::choice, index)) * sum;
    int chosen = 0;
    while (chosen < n - 1 && kept[size_t(chosen)].running <= place) ++chosen;
    const Candidate& c = kept[size_t(chosen)];
    return c.target > 0 ? contribution(c.wi, c.world, c.texel->radiance, sum / c.target) : LobeLight();
  }
};

}  // namespace

float transmittance(const Scene& scene, const ClothPoint& point, const Vec3& direction, RayCounts& counts) {
  // Above the shading horizon but below the triangle's: the cloth itself is in the way.
  if (dot(direction, point.facing) <= 0) return 0;
  ++counts.shadow;
  Ray ray;
  ray.origin = offset_origin(point.surface, direction);
  ray.direction = direction;
  if (counts.log) counts.log->push_back(ray);
  if (!scene.has_gaps) return scene.rays->occluded(ray) ? 0.0f : 1.0f;

  float passed = 1;
  while (const std::optional<Hit> hit = scene.rays->closest_hit(ray)) {
    const SurfacePoint surface = surface_point(*scene.mesh, *hit);
    const bool back = dot(surface.geometric_normal, direction) > 0;
    passed *= back && scene.back ? scene.back->gap : scene.front.gap;
    if (passed < 1e-6f) return 0;
    ray.origin = offset_origin(surface, direction);
    ++counts.shadow;
  }
  return passed;
}

LobeLight direct_light(const Scene& scene, const ClothPoint& point, const FabricView& view,
                       const LightSettings& settings, Sequence sequence, std::uint32_t index, RayCounts& counts) {
  const Estimator estimate{scene, point, view, sequence, counts};
  switch (settings.strategy) {
    case Strategy::uniform: return estimate.by_fabric(FabricSampler::uniform, index);
    case Strategy::talk: return estimate.by_fabric(FabricSampler::talk, index);
    case Strategy::table: return estimate.by_fabric(FabricSampler::table, index);
    case Strategy::environment: return estimate.by_environment(index);
    case Strategy::mis: return estimate.by_both(FabricSampler::table, EnvironmentDensity::radiance, index);
    case Strategy::mis_compensated:
      return estimate.by_both(FabricSampler::table, EnvironmentDensity::compensated, index);
    case Strategy::mis_talk: return estimate.by_both(FabricSampler::talk, EnvironmentDensity::radiance, index);
    case Strategy::resampled: return estimate.by_resampling(settings.candidates, index);
  }
  return {};
}

}  // namespace sateen
