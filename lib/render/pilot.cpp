#include "render/pilot.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/compare.h"

namespace sateen {

namespace {

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

StrategyTrial try_strategy(const Scene& scene, LightSettings light, Strategy strategy, std::uint32_t seed,
                           int threads) {
  light.strategy = strategy;
  light.bounces = 0;
  const PixelGrid grid;
  const GridPicture picture = trace_picture(scene, light, seed, grid, threads);
  const Cost cost = cost_of(strategy, light.candidates);
  StrategyTrial trial;
  trial.strategy = strategy;
  trial.squared_error = relative_variance(picture);
  trial.cost = cost.camera + (double(picture.work.hits) * (cost.hit + cost.proposals) +
                              double(picture.work.rays.shadow) * cost.shadow) /
                                 (double(grid.pixels()) * grid.samples);
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
                                strategy_name(usual.strategy), PixelGrid().pixels());
  else
    choice.reason = fmt::format("{}: nothing else is better by a tenth at equal time in a pilot of {} pixels",
                                strategy_name(usual.strategy), PixelGrid().pixels());
  return choice;
}

}  // namespace sateen
