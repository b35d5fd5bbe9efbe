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

/// What a plan is asked for.
struct PlanSettings {
  EffectSwitches switches;
  double error = 0;                          ///< E that is asked for; 0: none, and `default_plan_error` is taken
  double error_floor = default_error_floor;  ///< of E, in the light of the scene (film/error.h)
  LightSettings light;                       ///< `bounces` and `bounce_share` are the plan's
  std::uint32_t seed = 1;
  int threads = 0;
  bool from_all_around = false;  ///< one plan for an object, camera or light that turns
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
inline constexpr double default_plan_error = 0.057;
/// What all that a pilot rules out may be off by together, as a share of the error asked for: beside noise of that
/// size it adds an eighth.
inline constexpr double plan_allowance = 0.5;

/// Decides for a scene that has everything its settings describe. A question of scene and settings alone, never of a
/// clock: the same on every machine and any number of threads; and of light and floor in proportion: a scene of half
/// the light that is shown at one stop more gets the same plan. InputError where something is switched on that the
/// scene does not have. Its pilot takes about a twentieth of a CPU-second, and as much again for an effect that is
/// taken out to see. Where the number of bounces is given it follows one more, to tell what is left out.
Plan make_plan(const Scene& scene, const Look& look, const PlanSettings& settings);

/// Holds a plan that was made before to what switches say of it: where they say another thing, the plan becomes that.
void hold_to(const EffectSwitches& switches, Plan& plan);

/// Takes out of scene and settings what the plan has off.
void apply_plan(const Plan& plan, Scene& scene, LightSettings& light);

/// The plan as an open JSON object's members: error, bounces, effects.
void write_plan(JsonWriter& w, const Plan& plan);
std::string plan_json(const Plan& plan);  ///< on one line, for metadata
/// The plan that plan_json() wrote, whose text is then the same. InputError where the text is another one.
Plan read_plan(const std::string& json);

}  // namespace sateen
