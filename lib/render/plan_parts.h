#pragma once
#include <string>

#include "render/plan.h"

// The parts of a plan, for plan.cpp.

namespace sateen {

/// An effect that is there because the scene describes it. InputError where it is switched on and is not there.
PlannedEffect described(Effect effect, bool is_there, const EffectSwitches& switches, const std::string& reason,
                        const std::string& missing, const std::string& remedy);

PlannedEffect plan_ground(const Scene& scene, const EffectSwitches& switches);
/// Off where no point of the object's bounding sphere is blurred by half a pixel.
PlannedEffect plan_lens(const Scene& scene, const EffectSwitches& switches);
/// Off where nothing moves by half a pixel while the shutter is open.
PlannedEffect plan_shutter(const Scene& scene, const EffectSwitches& switches);
PlannedEffect plan_references(const EffectSwitches& switches);
PlannedEffect plan_subdivision(const Mesh& mesh, const Detail& detail);

}  // namespace sateen
