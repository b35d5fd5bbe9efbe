#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "command.h"
#include "look/json.h"

namespace sateen::app {

namespace {
std::string range_text(double low, double high) {
  constexpr double beyond = 1e15;
  if (low <= -beyond && high >= beyond) return "a number";
  if (high >= beyond) return fmt::format("{} or more", low);
  return fmt::format("a number from {} to {}", low, high);
}
}  // namespace

int read_integer(const std::string& what, const std::string& text, long long low, long long high) {
  long long value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || value < low || value > high)
    throw InputError(
        fmt::format("{} is {}, expected a whole number from {} to {}", what, shown_name(text), low, high));
  return int(value);
}

namespace {
std::optional<double> whole_number(std::string_view text) {
  double value = 0;
  if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}
}  // namespace

double read_number(const std::string& what, const std::string& text, double low, double high) {
  const std::optional<double> value = whole_number(text);
  if (!value || *value < low || *value > high)
    throw InputError(fmt::format("{} is {}, expected {}", what, shown_name(text), range_text(low, high)));
  return *value;
}

double read_share(const std::string& what, const std::string& text, double low, double high) {
  const size_t digits = text.find_last_not_of(" %") + 1;
  const bool percent = text.find('%', digits) != std::string::npos && std::count(text.begin(), text.end(), '%') == 1;
  const std::optional<double> value = whole_number(percent ? text.substr(0, digits) : text);
  const double share = value.value_or(-1) / (percent ? 100 : 1);
  if (!value || share < low || share > high)
    throw InputError(fmt::format("{} is {}, expected {}, or a percentage such as 2%", what, shown_name(text),
                                 range_text(low, high)));
  return share;
}

}  // namespace sateen::app
