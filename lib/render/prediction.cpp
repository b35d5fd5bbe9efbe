#include "render/prediction.h"

#include <algorithm>
#include <cmath>

#include "render/allocation.h"

namespace sateen {

namespace {

constexpr double usual_deviation = 0.045;  // of usual_slope, over looks, maps and meshes (docs/error.md)
// Of log E at one barrier, beside what all barriers share: they add to the same samples.
constexpr double point_deviation = 0.03;
// Cost of a sample may change by this share, from caches, clocks and where samples go.
constexpr double cost_deviation = 0.07;
constexpr double two_sided_90 = 1.645;

/// Seconds for one more mean sample, where it goes next.
struct Cost {
  double seconds = 0, cpu_seconds = 0;
};

Cost cost_of(const std::vector<ErrorPoint>& points) {
  const ErrorPoint &last = points.back(), from = later_half_of(points);
  const double more = (last.work - from.work) / last.next_work;
  return {(last.seconds - from.seconds) / more, (last.cpu_seconds - from.cpu_seconds) / more};
}

Promise times_for(const std::vector<ErrorPoint>& points, const Forecast& samples) {
  const ErrorPoint& last = points.back();
  const Cost cost = cost_of(points);
  const auto forecast = [&](double spent, double each) {
    const double more = (samples.value - last.samples) * each;
    const double off = two_sided_90 * cost_deviation * more;
    const double below = (samples.value - samples.low) * each, above = (samples.high - samples.value) * each;
    return Forecast{spent + more, spent + more - std::hypot(below, off), spent + more + std::hypot(above, off)};
  };
  Promise promise;
  promise.made = true;
  promise.made_at_seconds = last.seconds;
  promise.samples = samples;
  promise.work = last.work + (samples.value - last.samples) * last.next_work;
  promise.seconds = forecast(last.seconds, cost.seconds);
  promise.cpu_seconds = forecast(last.cpu_seconds, cost.cpu_seconds);
  return promise;
}

// Samples once so many of them are useful, and back: on as in the last pass.
double useful_rate(const std::vector<ErrorPoint>& points) {
  const ErrorPoint& last = points.back();
  const ErrorPoint before = points.size() > 1 ? points[points.size() - 2] : ErrorPoint();
  const double rate = (last.useful - before.useful) / std::max(last.samples - before.samples, 1e-9);
  return std::clamp(rate, 0.01, 1.0);
}

// The barrier at which E is looked at with `samples` or more.
double barrier_for(double first, double samples) {
  int barrier = int(first);
  while (double(barrier) < std::min(samples, 1e9) * 0.999) barrier = next_barrier(barrier);
  return double(barrier);
}

}  // namespace

ErrorPoint later_half_of(const std::vector<ErrorPoint>& points) {
  ErrorPoint from;
  for (const ErrorPoint& p : points)
    if (p.samples <= points.back().samples / 2) from = p;
  return from;
}

ErrorSlope fit_slope(const std::vector<ErrorPoint>& points) {
  double count = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  // Up to the first look samples are the same everywhere; that they are dealt out from then on makes E fall faster
  // for a while than it goes on to. Promises that counted it in were a tenth too short in the median of 19 scenes.
  const double even = points.size() >= 4 ? points.front().samples : 0;
  for (const ErrorPoint& p : points) {
    if (!(p.error > 0) || !(p.useful > 0) || p.samples <= even || p.samples < points.back().samples / 8) continue;
    const double x = std::log(p.useful), y = std::log(p.error);
    count += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double scatter = count > 1 ? sxx - sx * sx / count : 0;
  const double prior = 1 / (usual_deviation * usual_deviation);
  const double data = scatter / (point_deviation * point_deviation);
  const double fitted = scatter > 0 ? (sxy - sx * sy / count) / scatter : usual_slope;
  ErrorSlope s;
  s.slope = std::clamp((prior * usual_slope + data * fitted) / (prior + data), -1.2, -0.3);
  s.deviation = 1 / std::sqrt(prior + data);
  return s;
}

Promise promise_at(const std::vector<ErrorPoint>& points, double samples) {
  if (points.empty() || !(points.back().useful > 0)) return {};
  const ErrorPoint& last = points.back();
  const ErrorSlope s = fit_slope(points);
  Promise promise = times_for(points, {samples, samples, samples});
  const double way = std::log1p(std::max(samples - last.samples, 0.0) * useful_rate(points) / last.useful);
  const double error = last.error * std::exp(s.slope * way);
  const double off = two_sided_90 * std::hypot(s.deviation * way, point_deviation);
  promise.error = {error, error * std::exp(-off), error * std::exp(off)};
  return promise;
}

Promise promise_in_time(const std::vector<ErrorPoint>& points, double seconds) {
  if (points.empty()) return {};
  const ErrorPoint& last = points.back();
  const double each = cost_of(points).seconds;
  if (!(each > 0)) return {};
  Promise promise = promise_at(points, last.samples + std::max(seconds - last.seconds, 0.0) / each);
  promise.seconds = {seconds, seconds, seconds};
  return promise;
}

Promise promise_for_error(const std::vector<ErrorPoint>& points, double target) {
  if (points.empty() || !(points.back().error > 0) || !(points.back().useful > 0)) return {};
  const ErrorPoint& last = points.back();
  const ErrorSlope s = fit_slope(points);
  // In log useful samples, where the errors of the slope and of the last point add as squares.
  const double way = std::max(std::log(last.high / target), 0.0) / -s.slope;
  const double off =
      two_sided_90 * std::hypot(way * s.deviation / -s.slope, point_deviation * std::sqrt(1 + way) / -s.slope);
  const auto barrier = [&](double log_samples) {
    const double more = last.useful * std::expm1(std::clamp(log_samples, 0.0, 40.0)) / useful_rate(points);
    return barrier_for(last.samples, last.samples + more);
  };
  Promise promise = times_for(points, {barrier(way), barrier(way - off), barrier(way + off)});
  promise.error = {target, target, target};
  return promise;
}

}  // namespace sateen
