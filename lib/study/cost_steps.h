#pragma once
#include <functional>
#include <string>
#include <vector>

#include "study/cost.h"

namespace sateen {

/// What a command line asks for.
struct RenderRequest {
  SceneSettings scene;
  LightSettings light;
  EffectSwitches effects;
};

/// One setting to be priced.
struct CostStep {
  std::string setting;
  std::vector<std::string> flags = {};
  bool asked = false;
  LightSettings light;
  /// Makes a copy of the scene what the setting asks for; empty: it does not touch the scene.
  std::function<void(Scene&)> make = {};
  std::function<void(RenderRequest&)> ask = {};  ///< what `flags` do
};
struct CostSteps {
  PriceList list;               ///< without prices
  std::vector<CostStep> steps;  ///< the finest last where there is one
};

/// What the lists of one picture are made of.
struct CostBase {
  const SceneSettings& settings;  ///< of the measured picture, its level stated
  const LightSettings& light;     ///< as planned
  const Plan& plan;
  const Scene& described;  ///< with everything that the settings describe, as the plan saw it
  const Scene& scene;      ///< as planned
  const Look& look;
  const EffectSwitches& effects;
  int most_bounces;  ///< that the finest quality plans
  double error_floor;
  std::uint32_t seed;
  int threads;
  const ColorManager& colors;
};

/// All lists: bounces, level, approximations, strategy, candidates. The steps keep references to `base` and to what
/// it holds.
std::vector<CostSteps> cost_steps(const CostBase& base);

/// `asked` with the flags of a setting of every list, -1 for none; what is asked for needs none.
RenderRequest request_of(const std::vector<CostSteps>& all, const std::vector<PriceList>& lists,
                         const std::vector<int>& chosen, RenderRequest asked);

/// "--effects auto,+gaps" where what is planned for the finest quality is, but for its bounces, not what a number of
/// samples plans, else empty; `effects` becomes what the flags ask for.
std::string effects_flags_of(const Plan& finest, const Plan& plain, EffectSwitches& effects);

}  // namespace sateen
