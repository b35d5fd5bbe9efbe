#pragma once
#include <optional>
#include <string>
#include <vector>

#include "film/error.h"
#include "look/json_writer.h"
#include "mesh/detail.h"
#include "render/effects.h"

namespace sateen {

/// Why an effect is on or off.
enum class Basis {
  look,   ///< the look states it
  asked,  ///< the command line states it
  data,   ///< mesh, map or look make it impossible, or needless
  pilot   ///< measured on this scene
};
const std::string& basis_name(Basis basis);  ///< "look", "asked", "data", "pilot"

struct PlannedEffect {
  Effect effect = Effect::families;
  bool on = false;
  Basis basis = Basis::look;
  std::string reason;             ///< one phrase for people, with the numbers
  std::optional<Interval> share;  ///< of the picture's light that comes by way of it, 0 to 1
  std::optional<Interval> loss;   ///< E of the picture that leaves out what is ruled out of it
  double cost =
      0;  ///< of a sample, as a share of one with direct light alone; of an effect that is off, what it saves
  bool missing = false;  ///< off because the scene describes nothing of it
};

/// Which effects a picture is rendered with, decided before it is.
struct Plan {
  double error = 0;         ///< E that it was made for
  bool error_asked = true;  ///< false: nobody asked for one, and `default_plan_error` was taken
  int bounces = 0;
  float bounce_share = 1;              ///< of the samples that follow them
  Detail detail;                       ///< how far the picture's silhouettes and normals are from the limit surface's
  std::vector<PlannedEffect> effects;  ///< all, in the order of effect_list()

  const PlannedEffect& of(Effect effect) const { return effects[size_t(effect)]; }
};

/// Where no error is asked for. About what the default number of samples reaches.
inline constexpr double default_plan_error = 0.03;
/// What all that is ruled out may be off by, as a share of the error asked for: beside noise of that size it adds an
/// eighth.
inline constexpr double plan_allowance = 0.5;

/// Decides for a scene that has everything its settings describe. A question of scene, switches and `error` (0: none
/// asked) alone, never of a clock: the same on every machine and any number of threads. InputError where something is
/// switched on that the scene does not have. Its pilot takes about a twentieth of a CPU-second. Where the number of
/// bounces is given it follows one more, to tell what is left out. Without `pilot` no share and no loss is known:
/// for a picture that is rendered already.
Plan make_plan(const Scene& scene, const Look& look, const EffectSwitches& switches, double error,
               const LightSettings& light, std::uint32_t seed, int threads, bool pilot = true);

/// Takes out of scene and settings what the plan has off.
void apply_plan(const Plan& plan, Scene& scene, LightSettings& light);

/// The plan as an open JSON object's members: error, bounces, effects.
void write_plan(JsonWriter& w, const Plan& plan);
std::string plan_json(const Plan& plan);  ///< on one line, for metadata

}  // namespace sateen
