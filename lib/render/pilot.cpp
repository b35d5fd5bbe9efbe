#include "render/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/parallel.h"
#include "film/film.h"
#include "integrator/path.h"

namespace sateen {

namespace {

constexpr int columns = 48, rows = 32;  // pixels that are looked at, spread over the picture
constexpr int samples = 64;             // of each; fewer hide what low-discrepancy numbers are worth
constexpr double better_by = 0.9;

// Costs [ns] of a camera ray, a hit, a hit's proposals and a shadow ray with its share of evaluations.
struct Cost {
  double camera = 60, hit = 270, shadow = 390, proposals = 0;
};
Cost cost_of(Strategy strategy, int candidates) {
  Cost cost;
  switch (strategy) {
    case Strategy::table:
      cost.proposals = 90;
      break;
    case Strategy::environment:
      cost.proposals = 30;
      cost.shadow = 320;  // towards the same few lights: their rays run together
      break;
    case Strategy::resampled:
      cost.proposals = 110 + 290 * candidates;
      break;
    default:
      cost.proposals = 220;
      break;
  }
  return cost;
}

/// Sums of a row of pixels; added up in the order of the rows, so that bits do not depend on threads.
struct RowSums {
  double squared_error = 0, hits = 0, shadow = 0;
};

RowSums try_row(const Scene& scene, const LightSettings& light, std::uint32_t seed, int row) {
  const auto scratch = std::make_unique<PathScratch>();
  RowSums sums;
  const int y = std::min(int((row + 0.5) * scene.camera.height / rows), scene.camera.height - 1);
  for (int column = 0; column < columns; ++column) {
    const int x = std::min(int((column + 0.5) * scene.camera.width / columns), scene.camera.width - 1);
    FilmPixel pixel;
    std::array<SampleId, batch_size> ids;
    std::array<CameraSample, batch_size> out;
    static_assert(samples == batch_size);
    for (int k = 0; k < samples; ++k) ids[size_t(k)] = {x, y, k % replicates, std::uint32_t(k / replicates)};
    trace_samples(scene, light, seed, ids, *scratch, out.data());
    for (int k = 0; k < samples; ++k) {
      pixel.beauty[size_t(k % replicates)] += Vec3d(out[size_t(k)].total());
      ++pixel.samples;
      sums.hits += out[size_t(k)].hit;
    }
    const Color mean = pixel_mean(pixel), variance = pixel_variance(pixel);
    for (int c = 0; c < 3; ++c) sums.squared_error += double(variance[c]) / (double(mean[c]) * mean[c] + 0.01);
  }
  sums.shadow = double(scratch->counts.shadow);
  return sums;
}

StrategyTrial try_strategy(const Scene& scene, LightSettings light, Strategy strategy, std::uint32_t seed,
                           int threads) {
  light.strategy = strategy;
  light.bounces = 0;
  std::vector<RowSums> sums(rows);
  parallel_for(rows, threads, [&](int row) { sums[size_t(row)] = try_row(scene, light, seed, row); });
  const Cost cost = cost_of(strategy, light.candidates);
  StrategyTrial trial;
  trial.strategy = strategy;
  constexpr double traced = double(rows) * columns * samples;
  for (const RowSums& row : sums) {
    trial.squared_error += row.squared_error / (3.0 * rows * columns);
    trial.cost += (row.hits * (cost.hit + cost.proposals) + row.shadow * cost.shadow) / traced;
  }
  trial.cost += cost.camera;
  return trial;
}

}  // namespace

StrategyChoice choose_strategy(const Scene& scene, const LightSettings& light, std::uint32_t seed, int threads) {
  StrategyChoice choice;
  for (const Strategy strategy :
       {Strategy::mis_compensated, Strategy::resampled, Strategy::environment, Strategy::table})
    choice.trials.push_back(try_strategy(scene, light, strategy, seed, threads));
  const StrategyTrial& usual = choice.trials.front();
  const StrategyTrial& best = *std::min_element(choice.trials.begin(), choice.trials.end(),
                                                [](const auto& a, const auto& b) { return a.price() < b.price(); });
  const bool changes = best.price() < better_by * usual.price();
  choice.strategy = changes ? best.strategy : usual.strategy;
  if (!(usual.price() > 0))
    choice.reason = fmt::format("{}: the pilot met no noise", strategy_name(usual.strategy));
  else if (changes)
    choice.reason = fmt::format("{}: {:.0f} % of {}'s squared error at equal time in a pilot of {} pixels",
                                strategy_name(best.strategy), 100 * best.price() / usual.price(),
                                strategy_name(usual.strategy), rows * columns);
  else
    choice.reason = fmt::format("{}: nothing else is better by a tenth at equal time in a pilot of {} pixels",
                                strategy_name(usual.strategy), rows * columns);
  return choice;
}

}  // namespace sateen
