#include "render/plan_pilot.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "render/effects.h"
#include "render/loss.h"
#include "render/pixel_grid.h"
#include "render/ray_time.h"

namespace sateen {

namespace {

constexpr int pilot_samples = 16;
constexpr float least_share = 1.0f / 16;  // fewer leave speckles in a picture of few samples

/// One picture of the grid for each part that is told apart.
struct Parts {
  std::vector<PixelLoss> weft, surface, volume, back, through_gaps, backdrop;
  std::array<std::vector<PixelLoss>, tracked_bounces> after;
  // What a pixel adds to E^2 at the pilot's samples: by direct light, by bounces that every sample follows, and by
  // their squares and squared mean alone.
  std::vector<double> direct_noise, indirect_noise, indirect_square, indirect_mean;
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
  light.bounces = bounces;
  light.bounce_share = 1;
  PixelGrid grid;
  grid.samples = pilot_samples;
  Parts parts;
  for (auto* picture :
       {&parts.weft, &parts.surface, &parts.volume, &parts.back, &parts.through_gaps, &parts.backdrop})
    picture->resize(size_t(grid.pixels()));
  for (auto& picture : parts.after) picture.resize(size_t(grid.pixels()));
  for (auto* numbers : {&parts.direct_noise, &parts.indirect_noise, &parts.indirect_square, &parts.indirect_mean})
    numbers->resize(size_t(grid.pixels()));

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
        FilmPixel direct, bounced;
        Vec3d squares(0), mean(0);
        const auto count = double(samples.size());
        for (size_t k = 0; k < samples.size(); ++k) {
          const Vec3d indirect(samples[k].indirect.total());
          direct.beauty[k % replicates] += Vec3d(samples[k].total()) - indirect;
          bounced.beauty[k % replicates] += indirect;
          ++direct.samples;
          ++bounced.samples;
          squares += indirect * indirect / (count * count);
          mean += indirect / count;
        }
        const auto pixel_number = size_t(pixel);
        parts.direct_noise[pixel_number] = relative_square(Vec3d(pixel_variance(direct)), value);
        parts.indirect_noise[pixel_number] = relative_square(Vec3d(pixel_variance(bounced)), value);
        parts.indirect_square[pixel_number] = relative_square(squares, value);
        parts.indirect_mean[pixel_number] = relative_square(mean * mean / count, value);
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

  const double direct = direct_time(work.rays, light), bounced = bounce_time(work.rays, light);
  pilot.bounce_cost = direct > 0 ? bounced / direct : 0;
  const auto sum = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
  };
  const double noise = sum(parts.direct_noise), whole = sum(parts.indirect_noise);
  const double square = sum(parts.indirect_square), mean = sum(parts.indirect_mean);
  double least = 0;
  for (float share = 1; share >= least_share; share /= 2) {
    // A share of the samples keeps nothing of the sequences' evenness.
    const double indirect = share < 1 ? std::max(square / double(share) - mean, whole) : whole;
    const double price = (noise + indirect) * (direct + bounced * double(share));
    if (share < 1 && price >= least) continue;
    least = price;
    pilot.bounce_share = share;
  }
  return pilot;
}

}  // namespace sateen
