#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/quality.h"
#include "study/cost.h"

namespace sateen {

namespace {

// Below a thousandth of E and one code value nobody sees a difference.
constexpr double unseen_error = 0.001, unseen_code = 1;

int enough_of(const PriceList& list) {
  const int count = int(list.prices.size());
  if (list.biased) {
    for (int i = 0; i < count; ++i)
      if (const Bias& b = list.prices[size_t(i)].bias;
          b.error.value <= 0 || (b.visible < unseen_code && (b.error.value < unseen_error || b.error.low <= 0)))
        return i;
    return count - 1;
  }
  int best = 0;
  const auto price = [&](int i) {
    return std::pow(list.prices[size_t(i)].noise, 2) * list.prices[size_t(i)].cpu_seconds;
  };
  for (int i = 1; i < count; ++i)
    if (price(i) < price(best)) best = i;
  return best;
}

int asked_of(const PriceList& list) {
  for (size_t i = 0; i < list.prices.size(); ++i)
    if (list.prices[i].setting.find("(asked)") != std::string::npos) return int(i);
  return -1;
}

// Times scatter by some percent: a coarser setting that saves no more than that is chosen by chance, and so is a
// finer one where nothing is known to be wrong with what was asked for.
constexpr double least_saving = 0.05;
bool worth_trying(const PriceList& list, size_t setting) {
  const int asked = asked_of(list);
  if (!list.biased || asked < 0 || int(setting) == asked) return true;
  const Price &coarse = list.prices[setting], &own = list.prices[size_t(asked)];
  if (int(setting) > asked) return own.bias.error.low > 0;
  return coarse.cpu_seconds + coarse.setup_seconds < (1 - least_saving) * (own.cpu_seconds + own.setup_seconds);
}

// CPU-seconds of the picture at a number of samples, by the straight line in logarithms between the two measured
// about it: few samples of a pixel are dearer each.
double seconds_at(const std::vector<CostPoint>& points, double samples) {
  const CostPoint& last = points.back();
  if (samples >= last.samples) return last.cpu_seconds * samples / last.samples;
  size_t i = 1;
  while (i + 1 < points.size() && points[i].samples < samples) ++i;
  const CostPoint &low = points[i - 1], &high = points[i];
  const double share = std::log(samples / low.samples) / std::log(double(high.samples) / low.samples);
  return std::exp((1 - share) * std::log(low.cpu_seconds) + share * std::log(high.cpu_seconds));
}

// One setting of every list, with what it does to the whole: factors of time and noise over the measured base, bias.
struct Combination {
  std::vector<int> chosen;
  double time = 1, noise = 1, bias = 0, setup = 0;
};

// Settings are taken to act independently: times and noise multiply, squares of bias add.
std::vector<Combination> combinations(const CostResult& result) {
  std::vector<Combination> all{{}};
  for (const PriceList& list : result.lists) {
    if (!list.advised) {
      for (Combination& c : all) c.chosen.push_back(-1);
      continue;
    }
    std::vector<Combination> next;
    const Price& fine = list.prices.back();
    for (const Combination& c : all)
      for (size_t i = 0; i < list.prices.size(); ++i) {
        if (!worth_trying(list, i)) continue;
        const Price& p = list.prices[i];
        Combination with = c;
        with.chosen.push_back(int(i));
        with.time *= p.cpu_seconds / fine.cpu_seconds;
        with.noise *= list.biased ? 1 : p.noise / fine.noise;
        if (list.biased) with.bias = std::hypot(with.bias, p.bias.error.value);
        with.setup += p.setup_seconds;
        next.push_back(std::move(with));
      }
    all = std::move(next);
  }
  return all;
}

}  // namespace

double seconds_for_error(const CostResult& result, double error) {
  if (!result.fit.known || result.fit.slope >= 0) return 0;
  return std::pow(error / result.fit.factor, 1 / result.fit.slope);
}

void settle_advice(CostResult& result) {
  for (PriceList& list : result.lists) list.enough = enough_of(list);
  result.qualities.clear();
  result.frontier.clear();
  if (result.lists.empty() || result.points.size() < 2) return;
  // A combination of the finest settings costs what the finest of every list cost beside the base that was rendered.
  std::vector<PlotPoint> curve;
  for (const CostPoint& p : result.points) curve.push_back({double(p.samples), p.true_error.value});
  const PowerFit noise = fit_power(curve);
  if (!noise.known || noise.slope >= 0) return;
  double base_time = 1, base_noise = 1;
  for (const PriceList& list : result.lists) {
    if (!list.advised) continue;
    if (asked_of(list) < 0) continue;
    const Price &fine = list.prices.back(), &used = list.prices[size_t(asked_of(list))];
    base_time *= fine.cpu_seconds / used.cpu_seconds;
    if (!list.biased) base_noise *= fine.noise / used.noise;
  }
  const std::vector<Combination> all = combinations(result);
  const auto best = [&](double target) {
    Quality found;
    found.target = target;
    for (const Combination& c : all) {
      if (c.bias >= target * 0.9) continue;
      const double wanted = std::sqrt(target * target - c.bias * c.bias);
      const double exact = std::pow(wanted / (noise.factor * base_noise * c.noise), 1 / noise.slope);
      if (!(exact < 1e6)) continue;
      const int samples = std::max(replicates, int(std::ceil(exact / replicates)) * replicates);
      const double seconds = seconds_at(result.points, samples) * base_time * c.time + c.setup;
      if (found.reached && seconds >= found.cpu_seconds) continue;
      found.reached = true;
      found.samples = samples;
      found.chosen = c.chosen;
      found.cpu_seconds = seconds;
      found.bias = c.bias;
      found.noise = noise.factor * base_noise * c.noise * std::pow(samples, noise.slope);
    }
    return found;
  };
  for (const NamedQuality& each : named_qualities) {
    Quality quality = best(each.error);
    quality.name = each.name;
    if (quality.reached) {
      quality.flags = fmt::format("--spp {}", quality.samples);
      for (size_t i = 0; i < quality.chosen.size(); ++i) {
        if (quality.chosen[i] < 0) continue;
        for (const std::string& flag : result.lists[i].prices[size_t(quality.chosen[i])].flags)
          quality.flags += " " + flag;
      }
    }
    result.qualities.push_back(quality);
  }
  for (double target = 0.2; target > 0.004; target *= 0.8)
    if (const Quality q = best(target); q.reached)
      result.frontier.push_back({q.cpu_seconds, std::hypot(q.noise, q.bias)});
}

}  // namespace sateen
