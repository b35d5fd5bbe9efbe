#include "study/study_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sateen {

namespace {
std::set<int> measured_samples(const StudyResult& result, int scene, Strategy strategy) {
  std::set<int> all;
  for (const StudyRun& run : result.runs)
    if (run.scene == scene && run.strategy == strategy) all.insert(run.samples);
  return all;
}

// `mse` gives above and below without a seed; 0 where one was not measured.
Ratio ratio_of(int seeds, const std::function<std::pair<double, double>(int without)>& mse) {
  const auto [above, below] = mse(0);
  if (!(above > 0) || !(below > 0)) return {};
  return {true, jackknife_interval(seeds, [&](int without) {
            const auto [top, bottom] = mse(without);
            return std::log(top / bottom);
          })};
}
}  // namespace

double value_of(const PictureMse& mse, Measure measure) {
  return measure == Measure::relative ? mse.relative : mse.absolute;
}

std::vector<CurvePoint> study_curve(const StudyResult& result, int scene, Strategy strategy, Measure measure) {
  std::vector<CurvePoint> curve;
  for (const int samples : measured_samples(result, scene, strategy)) {
    double cpu = 0;
    int count = 0;
    for (const StudyRun& run : result.runs)
      if (run.scene == scene && run.strategy == strategy && run.samples == samples) cpu += run.cpu_seconds, ++count;
    curve.push_back({samples, cpu / count, jackknife_interval(result.settings.seeds, [&](int without) {
                       return std::log(mse_at_samples(result, scene, strategy, samples, measure, without));
                     })});
  }
  return curve;
}

double mse_at_samples(const StudyResult& result, int scene, Strategy strategy, int samples, Measure measure,
                      int without) {
  double sum = 0;
  int count = 0;
  for (const StudyRun& run : result.runs)
    if (run.scene == scene && run.strategy == strategy && run.samples == samples && run.seed != without)
      sum += value_of(run.mse, measure), ++count;
  return count > 0 ? sum / count : 0;
}

namespace {
/// Median over the seeds; 0 where so many samples were not measured.
double run_time(const StudyResult& result, int scene, Strategy strategy, int samples) {
  std::vector<double> times;
  for (const StudyRun& run : result.runs)
    if (run.scene == scene && run.strategy == strategy && run.samples == samples) times.push_back(run.cpu_seconds);
  if (times.empty()) return 0;
  std::sort(times.begin(), times.end());
  const size_t n = times.size();
  return n % 2 == 1 ? times[n / 2] : (times[n / 2 - 1] + times[n / 2]) / 2;
}
}  // namespace

double samples_at_time(const StudyResult& result, int scene, Strategy strategy, double cpu_seconds) {
  const std::set<int> numbers = measured_samples(result, scene, strategy);
  const auto time = [&](int samples) { return run_time(result, scene, strategy, samples); };
  if (numbers.empty()) return 0;
  if (numbers.size() == 1)
    return time(*numbers.begin()) > 0 ? *numbers.begin() * cpu_seconds / time(*numbers.begin()) : 0;
  auto upper = std::find_if(std::next(numbers.begin()), numbers.end(), [&](int n) { return time(n) >= cpu_seconds; });
  if (upper == numbers.end()) --upper;
  const int high = *upper, low = *std::prev(upper);
  if (!(time(low) > 0) || !(time(high) > time(low))) return 0;
  return low * std::pow(double(high) / low, std::log(cpu_seconds / time(low)) / std::log(time(high) / time(low)));
}

double mse_at_time(const StudyResult& result, int scene, Strategy strategy, double cpu_seconds, Measure measure,
                   int without) {
  const double wanted = samples_at_time(result, scene, strategy, cpu_seconds);
  const std::set<int> numbers = measured_samples(result, scene, strategy);
  if (!(wanted > 0) || numbers.size() < 2) return 0;
  // The two measured numbers about the samples that the time buys; a little beyond the last is still told by them.
  auto upper = numbers.lower_bound(int(std::ceil(wanted)));
  if (upper == numbers.end()) --upper;
  if (upper == numbers.begin()) ++upper;
  const int high = *upper, low = *std::prev(upper);
  const double share = std::log(wanted / low) / std::log(double(high) / low);
  if (share < -0.5 || share > 1.5) return 0;
  return std::exp((1 - share) * std::log(mse_at_samples(result, scene, strategy, low, measure, without)) +
                  share * std::log(mse_at_samples(result, scene, strategy, high, measure, without)));
}

double common_time(const StudyResult& result, int scene) {
  return run_time(result, scene, Strategy::mis_compensated, result.settings.samples);
}

int missing_samples(const StudyResult& result, int scene, Strategy strategy) {
  const std::set<int> numbers = measured_samples(result, scene, strategy);
  const double wanted = samples_at_time(result, scene, strategy, common_time(result, scene));
  if (!(wanted > 0)) return 0;
  if (wanted > *numbers.rbegin() || numbers.size() < 2) return 2 * *numbers.rbegin();
  if (wanted < *numbers.begin() && *numbers.begin() > 1) return *numbers.begin() / 2;
  return 0;
}

Ratio equal_time_ratio(const StudyResult& result, int scene, Strategy above, Strategy below, Measure measure) {
  const double time = common_time(result, scene);
  return ratio_of(result.settings.seeds, [&](int without) {
    return std::pair(mse_at_time(result, scene, above, time, measure, without),
                     mse_at_time(result, scene, below, time, measure, without));
  });
}

Ratio samples_ratio(const StudyResult& result, int scene, Strategy above, int above_samples, Strategy below,
                    int below_samples, Measure measure) {
  return ratio_of(result.settings.seeds, [&](int without) {
    return std::pair(mse_at_samples(result, scene, above, above_samples, measure, without),
                     mse_at_samples(result, scene, below, below_samples, measure, without));
  });
}

Winner scene_winner(const StudyResult& result, int scene, Measure measure) {
  std::vector<std::pair<double, Strategy>> order;
  const double time = common_time(result, scene);
  for (const std::string& name : strategy_names()) {
    const Strategy strategy = strategy_from_name(name);
    const double mse = mse_at_time(result, scene, strategy, time, measure);
    if (mse > 0) order.emplace_back(mse, strategy);
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
    std::vector<int> scenes;
    for (int i = 0; i < int(result.scenes.size()); ++i)
      if (result.scenes[size_t(i)].all_strategies && result.scenes[size_t(i)].finished &&
          mse_at_time(result, i, below, common_time(result, i), Measure::relative) > 0 &&
          mse_at_time(result, i, result.ours, common_time(result, i), Measure::relative) > 0)
        scenes.push_back(i);
    const int count = int(scenes.size());
    if (count == 0) return;
    // The interval holds what the seeds do, not the choice of scenes.
    const Interval found = jackknife_interval(result.settings.seeds, [&](int without) {
      double sum = 0;
      for (const int i : scenes) {
        const double time = common_time(result, i);
        sum += std::log(mse_at_time(result, i, result.ours, time, Measure::relative, without) /
                        mse_at_time(result, i, below, time, Measure::relative, without));
      }
      return sum / count;
    });
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
    for (const Strategy each : {LightSettings().strategy, Strategy::table}) {
      const Ratio ratio = samples_ratio(result, i, each, n, Strategy::uniform, n, Measure::relative);
      if (!ratio.known) continue;
      bars.push_back({fmt::format("{} over uniform, {} samples each, {} in constant white light", strategy_name(each),
                                  n, s.look),
                      0.06, ratio.interval, ratio.interval.value <= 0.06});
    }
  }
  return bars;
}

}  // namespace sateen
