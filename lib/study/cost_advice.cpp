#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/quality.h"
#include "study/cost.h"

namespace sateen {

namespace {

// Below a thousandth of E and one code value nobody sees a difference.
constexpr double unseen_error = 0.001, unseen_code = 1;

double noise_squared_time(const Price& p) {
  return p.noise_factor.value * p.noise_factor.value * p.time_factor.value;
}

int enough_of(const PriceList& list) {
  const int count = int(list.prices.size());
  if (list.biased) {
    for (int i = 0; i < count; ++i)
      if (const Bias& b = list.prices[size_t(i)].bias;
          b.error.value <= 0 || (b.visible < unseen_code && (b.error.value < unseen_error || b.error.low <= 0)))
        return i;
    return count - 1;
  }
  int best = std::max(list.asked(), 0);
  for (int i = 0; i < count; ++i) {
    // The highest that this setting may cost against the other as it is: a lead within chance is none.
    const Price &p = list.prices[size_t(i)], &held = list.prices[size_t(best)];
    if (p.noise_factor.high * p.noise_factor.high * p.time_factor.high < noise_squared_time(held)) best = i;
  }
  return best;
}

// A saving that is smaller is not worth a flag, however well it is known.
constexpr double least_saving = 0.1;
// Bias may be so much of E: beyond it noise would have to vanish.
constexpr double most_bias = 0.9;
constexpr double most_samples = 1e6;

// E by noise at a number of samples of the settings as asked: straight lines in logarithms between what was measured,
// and on along their mean slope.
struct NoiseCurve {
  const std::vector<CostPoint>& points;
  double slope = 0;

  double samples_for(double noise) const {
    const auto at = [&](size_t i) { return points[i].noise.value; };
    size_t i = 1;
    while (i + 1 < points.size() && at(i) > noise) ++i;
    if (noise > at(0) || noise < at(points.size() - 1)) {
      const CostPoint& end = noise > at(0) ? points.front() : points.back();
      return end.samples * std::pow(noise / end.noise.value, 1 / slope);
    }
    const double part = std::log(noise / at(i - 1)) / std::log(at(i) / at(i - 1));
    return points[i - 1].samples * std::pow(double(points[i].samples) / points[i - 1].samples, part);
  }
  double noise_at(double samples) const {
    const CostPoint *low = &points.front(), *high = nullptr;
    for (const CostPoint& p : points) {
      if (p.samples <= samples) low = &p;
      if (p.samples > samples && !high) high = &p;
    }
    if (!high || low->samples > samples) return low->noise.value * std::pow(samples / low->samples, slope);
    const double part = std::log(samples / low->samples) / std::log(double(high->samples) / low->samples);
    return low->noise.value * std::pow(high->noise.value / low->noise.value, part);
  }
};

struct Forecast : Quality {
  double compared_seconds = 0;
};

class Advisor {
 public:
  explicit Advisor(const CostResult& result) : result_(result), curve_{result.points, 0} {
    std::vector<PlotPoint> noise;
    for (const CostPoint& p : result.points) noise.push_back({double(p.samples), p.noise.value});
    const PowerFit fit = fit_power(noise);
    known_ = fit.known && fit.slope < 0;
    curve_.slope = fit.slope;
    for (const PriceList& list : result.lists) asked_.push_back(list.advised ? list.asked() : -1);
  }
  bool known() const { return known_; }
  const std::vector<int>& asked() const { return asked_; }

  double bias_of(const std::vector<int>& chosen) const {
    double squares = 0;
    for (size_t i = 0; i < chosen.size(); ++i)
      if (const Price* p = price(i, chosen[i]); p && result_.lists[i].biased)
        squares += p->bias.error.value * p->bias.error.value;
    return std::sqrt(squares);
  }

  /// The least samples that reach `target`, and at most `most`; not reached where there are none. `doubted`: a list
  /// of whose setting the high ends are believed.
  Forecast forecast(const std::vector<int>& chosen, double target, int most, int doubted = -1,
                    double Interval::*end = &Interval::high) const {
    Forecast q;
    q.target = target;
    q.chosen = chosen;
    double time = 1, noise = 1, bias2 = 0, start = result_.start.seconds();
    for (size_t i = 0; i < chosen.size(); ++i) {
      const Price* p = price(i, chosen[i]);
      if (!p) continue;
      double Interval::*believed = int(i) == doubted ? end : &Interval::value;
      time *= p->time_factor.*believed;
      noise *= p->noise_factor.*believed;
      if (result_.lists[i].biased) bias2 += std::pow(p->bias.error.*believed, 2);
      if (asked_[i] >= 0) start += p->start_seconds - price(i, asked_[i])->start_seconds;
    }
    q.bias = std::sqrt(bias2);
    if (q.bias >= most_bias * target) return q;
    const double exact = curve_.samples_for(std::sqrt(target * target - bias2) / noise);
    if (!(exact <= most_samples)) return q;
    q.samples = std::max(replicates, int(std::ceil(exact / replicates - 1e-9)) * replicates);
    q.reached = q.samples <= most;
    q.noise = noise * curve_.noise_at(q.samples);
    q.cpu_seconds = start + time * samples_seconds(result_, q.samples);
    // Settings are compared by what they would cost if samples could be divided: steps of four must not decide.
    q.compared_seconds = start + time * samples_seconds(result_, exact);
    return q;
  }

