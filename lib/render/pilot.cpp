#include "render/pilot.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/compare.h"
#include "render/ray_time.h"

namespace sateen {

namespace {

constexpr double better_by = 0.9;
// The usual strategy gains most from further samples. Of thirty pairs of scene and strategy one fell, from 1.02 to
// 0.93 of its price, between 16 samples and 64; what is dearer by this much at 16 does not win.
constexpr int first_look = 16;
constexpr double hopeless = 1.2;

/// One strategy's picture of the grid, direct light alone.
struct Attempt {
  LightSettings light;
  GridPicture picture = {};

  StrategyTrial trial() const {
    StrategyTrial t;
    t.strategy = light.strategy;
    t.samples = picture.grid.samples;
    t.squared_error = relative_variance(picture);
    t.cost = 1e9 * direct_time(picture.work.rays, light) / (double(picture.grid.pixels()) * picture.grid.samples);
    return t;
  }
};

}  // namespace

StrategyChoice choose_strategy(const Scene& scene, const LightSettings& light, std::uint32_t seed, int threads) {
  std::vector<Attempt> attempts;
  PixelGrid grid;
  const int all_samples = grid.samples;
  grid.samples = first_look;
  // All of them draw from the map. What does not may look quiet because no sample of the pilot met the sun; and under a
  // map without lights mis-compensated is the table alone.
  for (const Strategy strategy : {Strategy::mis_compensated, Strategy::resampled, Strategy::environment}) {
    Attempt attempt{light};
    attempt.light.strategy = strategy;
    attempt.light.bounces = 0;
    attempt.picture = trace_picture(scene, attempt.light, seed, grid, threads);
    attempts.push_back(std::move(attempt));
  }
  const double usual_at_first = attempts.front().trial().price();
  StrategyChoice choice;
  std::vector<StrategyTrial> finished;
  for (Attempt& attempt : attempts) {
    const bool is_usual = finished.empty();
    if (is_usual || attempt.trial().price() < hopeless * usual_at_first) {
      trace_more(attempt.picture, scene, attempt.light, seed, all_samples, threads);
      finished.push_back(attempt.trial());
    }
    choice.trials.push_back(attempt.trial());
  }
  const StrategyTrial& usual = finished.front();
  const StrategyTrial& best = *std::min_element(finished.begin(), finished.end(),
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
