#include "scene/filter.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"
#include "look/json.h"

namespace sateen {

namespace {

constexpr float least_radius = 0.05f, largest_radius = 8;

float usual_radius(FilterShape shape) {
  switch (shape) {
    case FilterShape::box:
      return 0.5f;
    case FilterShape::triangle:
      return 1;
    case FilterShape::blackman_harris:
    case FilterShape::gaussian:
      break;
  }
  return 1.5f;
}

// At x in [-radius, radius].
double filter_value(FilterShape shape, double x, double radius) {
  switch (shape) {
    case FilterShape::blackman_harris: {
      const double t = 2 * double(pi) * (x + radius) / (2 * radius);
      return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
    }
    case FilterShape::gaussian:
      return std::exp(-4.5 * x * x / (radius * radius));
    case FilterShape::triangle:
      return 1 - std::abs(x) / radius;
    case FilterShape::box:
      break;
  }
  return 1;
}

float sample_axis(const PixelFilter& filter, double u) {
  const double place = u * PixelFilter::steps;
  const auto i = size_t(std::min(int(place), PixelFilter::steps - 1));
  return filter.inverse[i] + float(place - double(i)) * (filter.inverse[i + 1] - filter.inverse[i]);
}

}  // namespace

const std::vector<std::string>& filter_names() {
  static const std::vector<std::string> names{"blackman-harris", "gaussian", "triangle", "box"};
  return names;
}

FilterSettings read_filter(const std::string& what, const std::string& text) {
  const size_t colon = std::min(text.find(':'), text.size());
  const std::string name = text.substr(0, colon);
  const auto found = std::find(filter_names().begin(), filter_names().end(), name);
  if (found == filter_names().end())
    throw InputError(fmt::format("{}: there is no filter {}", what, shown_name(name)),
                     suggestion(name, filter_names()));
  FilterSettings settings;
  settings.shape = FilterShape(found - filter_names().begin());
  settings.radius = usual_radius(settings.shape);
  if (colon == text.size()) return settings;
  const char *begin = text.data() + colon + 1, *end = text.data() + text.size();
  const auto [next, code] = std::from_chars(begin, end, settings.radius);
  if (code != std::errc() || next != end || !(settings.radius >= least_radius && settings.radius <= largest_radius))
    throw InputError(fmt::format("{}: the radius of {} is {}, expected {} to {} pixels", what, name,
                                 shown_name(std::string(begin, end)), least_radius, largest_radius));
  return settings;
}

std::string filter_text(const FilterSettings& settings) {
  return fmt::format("{}:{}", filter_names()[size_t(settings.shape)], settings.radius);
}

namespace {
std::shared_ptr<const PixelFilter> invert(const FilterSettings& settings) {
  constexpr int fine = 1 << 16;
  const double radius = double(settings.radius);
  std::vector<double> integral(fine + 1, 0.0);
  for (size_t i = 0; i < fine; ++i)
    integral[i + 1] =
        integral[i] + filter_value(settings.shape, -radius + 2 * radius * (double(i) + 0.5) / fine, radius);
  auto filter = std::make_shared<PixelFilter>();
  size_t place = 0;
  for (size_t k = 0; k <= PixelFilter::steps; ++k) {
    const double target = integral[fine] * double(k) / PixelFilter::steps;
    while (place < fine && integral[place + 1] < target) ++place;
    const double width = integral[std::min<size_t>(place + 1, fine)] - integral[place];
    const double part = width > 0 ? (target - integral[place]) / width : 0;
    filter->inverse[k] = float(-radius + 2 * radius * std::min((double(place) + part) / fine, 1.0));
  }
  return filter;
}
}  // namespace

std::shared_ptr<const PixelFilter> compile_filter(const FilterSettings& settings) {
  static const std::shared_ptr<const PixelFilter> usual = invert({});
  return settings == FilterSettings() ? usual : invert(settings);
}

Vec2 sample_filter(const PixelFilter& filter, const std::array<double, 2>& u) {
  return {sample_axis(filter, u[0]), sample_axis(filter, u[1])};
}

}  // namespace sateen
