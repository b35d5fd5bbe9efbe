#pragma once
#include <optional>
#include <string>
#include <vector>

#include "integrator/strategy.h"
#include "scene/scene.h"

namespace sateen {

/// What can be simulated. Parts of the cloth model first, then what a plan may leave out.
enum class Effect {
  families,
  surface_lobe,
  directed_volume,
  isotropic_volume,
  tangent_curve,
  back,
  maps,
  pattern,
  gaps,
  weave,
  self_shadowing,
  interreflection,
  ground,
  depth_of_field,
  motion_blur,
  backdrop,
  references,
  subdivision
};

struct EffectInfo {
  Effect effect;
  std::string name;  ///< as typed: "self-shadowing"
  std::string what;  ///< one phrase for people
  bool switchable;   ///< false: part of the cloth model, which a look's own numbers turn off
};

/// In the order of the enum.
const std::vector<EffectInfo>& effect_list();
const EffectInfo& effect_info(Effect effect);

/// InputError with the nearest name.
Effect effect_from_name(const std::string& name);

/// What the user said of effects.
struct EffectSwitches {
  enum class Rest { automatic, all, none };
  Rest rest = Rest::automatic;                ///< of the effects that are not named
  std::vector<Effect> on, off;                ///< named
  std::optional<int> bounces;                 ///< of interreflection; 0 is off
  bool references = false;                    ///< they are laid over the picture and take no part in its light
  std::optional<float> bounce_share;          ///< LightSettings::bounce_share
  std::optional<CandidateCounts> candidates;  ///< LightSettings::candidates; empty: a pilot on the scene chooses

  bool named_on(Effect effect) const;
  bool named_off(Effect effect) const;
  bool is_asked(Effect effect) const;  ///< switched on by name, or with all of them
  bool is_off(Effect effect) const;    ///< switched off by name, or with all of them
};

/// "auto", "all", "none" and names with + or -, separated by commas: "auto,+interreflection,-gaps". InputError with
/// the nearest name, for a part of the cloth model, and for a name that is both on and off.
EffectSwitches read_effects(const std::string& list);

/// Bounces of interreflection that is not cut short: roulette ends paths long before.
inline constexpr int every_bounce = 16;

/// Whether textures say something of some side, and whether a pattern does.
bool has_maps(const Scene& scene);
bool has_pattern(const Scene& scene);

/// Takes an effect out of a scene, which then is the scene that never had it.
void remove_effect(Effect effect, Scene& scene, LightSettings& light);

/// Names of the switchable effects that a scene has, "back,self-shadowing".
std::string effects_text(const Scene& scene, const LightSettings& light);

}  // namespace sateen
