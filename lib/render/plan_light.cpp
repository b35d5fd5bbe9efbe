#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/convexity.h"
#include "render/loss.h"
#include "render/plan_parts.h"
#include "scene/near_weave.h"

namespace sateen {

namespace {

/// Whether no camera ray starts inside the mesh, wherever lens and shutter take it: beyond the sphere about the
/// middle of the bounds that encloses all vertices, which is the same however the object turns.
bool stands_outside(const Scene& scene) {
  const Vec3 middle = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  float radius = 0;
  for (const Vec3& p : scene.mesh->positions) radius = std::max(radius, length(p - middle));
  const float lens = scene.lens ? scene.lens->radius : 0;
  return length(scene.camera.position - middle) - lens > radius;
}

std::string bounces_text(int count) {
  return fmt::format("{} bounce{}", count, count == 1 ? "" : "s");
}

}  // namespace

SelfLight self_light(const Scene& scene) {
  const MeshForm form = mesh_form(*scene.mesh);
  using Way = SelfLight::Way;
  if (form == MeshForm::folded) return {Way::folds, "the mesh has folds"};
  const std::string is = form == MeshForm::flat ? "the mesh is flat" : "the mesh is convex";
  if (form == MeshForm::convex && !stands_outside(scene))
    return {Way::folds, is, ", but the camera stands so near that it may look at it from inside"};
  if (scene.has_gaps) return {Way::gaps, is, ", but light that its gaps let pass may meet cloth again"};
  return {Way::none, is};
}

PlannedEffect plan_gaps(PlanWork& work, bool is_there) {
  PlannedEffect gaps = described(Effect::gaps, is_there, work.settings.switches,
                                 fmt::format("no thread covers {}{:.3g} % of the cloth",
                                             work.scene.has_maps ? "up to " : "", 100 * most_gap(work.scene)),
                                 "the threads cover all of the cloth", "give the look less coverage");
  if (gaps.on && !work.settings.switches.is_asked(Effect::gaps)) decide_by_pilot(work, gaps);
  return gaps;
}

PlannedEffect plan_weave(const Scene& scene, const PlanSettings& settings) {
  std::string reason;
  for (const Fabric* fabric : fabrics_of(scene)) {
    if (fabric->weave.empty()) continue;
    reason = fmt::format("{:.3g} by {:.3g} threads a centimetre", 0.01 / fabric->weave.warp_spacing,
                         0.01 / fabric->weave.weft_spacing);
    break;
  }
  PlannedEffect planned = described(Effect::weave, !reason.empty(), settings.switches, reason,
                                    "the look has no draft", "name one: --set weave.draft=plain");
  if (planned.on && !settings.switches.named_on(Effect::weave) && !may_show_yarns(scene, settings.from_all_around)) {
    planned.on = false;
    planned.basis = Basis::data;
    planned.reason += settings.from_all_around ? ": none fills a pixel" : ": none that is seen fills a pixel";
  }
  return planned;
}

PlannedEffect plan_self_shadowing(PlanWork& work, const SelfLight& self) {
  PlannedEffect planned{Effect::self_shadowing, true, Basis::data, self.form + self.but, {}, {}, 0};
  const bool asked = work.settings.switches.is_asked(planned.effect);
  if (work.settings.switches.is_off(planned.effect)) {
    planned.on = false;
    planned.basis = Basis::asked;
    planned.reason = "switched off";
  } else if (self.way == SelfLight::Way::none) {
    planned.on = asked;
    planned.basis = asked ? Basis::asked : Basis::data;
    planned.reason = self.form + ": nothing is in the way of its light";
  } else if (self.way == SelfLight::Way::gaps && !asked) {
    decide_by_pilot(work, planned);
  }
  return planned;
}

PlannedBounces plan_bounces(PlanWork& work, bool possible, const std::string& reason) {
  const PlanPilot& pilot = work.pilot;
  const EffectSwitches& switches = work.settings.switches;
  PlannedBounces out;
  PlannedEffect& p = out.planned;
  p.effect = Effect::interreflection;
  p.cost = pilot.bounce_cost;
  const bool off = switches.is_off(p.effect) && (switches.named_off(p.effect) || !switches.bounces);
  // What the bounces that are followed leave out.
  const auto settled = [&] {
    if (possible && pilot.indirect) {
      p.share = pilot.indirect;
      if (out.count < tracked_bounces) p.loss = pilot.lost_after[size_t(out.count)];
    }
    return out;
  };
  if (off || switches.bounces || switches.is_asked(p.effect)) {
    out.count = off ? 0 : switches.bounces.value_or(every_bounce);
    p.on = out.count > 0;
    p.basis = Basis::asked;
    p.reason = !p.on ? "switched off" : switches.bounces ? bounces_text(out.count) : "every bounce";
    if (possible && pilot.indirect)
      p.reason += fmt::format("; {} {} of the light",
                              p.on  ? "it adds"
                              : off ? "it would add"
                                    : "the first bounce would add",
                              percent_text(*pilot.indirect));
    return settled();
  }
  if (!possible) {
    p.basis = Basis::data;
    p.reason = reason + ": light that leaves it does not come back";
    return settled();
  }
  p.basis = Basis::pilot;
  while (out.count < tracked_bounces && pilot.lost_after[size_t(out.count)].high > work.allowed) ++out.count;
  const bool all = out.count == tracked_bounces;
  p.on = out.count > 0;
  const std::string adds = fmt::format("adds {} of the light", percent_text(pilot.indirect.value_or(Interval())));
  if (!p.on) {
    p.reason = fmt::format("{}; leaving it out costs E {}, and {:.3g} % are allowed", adds,
                           percent_text(pilot.lost_after[0]), 100 * work.allowed);
  } else {
    p.reason = fmt::format("{}; without it E would be off by {}", adds, percent_text(pilot.lost_after[0]));
    if (!all)
      p.reason +=
          fmt::format(", after {} by {}", bounces_text(out.count), percent_text(pilot.lost_after[size_t(out.count)]));
  }
  if (all) {
    out.count = every_bounce;
  } else {
    work.allowed -= pilot.lost_after[size_t(out.count)].high;
  }
  return settled();
}

}  // namespace sateen
