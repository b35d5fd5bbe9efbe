#include "typed_values.h"

#include <fmt/format.h>

#include <charconv>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "command.h"
#include "look/json.h"

namespace sateen::app {

namespace {
// Seconds in a unit of time as people write it; 0 for no unit.
double unit_seconds(std::string_view unit) {
  constexpr std::pair<std::string_view, double> units[] = {
      {"s", 1},    {"sec", 1},   {"secs", 1},   {"second", 1},  {"seconds", 1},
      {"m", 60},   {"min", 60},  {"mins", 60},  {"minute", 60}, {"minutes", 60},
      {"h", 3600}, {"hr", 3600}, {"hrs", 3600}, {"hour", 3600}, {"hours", 3600}};
  for (const auto& [name, seconds] : units)
    if (name == unit) return seconds;
  return 0;
}

std::string without_blanks(std::string text) {
  std::erase(text, ' ');
  return text;
}

std::string_view letters_at(std::string_view text) {
  size_t n = 0;
  while (n < text.size() && std::isalpha(static_cast<unsigned char>(text[n]))) ++n;
  return text.substr(0, n);
}
}  // namespace

bool continues_duration(const std::string& word) {
  const size_t digits = std::min(word.find_first_not_of("0123456789."), word.size());
  return digits < word.size() && unit_seconds(letters_at(std::string_view(word).substr(digits))) > 0;
}

double read_duration(const std::string& what, const std::string& text) {
  constexpr double longest = 1e7;
  const std::string typed = without_blanks(text);
  std::string_view left = typed;
  double total = 0, last = longest;
  bool good = !left.empty();
  while (good && !left.empty()) {
    double value = 0;
    const auto [next, code] =
        std::from_chars(left.data(), left.data() + left.size(), value, std::chars_format::fixed);
    good = code == std::errc() && value >= 0;
    left.remove_prefix(size_t(next - left.data()));
    const std::string_view unit = letters_at(left);
    const double seconds = unit.empty() && left.empty() ? 1 : unit_seconds(unit);
    good = good && seconds > 0 && seconds < last;  // hours before minutes before seconds
    last = seconds;
    total += value * seconds;
    left.remove_prefix(unit.size());
  }
  if (!good || !(total > 0) || total > longest)
    throw InputError(fmt::format("{} is {}, expected a time such as 30, 30s, 2m or 1h30m", what, shown_name(text)));
  return total;
}

bool continues_size(const std::string& word) {
  return !word.empty() && word.find_first_not_of("0123456789xX,*") == std::string::npos;
}

std::pair<int, int> read_size(const std::string& what, const std::string& text, int least, std::pair<int, int> most) {
  std::vector<std::string> sides{""};
  for (const char c : text) {
    const bool separates = c == ' ' || c == 'x' || c == 'X' || c == ',' || c == '*';
    if (!separates)
      sides.back() += c;
    else if (!sides.back().empty())
      sides.emplace_back();
  }
  if (sides.size() > 1 && sides.back().empty()) sides.pop_back();
  if (sides.size() != 2)
    throw InputError(fmt::format("{} is {}, expected two numbers: a width and a height", what, shown_name(text)),
                     fmt::format("{0} 640 360, {0} 640x360 or {0} 640,360", what));
  return {read_integer("width of " + what, sides[0], least, most.first),
          read_integer("height of " + what, sides[1], least, most.second)};
}

}  // namespace sateen::app
