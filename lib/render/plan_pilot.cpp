#include "render/plan_pilot.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "render/ray_time.h"

namespace sateen {

namespace {

constexpr int pilot_samples = 16;
constexpr int most_samples = 4 * pilot_samples;  // where the first do not tell
constexpr float least_share = 1.0f / 16;         // fewer leave speckles in a picture of few samples

/// One picture of the grid for each part that is told apart.
struct Parts {
  std::vector<PixelLoss> weft, surface, volume, back, through_gaps, backdrop;
  std::array<std::vector<PixelLoss>, tracked_bounces> after;
  // What a pixel adds to E^2 at the pilot's samples: by direct light, by bounces that every sample follows, and by
  // their squares and squared mean alone.
  std::vector<double> direct_noise, indirect_noise, indirect_square, indirect_mean;
};

/// Light of one bounce, of the first layer and of those seen through its gaps.
Color bounced_light(const CameraSample& sample, int bounce) {
  return sample.indirect.bounce[bounce] + sample.bounced_behind.bounce[bounce];
}

void add(std::vector<PixelLoss>& picture, int pixel, size_t replicate, const Color& light) {
  picture[size_t(pixel)].lost[replicate] += Vec3d(light);
}

}  // namespace

PlanPilot run_plan_pilot(const Scene& scene, const LightSettings& asked, double error_floor, int bounces,
                         std::uint32_t seed, int threads) {
  PlanPilot pilot;
  pilot.light = asked;
  pilot.light.bounces = bounces;
  pilot.light.bounce_share = 1;
  pilot.seed = seed;
  pilot.error_floor = error_floor;
  const LightSettings& light = pilot.light;
  PixelGrid grid = grid_of(scene.camera);
  grid.samples = pilot_samples;
  Parts parts;
  for (auto* picture :
       {&parts.weft, &parts.surface, &parts.volume, &parts.back, &parts.through_gaps, &parts.backdrop})
    picture->resize(size_t(grid.pixels()));
  for (auto& picture : parts.after) picture.resize(size_t(grid.pixels()));
  for (auto* numbers : {&parts.direct_noise, &parts.indirect_noise, &parts.indirect_square, &parts.indirect_mean})
    numbers->resize(size_t(grid.pixels()));

  GridPicture& whole = pilot.whole = blank_picture(scene, grid);
  whole.work = trace_grid(scene, light, seed, grid, threads, [&](int pixel, std::span<const CameraSample> samples) {
    constexpr float part = float(replicates) / pilot_samples;  // a replicate's mean
    Vec3d value(0);
    double alpha = 0;
    for (size_t k = 0; k < samples.size(); ++k) {
      const CameraSample& s = samples[k];
      add_sample(whole.pixels[size_t(pixel)], s.total(), s.coverage, no_grain);
      alpha += double(s.coverage) / double(samples.size());
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
        left += bounced_light(s, b) * part;
        add(parts.after[size_t(b)], pixel, r, left);
      }
    }
    FilmPixel direct, bounced;
    Vec3d squares(0), mean(0);
    const auto count = double(samples.size());
    for (size_t k = 0; k < samples.size(); ++k) {
      const Vec3d indirect(samples[k].indirect.total() + samples[k].bounced_behind.total());
      direct.beauty[k % replicates] += Vec3d(samples[k].total()) - indirect;
      bounced.beauty[k % replicates] += indirect;
      ++direct.samples;
      ++bounced.samples;
      squares += indirect * indirect / (count * count);
      mean += indirect / count;
    }
    const auto pixel_number = size_t(pixel);
    const auto weighed = [&](const Vec3d& square) { return alpha * relative_square(square, value, error_floor); };
    parts.direct_noise[pixel_number] = weighed(Vec3d(pixel_variance(direct)));
    parts.indirect_noise[pixel_number] = weighed(Vec3d(pixel_variance(bounced)));
    parts.indirect_square[pixel_number] = weighed(squares);
    parts.indirect_mean[pixel_number] = weighed(mean * mean / count);
    for (auto* picture :
         {&parts.weft, &parts.surface, &parts.volume, &parts.back, &parts.through_gaps, &parts.backdrop})
      (*picture)[pixel_number].value = value;
    for (auto& picture : parts.after) {
      picture[pixel_number].value = value;
      picture[pixel_number].weight = alpha;
    }
  });

  pilot.weft = light_share(parts.weft);
  pilot.surface = light_share(parts.surface);
  pilot.volume = light_share(parts.volume);
  if (scene.back) pilot.back = light_share(parts.back);
  if (scene.has_gaps) pilot.through_gaps = light_share(parts.through_gaps);
  if (scene.backdrop != Backdrop::none) pilot.backdrop = light_share(parts.backdrop);
  if (bounces == 0) return pilot;
  pilot.indirect = light_share(parts.after[0]);
  for (size_t b = 0; b < parts.after.size(); ++b) pilot.lost_after[b] = picture_loss(parts.after[b], error_floor);

  const double direct = direct_time(whole.work.rays, light), bounced = bounce_time(whole.work.rays, light);
  pilot.bounce_cost = direct > 0 ? bounced / direct : 0;
  const auto sum = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  const double noise = sum(parts.direct_noise), followed = sum(parts.indirect_noise);
  const double square = sum(parts.indirect_square), mean = sum(parts.indirect_mean);
  double least = 0;
  for (float share = 1; share >= least_share; share /= 2) {
    // A share of the samples keeps nothing of the sequences' evenness.
    const double indirect = share < 1 ? std::max(square / double(share) - mean, followed) : followed;
    const double price = (noise + indirect) * (direct + bounced * double(share));
    if (share < 1 && price >= least) continue;
    least = price;
    pilot.bounce_share = share;
  }
  return pilot;
}

Removal remove_and_compare(const Scene& scene, Effect effect, double allowed, int threads, PlanPilot& pilot) {
  Scene without = scene;
  LightSettings light = pilot.light;
  remove_effect(effect, without, light);
  const double floor = pilot.error_floor;
  GridPicture less = trace_picture(without, light, pilot.seed, pilot.whole.grid, threads);
  Removal removal;
  for (;;) {
    removal.loss = picture_loss(differences(less, pilot.whole, floor), floor);
    const bool sure = removal.loss.high <= allowed || removal.loss.low > allowed;
    if (sure || pilot.whole.grid.samples >= most_samples) break;
    const int samples = 2 * pilot.whole.grid.samples;
    trace_more(pilot.whole, scene, pilot.light, pilot.seed, samples, threads);
    trace_more(less, without, light, pilot.seed, samples, threads);
  }
  removal.share = light_share(differences(less, pilot.whole, 0));
  const auto time = [](const Scene& of, const RayCounts& rays, const LightSettings& by) {
    return direct_time(rays, by) + bounce_time(rays, by) + (of.has_gaps ? gap_time(rays) : 0);
  };
  const double rest = direct_time(less.work.rays, light) + (without.has_gaps ? gap_time(less.work.rays) : 0);
  if (rest > 0)
    removal.saves = (time(scene, pilot.whole.work.rays, pilot.light) - time(without, less.work.rays, light)) / rest;
  return removal;
}

}  // namespace sateen
