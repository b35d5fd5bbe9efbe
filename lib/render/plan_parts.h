#pragma once
#include <string>
#include <vector>

#include "render/plan.h"
#include "render/plan_pilot.h"

// The parts of a plan, for plan.cpp.

namespace sateen {

/// What a plan is made of and from.
struct PlanWork {
  const Scene& scene;  ///< without what the user switched off
  const PlanSettings& settings;
  PlanPilot& pilot;
  double allowed = 0;  ///< E of what may still be ruled out by a pilot
};

/// An effect that is there because the scene describes it. InputError where it is switched on and is not there.
PlannedEffect described(Effect effect, bool is_there, const EffectSwitches& switches, const std::string& reason,
                        const std::string& missing, const std::string& remedy);

/// Takes an effect out of the pilot's picture, and leaves it out of the plan where what is lost is allowed, which it
/// then takes off work.allowed. `planned` gets loss, price, basis and the reason's second half.
void decide_by_pilot(PlanWork& work, PlannedEffect& planned);

/// The parts of the cloth model, whose numbers are those of the fabrics with their textures.
std::vector<PlannedEffect> plan_model(const Scene& scene, const PlanPilot& pilot);
/// The largest share of the area that no thread covers, of all fabrics and points.
float most_gap(const Scene& scene);

/// How light of the cloth may meet cloth again.
struct SelfLight {
  enum class Way {
    none,  ///< it cannot
    gaps,  ///< through gaps alone: the mesh keeps no light from itself
    folds  ///< it may by the mesh's form, or by where the camera stands
  } way = Way::folds;
  std::string form;      ///< "the mesh is flat"
  std::string but = {};  ///< why it may even so
};
SelfLight self_light(const Scene& scene);

PlannedEffect plan_gaps(PlanWork& work, bool is_there);
PlannedEffect plan_weave(const Scene& scene, const PlanSettings& settings);
PlannedEffect plan_self_shadowing(PlanWork& work, const SelfLight& self);

struct PlannedBounces {
  PlannedEffect planned;
  int count = 0;
};
/// `possible`: by way of cloth or ground; `reason`: why not.
PlannedBounces plan_bounces(PlanWork& work, bool possible, const std::string& reason);

PlannedEffect plan_ground(const Scene& scene, const EffectSwitches& switches);
/// Off where no point of the object's bounding sphere is blurred by half a pixel, nothing sharp is seen behind it,
/// and the pilot agrees.
PlannedEffect plan_lens(PlanWork& work, const Scene& whole);
/// Off where nothing moves by half a pixel while the shutter is open, and the pilot agrees.
PlannedEffect plan_shutter(PlanWork& work, const Scene& whole);
PlannedEffect plan_references(const EffectSwitches& switches);
PlannedEffect plan_subdivision(const Mesh& mesh, const Detail& detail);

}  // namespace sateen
