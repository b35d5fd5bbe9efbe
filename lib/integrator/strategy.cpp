#include "integrator/strategy.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/nearest_name.h"

namespace sateen {

namespace {
constexpr const char* automatic_name = "auto";
}

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
