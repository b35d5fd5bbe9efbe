#include "study/study_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sateen {

namespace {
const StudyRun* find_run(const StudyResult& result, int scene, Strategy strategy, int samples, int seed) {
  for (const StudyRun& run : result.runs)
    if (run.scene == scene && run.strategy == strategy && run.samples == samples && run.seed == seed) return &run;
  return nullptr;
}

std::set<int> measured_samples(const StudyResult& result, int scene, Strategy strategy) {
  std::set<int> all;
  for (const StudyRun& run : result.runs)
    if (run.scene == scene && run.strategy == strategy) all.insert(run.samples);
  return all;
}

Ratio ratio_of(const std::vector<double>& above, const std::vector<double>& below) {
  Ratio ratio;
  if (above.empty() || above.size() != below.size()) return ratio;
  for (size_t i = 0; i < above.size(); ++i) ratio.by_seed.push_back(above[i] / below[i]);
  ratio.known = true;
  ratio.interval = geometric_interval(ratio.by_seed);
  return ratio;
}
}  // namespace

double value_of(const PictureMse& mse, Measure measure) {
  return measure == Measure::relative ? mse.relative : mse.absolute;
}

std::vector<CurvePoint> study_curve(const StudyResult& result, int scene, Strategy strategy, Measure measure) {
  std::vector<CurvePoint> curve;
  for (const int samples : measured_samples(result, scene, strategy)) {
    std::vector<double> values;
    double cpu = 0;
    for (const StudyRun& run : result.runs)
      if (run.scene == scene && run.strategy == strategy && run.samples == samples) {
        values.push_back(value_of(run.mse, measure));
        cpu += run.cpu_seconds;
      }
    curve.push_back({samples, cpu / double(values.size()), geometric_interval(values)});
  }
  return curve;
}

double sample_price(const StudyResult& result, int scene, Strategy strategy) {
  std::vector<double> prices;
  for (const StudyRun& run : result.runs)
    if (run.scene == scene && run.strategy == strategy) prices.push_back(run.cpu_seconds / run.samples);
  if (prices.empty()) return 0;
  std::sort(prices.begin(), prices.end());
  const size_t n = prices.size();
  return n % 2 == 1 ? prices[n / 2] : (prices[n / 2 - 1] + prices[n / 2]) / 2;
}

std::vector<double> mse_at_time(const StudyResult& result, int scene, Strategy strategy, double cpu_seconds,
                                Measure measure) {
  const double price = sample_price(result, scene, strategy);
  const std::set<int> numbers = measured_samples(result, scene, strategy);
  if (price <= 0 || numbers.size() < 2) return {};
  // The two measured numbers about the samples that the time buys; a little beyond the last is still told by them.
  const double wanted = cpu_seconds / price;
  auto upper = numbers.lower_bound(int(std::ceil(wanted)));
  if (upper == numbers.end()) --upper;
  if (upper == numbers.begin()) ++upper;
  const int high = *upper, low = *std::prev(upper);
  const double share = std::log(wanted / low) / std::log(double(high) / low);
  if (share < -0.5 || share > 1.5) return {};
  std::vector<double> values;
  for (int seed = 1; seed <= result.settings.seeds; ++seed) {
    const StudyRun *a = find_run(result, scene, strategy, low, seed), *b = find_run(result, scene, strategy, high, seed);
    if (!a || !b) return {};
    values.push_back(std::exp((1 - share) * std::log(value_of(a->mse, measure)) +
                              share * std::log(value_of(b->mse, measure))));
  }
  return values;
}

double common_time(const StudyResult& result, int scene) {
  return sample_price(result, scene, result.ours) * result.settings.samples;
}

Ratio equal_time_ratio(const StudyResult& result, int scene, Strategy above, Strategy below, Measure measure) {
  const double time = common_time(result, scene);
  return ratio_of(mse_at_time(result, scene, above, time, measure), mse_at_time(result, scene, below, time, measure));
}

Ratio samples_ratio(const StudyResult& result, int scene, Strategy above, int above_samples, Strategy below,
                    int below_samples, Measure measure) {
  std::vector<double> top, bottom;
  for (int seed = 1; seed <= result.settings.seeds; ++seed) {
    const StudyRun* a = find_run(result, scene, above, above_samples, seed);
    const StudyRun* b = find_run(result, scene, below, below_samples, seed);
    if (!a || !b) return {};
    top.push_back(value_of(a->mse, measure));
    bottom.push_back(value_of(b->mse, measure));
  }
  return ratio_of(top, bottom);
}

Winner scene_winner(const StudyResult& result, int scene, Measure measure) {
  std::vector<std::pair<double, Strategy>> order;
  const double time = common_time(result, scene);
  for (const std::string& name : strategy_names()) {
    const Strategy strategy = strategy_from_name(name);
    const std::vector<double> values = mse_at_time(result, scene, strategy, time, measure);
    if (!values.empty()) order.emplace_back(geometric_interval(values).value, strategy);
  }
  std::sort(order.begin(), order.end());
  Winner winner;
  if (order.size() < 2) return winner;
  winner.known = true;
  winner.strategy = order[0].second;
  winner.second = order[1].second;
  winner.clear = equal_time_ratio(result, scene, winner.strategy, winner.second, measure).interval.high < 1;
  return winner;
}

std::vector<Bar> study_bars(const StudyResult& result) {
  std::vector<Bar> bars;
  const std::string ours = strategy_name(result.ours);
  const auto equal_time = [&](Strategy below, const std::string& text, double limit) {
    // Every seed has its own geometric mean over the scenes: the interval holds what the seeds do, not the choice of
    // scenes.
    std::vector<double> by_seed(size_t(result.settings.seeds), 0.0);
    int count = 0;
    for (int i = 0; i < int(result.scenes.size()); ++i) {
      if (!result.scenes[size_t(i)].all_strategies || !result.scenes[size_t(i)].finished) continue;
      const Ratio ratio = equal_time_ratio(result, i, result.ours, below, Measure::relative);
      if (!ratio.known) continue;
      ++count;
      for (size_t k = 0; k < by_seed.size(); ++k) by_seed[k] += std::log(ratio.by_seed[k]);
    }
    if (count == 0) return;
    for (double& v : by_seed) v = std::exp(v / count);
    const Interval found = geometric_interval(by_seed);
    bars.push_back({fmt::format("{} over {}, equal CPU time, geometric mean of {} scene{}", ours, text, count,
                                count == 1 ? "" : "s"),
                    limit, found, found.value <= limit});
  };
  equal_time(Strategy::uniform, "uniform", 0.01);
  equal_time(Strategy::mis_talk, "mis-talk (the talk's sampler and the map)", 0.15);
  equal_time(Strategy::mis, "mis (table and map)", 0.35);
  for (int i = 0; i < int(result.scenes.size()); ++i) {
    const StudyScene& s = result.scenes[size_t(i)];
    if (s.light != white_light || s.bounces > 0 || !s.finished) continue;
    const int n = result.settings.samples;
    const Ratio ratio = samples_ratio(result, i, Strategy::table, n, Strategy::uniform, n, Measure::relative);
    if (!ratio.known) continue;
    bars.push_back({fmt::format("table over uniform, {} samples each, {} in constant white light", n, s.look), 0.06,
                    ratio.interval, ratio.interval.value <= 0.06});
  }
  return bars;
}

}  // namespace sateen
