#include "report/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {
std::string tick_label(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 1e-3 && size < 1e5) return fmt::format("{:.4g}", value);
  // 1e-05 as 10 with a raised exponent; other mantissas are written out.
  const int exponent = int(std::floor(std::log10(size) + 1e-9));
  const double mantissa = value / std::pow(10.0, exponent);
  static const char* raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string power = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) power += raised[digit - '0'];
  return (std::abs(mantissa - 1) < 1e-6 ? "" : fmt::format("{:.3g}·", mantissa)) + "10" + power;
}

std::vector<Tick> log_ticks(const Axis& axis, int most) {
  const int from = int(std::floor(std::log10(axis.low) + 1e-9)), to = int(std::floor(std::log10(axis.high) + 1e-9));
  const double decades = std::log10(axis.high / axis.low);
  const int every = std::max(1, int(std::ceil(decades / most)));
  const double room = most / std::max(decades, 1e-9);
  std::vector<Tick> ticks;
  for (int e = from; e <= to; ++e)
    for (int m = 1; m <= 9; ++m) {
      const double value = m * std::pow(10.0, e);
      if (value < axis.low * (1 - 1e-9) || value > axis.high * (1 + 1e-9)) continue;
      const bool labelled = m == 1 ? (e - from) % every == 0 || decades < most : (m == 2 || m == 5) && room >= 2.2;
      if (decades > 4 && m > 1) continue;
      ticks.push_back({value, labelled ? tick_label(value) : ""});
    }
  return ticks;
}
}  // namespace

double Axis::at(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

Axis axis_for(const std::vector<double>& values, bool logarithmic) {
  double low = 1e300, high = -1e300;
  for (const double v : values)
    if (std::isfinite(v) && (!logarithmic || v > 0)) low = std::min(low, v), high = std::max(high, v);
  Axis axis{logarithmic ? 0.1 : 0.0, 1, logarithmic};
  if (low > high) return axis;
  if (logarithmic) {
    // A narrow spread is shown over half a decade, so that noise does not look like a trend.
    const double half = std::max(std::log(high / low) * 0.54, 0.6), middle = std::sqrt(low) * std::sqrt(high);
    axis.low = middle * std::exp(-half);
    axis.high = middle * std::exp(half);
  } else {
    const double room = high > low ? (high - low) * 0.06 : std::max(std::abs(high), 1.0) * 0.1;
    axis.low = low >= 0 && low - room < 0 ? 0 : low - room;
    axis.high = high + room;
  }
  return axis;
}

std::vector<Tick> axis_ticks(const Axis& axis, int most) {
  if (axis.logarithmic) return log_ticks(axis, most);
  const double rough = (axis.high - axis.low) / std::max(most, 1),
               power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  std::vector<Tick> ticks;
  for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k)
    ticks.push_back({k * step, tick_label(k * step)});
  return ticks;
}

}  // namespace sateen