  /// From what is asked for on, one setting after the other, while that saves time beyond doubt.
  Quality best(double target, const Quality* finer) const {
    const int most = finer ? finer->samples : int(most_samples);
    std::vector<int> chosen = asked_;
    for (size_t i = 0; i < chosen.size(); ++i)
      if (finer && !allowed(i, chosen[i], *finer)) chosen[i] = finer->chosen[i];
    Forecast found = forecast(chosen, target, most);
    for (bool better = true; better;) {
      better = false;
      Forecast next = found;
      for (size_t i = 0; i < chosen.size(); ++i) {
        if (asked_[i] < 0) continue;
        for (int k = 0; k < int(result_.lists[i].prices.size()); ++k) {
          if (k == found.chosen[i] || (finer && !allowed(i, k, *finer))) continue;
          // Nothing is known to be wrong with what is asked for: finer gains nothing.
          if (k > asked_[i] && result_.lists[i].has_finest && !(price(i, asked_[i])->bias.error.low > 0)) continue;
          std::vector<int> tried = found.chosen;
          tried[i] = k;
          const Forecast doubted = forecast(tried, target, most, int(i));
          if (!doubted.reached) continue;
          // Held against the best that what is held may be: a lead within chance is none.
          const Forecast held = forecast(found.chosen, target, most, int(i), &Interval::low);
          if (found.reached && doubted.compared_seconds > (1 - least_saving) * held.compared_seconds) continue;
          const Forecast hoped = forecast(tried, target, most);
          if (next.reached && hoped.compared_seconds >= next.compared_seconds) continue;
          next = hoped;
          better = true;
        }
      }
      found = next;
    }
    // What suits the finer one suits the coarser as well; nothing may be dearer than that.
    if (finer) {
      const Forecast same = forecast(finer->chosen, target, most);
      const auto out_of_order = [&](const Quality& q) {
        return !q.reached || q.cpu_seconds > finer->cpu_seconds || q.error() < finer->error();
      };
      if (out_of_order(found)) found = same;
      if (out_of_order(found)) {
        static_cast<Quality&>(found) = *finer;
        found.target = target;
      }
    }
    return found;
  }

  static double samples_seconds(const CostResult& result, double samples);

 private:
  const Price* price(size_t list, int setting) const {
    return setting < 0 ? nullptr : &result_.lists[list].prices[size_t(setting)];
  }
  // Of a coarser quality beside a finer one. Where settings have no order both have the same.
  bool allowed(size_t list, int setting, const Quality& finer) const {
    return result_.lists[list].has_finest ? setting <= finer.chosen[list] : setting == finer.chosen[list];
  }

  const CostResult& result_;
  NoiseCurve curve_;
  bool known_ = false;
  std::vector<int> asked_;
};

// CPU-seconds of so many samples, by the straight line in logarithms between the two measured about it: few samples
// of a pixel are dearer each.
double Advisor::samples_seconds(const CostResult& result, double samples) {
  const std::vector<CostPoint>& points = result.points;
  const auto seconds = [&](const CostPoint& p) {
    return std::max(p.cpu_seconds.value - result.start.seconds(), 1e-9);
  };
  if (samples <= points.front().samples) return seconds(points.front()) * samples / points.front().samples;
  if (samples >= points.back().samples) return seconds(points.back()) * samples / points.back().samples;
  size_t i = 1;
  while (points[i].samples < samples) ++i;
  const CostPoint &low = points[i - 1], &high = points[i];
  const double share = std::log(samples / low.samples) / std::log(double(high.samples) / low.samples);
  return seconds(low) * std::pow(seconds(high) / seconds(low), share);
}

std::string flags_of(const CostResult& result, const std::vector<int>& asked, const Quality& q) {
  std::string flags = fmt::format("--spp {}", q.samples);
  if (!result.effects_flags.empty()) flags += " " + result.effects_flags;
  for (size_t i = 0; i < q.chosen.size(); ++i) {
    if (q.chosen[i] < 0 || q.chosen[i] == asked[i]) continue;
    for (const std::string& flag : result.lists[i].prices[size_t(q.chosen[i])].flags) flags += " " + flag;
  }
  return flags;
}

}  // namespace

int PriceList::asked() const {
  for (size_t i = 0; i < prices.size(); ++i)
    if (prices[i].asked) return int(i);
  return -1;
}

double Quality::error() const {
  return std::hypot(noise, bias);
}

double seconds_for_noise(const CostResult& result, double error) {
  if (!result.fit.known || result.fit.slope >= 0) return 0;
  return std::pow(error / result.fit.factor, 1 / result.fit.slope);
}

void settle_advice(CostResult& result) {
  for (PriceList& list : result.lists) list.enough = enough_of(list);
  result.qualities.clear();
  result.frontier.clear();
  const Advisor advisor(result);
  for (CostPoint& p : result.points) p.error = std::hypot(p.noise.value, advisor.bias_of(advisor.asked()));
  if (result.lists.empty() || result.points.size() < 2 || !advisor.known()) return;
  struct Wanted {
    double target;
    const char* name;
  };
  std::vector<Wanted> wanted;
  double least = 1;
  for (const NamedQuality& each : named_qualities) {
    wanted.push_back({each.error, each.name});
    least = std::min(least, each.error);
  }
  for (double target = 0.2; target > 0.8 * least; target *= 0.8) wanted.push_back({target, nullptr});
  // From the finest on, each held to the one before: so all of them are in order.
  std::sort(wanted.begin(), wanted.end(), [](const Wanted& a, const Wanted& b) { return a.target < b.target; });
  std::optional<Quality> finer;
  for (const Wanted& each : wanted) {
    Quality q = advisor.best(each.target, finer ? &*finer : nullptr);
    if (q.reached) {
      q.flags = flags_of(result, advisor.asked(), q);
      result.frontier.push_back(q);
      finer = q;
    }
    if (!each.name) continue;
    q.name = each.name;
    result.qualities.insert(result.qualities.begin(), q);  // draft first
  }
}

}  // namespace sateen
