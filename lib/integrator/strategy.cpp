#include "integrator/strategy.h"

#include <fmt/format.h>

#include <charconv>

#include "base/error.h"
#include "base/nearest_name.h"

namespace sateen {

namespace {
constexpr const char* automatic_name = "auto";

/// A whole number from low to most_candidates, or -1.
int read_count(std::string_view text, int low) {
  int count = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  return error == std::errc() && end == text.data() + text.size() && count >= low && count <= most_candidates ? count
                                                                                                              : -1;
}
}  // namespace

const std::vector<std::string>& strategy_names() {
  static const std::vector<std::string> names{"uniform",         "talk",     "table",    "environment", "mis",
                                              "mis-compensated", "mis-talk", "resampled"};
  return names;
}

Strategy strategy_from_name(const std::string& name) {
  if (name == automatic_name) return LightSettings().strategy;
  const std::vector<std::string>& names = strategy_names();
  for (size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return Strategy(i);
  throw InputError(fmt::format("unknown strategy '{}'", name), suggestion(name, names));
}

std::string strategy_name(Strategy strategy) {
  return strategy == Strategy::automatic ? automatic_name : strategy_names()[size_t(strategy)];
}

std::string candidates_text(const CandidateCounts& counts) {
  return counts.table == counts.map ? fmt::format("{}", counts.table)
                                    : fmt::format("{}+{}", counts.table, counts.map);
}

CandidateCounts candidates_from_text(const std::string& text) {
  const size_t plus = text.find('+');
  const int table = read_count(std::string_view(text).substr(0, plus), 1);
  const int map = plus == std::string::npos ? table : read_count(std::string_view(text).substr(plus + 1), 0);
  if (table < 0 || map < 0)
    throw InputError(
        fmt::format("candidates are '{}', expected a number of each kind or TABLE+MAP", text),
        fmt::format("such as 8, or 4+16 for 4 by the cloth's table and 16 by the map; the table wants 1 to {}, the "
                    "map 0 to {}",
                    most_candidates, most_candidates));
  return {table, map};
}

FabricSampler strategy_sampler(Strategy strategy) {
  switch (strategy) {
    case Strategy::uniform:
      return FabricSampler::uniform;
    case Strategy::talk:
    case Strategy::mis_talk:
      return FabricSampler::talk;
    default:
      return FabricSampler::table;
  }
}

}  // namespace sateen
