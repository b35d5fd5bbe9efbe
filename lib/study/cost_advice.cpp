#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
          b.visible < unseen_code && (b.error.value < unseen_error || b.error.low <= 0))
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
        const Price& p = list.prices[i];
        Combination with = c;
        with.chosen.push_back(int(i));
        with.time *= p.cpu_seconds / fine.cpu_seconds;
        with.noise *= list.biased ? 1 : p.noise / fine.noise;
        with.bias = std::hypot(with.bias, p.bias.error.value);
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
  const double second_per_sample = result.points.back().cpu_seconds / result.points.back().samples;
  double base_time = 1, base_noise = 1;
  for (const PriceList& list : result.lists) {
    if (!list.advised) continue;
    const auto used = std::find_if(list.prices.begin(), list.prices.end(),
                                   [&](const Price& p) { return p.setting.find("(asked)") != std::string::npos; });
    if (used == list.prices.end()) continue;
    base_time *= list.prices.back().cpu_seconds / used->cpu_seconds;
    if (!list.biased) base_noise *= list.prices.back().noise / used->noise;
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
      const double seconds = samples * second_per_sample * base_time * c.time + c.setup;
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
  struct Named {
    const char* name;
    double target;
  };
  // By eye on the shipped looks: noise stands out above 10 %, can be worked with at 4 %, and is gone at 1 %.
  for (const Named& each : {Named{"draft", 0.10}, Named{"preview", 0.04}, Named{"final", 0.01}}) {
    Quality quality = best(each.target);
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
