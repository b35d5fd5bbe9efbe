#include "render/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "render/loss.h"
#include "render/plan_parts.h"

namespace sateen {

namespace {

/// The scene without what the user switched off; empty where that is nothing. Bounces are followed even so, to tell
/// what they would add.
std::optional<Scene> without_switched_off(const Scene& scene, const EffectSwitches& switches) {
  std::optional<Scene> rest;
  LightSettings light;
  for (const EffectInfo& info : effect_list()) {
    if (!info.switchable || info.effect == Effect::interreflection || !switches.is_off(info.effect)) continue;
    if (!rest) rest = scene;
    remove_effect(info.effect, *rest, light);
  }
  return rest;
}

/// How many bounces the pilot follows: where their number is given, one more tells what comes after.
int pilot_bounces(bool possible, const EffectSwitches& switches) {
  if (!possible) return 0;
  return switches.bounces ? std::min(*switches.bounces + 1, every_bounce) : every_bounce;
}

/// Effects in the order of effect_list(), in whatever order they are decided.
struct Decided {
  std::vector<PlannedEffect> effects = std::vector<PlannedEffect>(effect_list().size());
  void add(PlannedEffect planned) { effects[size_t(planned.effect)] = std::move(planned); }
};

}  // namespace

PlannedEffect described(Effect effect, bool is_there, const EffectSwitches& switches, const std::string& reason,
                        const std::string& missing, const std::string& remedy) {
  PlannedEffect planned{effect, is_there, is_there ? Basis::look : Basis::data, is_there ? reason : missing, {},
                        {},     0};
  planned.missing = !is_there;
  if (!is_there && switches.named_on(effect))
    throw InputError(fmt::format("--effects +{}: {}", effect_info(effect).name, missing), remedy);
  if (is_there && switches.is_off(effect)) {
    planned.on = false;
    planned.basis = Basis::asked;
    planned.reason = fmt::format("switched off; {}", reason);
  }
  return planned;
}

void decide_by_pilot(PlanWork& work, PlannedEffect& planned) {
  const Removal removal =
      remove_and_compare(work.scene, planned.effect, work.allowed, work.settings.threads, work.pilot);
  planned.basis = Basis::pilot;
  planned.loss = removal.loss;
  // Others move light or take it away.
  if (planned.effect == Effect::gaps) {
    planned.share = removal.share;
    planned.share->value = std::max(planned.share->value, 0.0);
    planned.share->high = std::max(planned.share->high, 0.0);
  }
  planned.cost = removal.saves;
  planned.on = removal.loss.high > work.allowed;
  planned.reason += fmt::format("; without it E would be off by {}", percent_text(removal.loss));
  if (planned.on) return;
  planned.reason += fmt::format(", and {:.3g} % are allowed", 100 * work.allowed);
  work.allowed -= removal.loss.high;
}

Plan make_plan(const Scene& scene, const Look& look, const PlanSettings& settings) {
  const EffectSwitches& switches = settings.switches;
  Plan plan;
  plan.error_asked = settings.error > 0;
  plan.error = plan.error_asked ? settings.error : default_plan_error;
  const std::optional<Scene> rest = without_switched_off(scene, switches);
  const Scene& rendered = rest ? *rest : scene;
  SelfLight self = self_light(rendered);
  // A ground sends light back to cloth of any form.
  const bool by_ground = solid_ground(rendered) != nullptr;
  const auto comes_back = [&] { return by_ground || self.way != SelfLight::Way::none; };
  PlanPilot pilot = run_plan_pilot(rendered, settings.light, settings.error_floor,
                                   pilot_bounces(comes_back(), switches), settings.seed, settings.threads);
  PlanWork work{rendered, settings, pilot, plan_allowance * plan.error};
  Decided decided;
  for (PlannedEffect& part : plan_model(rendered, pilot)) decided.add(std::move(part));

  PlannedEffect back =
      described(Effect::back, scene.back.has_value(), switches, fmt::format("the look names {}", look.back),
                "both sides are the same look", "name a look: --set back=NAME");
  back.share = pilot.back;
  decided.add(std::move(back));
  decided.add(described(Effect::maps, has_maps(scene), switches, "the look names textures",
                        "the look has no textures", "give a field one: see docs/maps.md"));
  decided.add(described(Effect::pattern, has_pattern(scene), switches, "the look names a pattern",
                        "one look everywhere", "name one: pattern.mask and pattern.look"));
  decided.add(plan_weave(scene, settings));

  // Where light comes back through gaps alone all else hangs on them; else bounces are what saves most.
  const bool gaps_first = self.way == SelfLight::Way::gaps;
  if (gaps_first) {
    PlannedEffect gaps = plan_gaps(work, scene.has_gaps);
    if (!gaps.on) self = {SelfLight::Way::none, self.form};
    decided.add(std::move(gaps));
  }
  PlannedBounces bounces = plan_bounces(work, comes_back(), self.form);
  plan.bounces = bounces.count;
  plan.bounce_share = plan.bounces > 0 ? switches.bounce_share.value_or(pilot.bounce_share) : 1;
  bounces.planned.cost *= double(plan.bounce_share);
  if (plan.bounce_share < 1)
    bounces.planned.reason += fmt::format("; followed by {:.3g} % of the samples", 100 * double(plan.bounce_share));
  decided.add(std::move(bounces.planned));
  if (!gaps_first) decided.add(plan_gaps(work, scene.has_gaps));
  decided.add(plan_self_shadowing(work, self));

  decided.add(plan_ground(scene, switches));
  decided.add(plan_lens(work, scene));
  decided.add(plan_shutter(work, scene));
  PlannedEffect backdrop = described(
      Effect::backdrop, scene.backdrop != Backdrop::none, switches,
      scene.backdrop == Backdrop::plain ? "one colour beside the cloth" : "the map is seen beside the cloth",
      "nothing is asked for beside the cloth", "say which: --backdrop environment");
  if (backdrop.on) backdrop.basis = Basis::asked;
  backdrop.share = pilot.backdrop;
  decided.add(std::move(backdrop));
  decided.add(plan_references(switches));
  plan.detail = measure_detail(*scene.mesh, detail_view(scene.camera, false), settings.threads);
  decided.add(plan_subdivision(*scene.mesh, plan.detail));
  plan.effects = std::move(decided.effects);
  return plan;
}

void hold_to(const EffectSwitches& switches, Plan& plan) {
  if (switches.bounces) plan.bounces = *switches.bounces;
  for (PlannedEffect& p : plan.effects) {
    if (!effect_info(p.effect).switchable || p.missing || p.effect == Effect::references) continue;
    const bool off = switches.is_off(p.effect), on = switches.is_asked(p.effect);
    if (p.effect != Effect::interreflection) {
      if (off || on) p.on = on;
      continue;
    }
    if (switches.bounces && !switches.named_off(p.effect)) continue;
    if (off) plan.bounces = 0;
    if (on) plan.bounces = every_bounce;
  }
  plan.effects[size_t(Effect::interreflection)].on = plan.bounces > 0;
}

void apply_plan(const Plan& plan, Scene& scene, LightSettings& light) {
  light.bounces = plan.bounces;
  light.bounce_share = plan.bounce_share;
  for (const PlannedEffect& planned : plan.effects)
    if (!planned.on) remove_effect(planned.effect, scene, light);
}

}  // namespace sateen
