#include "render/plan_pilot.h"

#include <cmath>
#include <vector>

#include "render/effects.h"
#include "render/loss.h"
#include "render/pixel_grid.h"

namespace sateen {

namespace {

constexpr int pilot_samples = 16;
constexpr float least_share = 1.0f / 16;  // fewer leave speckles in a picture of few samples

// Costs [ns] of a camera ray, of a hit beside its shadow rays, of a shadow ray with its share of evaluations, of a
// ray that follows a bounce, and of a shadow ray where it ends, which runs alone. Measured on drapes and garments.
constexpr double camera_cost = 60, hit_cost = 490, shadow_cost = 390, bounce_cost = 700, lone_shadow_cost = 900;

/// One picture of the grid for each part that is told apart.
struct Parts {
  std::vector<PixelLoss> weft, surface, volume, back, through_gaps, backdrop;
  std::array<std::vector<PixelLoss>, tracked_bounces> after;
  std::vector<double> direct_noise, indirect_square;  ///< what a pixel adds to E^2 at the pilot's samples
};

/// Of the mean of a pixel's samples, relative as in E.
double relative_square(const Vec3d& square, const Vec3d& value) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += square[c] / (3 * (value[c] * value[c] + 0.01));
  return sum;
}

void add(std::vector<PixelLoss>& picture, int pixel, size_t replicate, const Color& light) {
  picture[size_t(pixel)].lost[replicate] += Vec3d(light);
}

}  // namespace

PlanPilot run_plan_pilot(const Scene& scene, const LightSettings& asked, int bounces, std::uint32_t seed,
                         int threads) {
  LightSettings light = asked;
  if (light.strategy == Strategy::automatic) light.strategy = Strategy::mis_compensated;
  light.bounces = bounces;
  light.bounce_share = 1;
  PixelGrid grid;
  grid.samples = pilot_samples;
  Parts parts;
  for (auto* picture :
       {&parts.weft, &parts.surface, &parts.volume, &parts.back, &parts.through_gaps, &parts.backdrop})
    picture->resize(size_t(grid.pixels()));
  for (auto& picture : parts.after) picture.resize(size_t(grid.pixels()));
  parts.direct_noise.resize(size_t(grid.pixels()));
  parts.indirect_square.resize(size_t(grid.pixels()));

  const GridWork work =
      trace_grid(scene, light, seed, grid, threads, [&](int pixel, std::span<const CameraSample> samples) {
        constexpr float part = float(replicates) / pilot_samples;  // a replicate's mean
        Vec3d value(0);
        for (size_t k = 0; k < samples.size(); ++k) {
          const CameraSample& s = samples[k];
          const size_t r = k % replicates;
          value += Vec3d(s.total() * part) / double(replicates);
          add(parts.weft, pixel, r, (s.direct.surface[1] + s.direct.volume[1]) * part);
          add(parts.surface, pixel, r, (s.direct.surface[0] + s.direct.surface[1]) * part);
          add(parts.volume, pixel, r, (s.direct.volume[0] + s.direct.volume[1]) * part);
          if (s.back) add(parts.back, pixel, r, (s.direct.total() + s.indirect.total()) * part);
          add(parts.through_gaps, pixel, r, s.through_gaps * part);
          add(parts.backdrop, pixel, r, s.backdrop * part);
          Color left(0);
          for (int b = tracked_bounces - 1; b >= 0; --b) {
            left += s.indirect.bounce[b] * part;
            add(parts.after[size_t(b)], pixel, r, left);
          }
        }
        FilmPixel direct;
        Vec3d squares(0);
        for (size_t k = 0; k < samples.size(); ++k) {
          const Vec3d indirect(samples[k].indirect.total());
          direct.beauty[k % replicates] += Vec3d(samples[k].total()) - indirect;
          ++direct.samples;
          squares += indirect * indirect / double(samples.size() * samples.size());
        }
        parts.direct_noise[size_t(pixel)] = relative_square(Vec3d(pixel_variance(direct)), value);
        parts.indirect_square[size_t(pixel)] = relative_square(squares, value);
        for (auto* picture :
             {&parts.weft, &parts.surface, &parts.volume, &parts.back, &parts.through_gaps, &parts.backdrop})
          (*picture)[size_t(pixel)].value = value;
        for (auto& picture : parts.after) picture[size_t(pixel)].value = value;
      });

  PlanPilot pilot;
  pilot.weft = light_share(parts.weft);
  pilot.surface = light_share(parts.surface);
  pilot.volume = light_share(parts.volume);
  if (scene.back) pilot.back = light_share(parts.back);
  if (scene.has_gaps) pilot.through_gaps = light_share(parts.through_gaps);
  if (scene.backdrop != Backdrop::none) pilot.backdrop = light_share(parts.backdrop);
  if (bounces == 0) return pilot;
  pilot.indirect = light_share(parts.after[0]);
  for (size_t b = 0; b < parts.after.size(); ++b) pilot.lost_after[b] = picture_loss(parts.after[b]);

  LightSettings direct = light;
  direct.bounces = 0;
  const RayCounts alone = trace_grid(scene, direct, seed, grid, threads, [](int, auto) {}).rays;
  pilot.bounce_cost =
      (double(work.rays.bounce) * bounce_cost + double(work.rays.shadow - alone.shadow) * lone_shadow_cost) /
      (double(alone.camera) * camera_cost + double(work.hits) * hit_cost + double(alone.shadow) * shadow_cost);
  // Error squared times time, (direct + indirect / share) (1 + cost share), is least at the root of this. The squares
  // stand for the variance of indirect light: a share of the samples leaves little of the sequences' evenness.
  double noise = 0, square = 0;
  for (size_t i = 0; i < parts.direct_noise.size(); ++i) {
    noise += parts.direct_noise[i];
    square += parts.indirect_square[i];
  }
  const double best = noise * pilot.bounce_cost > 0 ? std::sqrt(square / (noise * pilot.bounce_cost)) : 1;
  pilot.bounce_share = least_share;
  while (pilot.bounce_share < 1 && double(pilot.bounce_share) * std::sqrt(2.0) < best) pilot.bounce_share *= 2;
  return pilot;
}

}  // namespace sateen
