#include "render/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "mesh/convexity.h"
#include "render/loss.h"
#include "render/plan_parts.h"
#include "render/plan_pilot.h"
#include "scene/near_weave.h"

namespace sateen {

namespace {

std::string percent(double share) {
  return fmt::format("{:.3g} %", 100 * share);
}

std::string both(const char* name, float warp, float weft) {
  return warp == weft ? fmt::format("{} {} in warp and weft", name, warp)
                      : fmt::format("{} {} in the warp, {} in the weft", name, warp, weft);
}

/// What a look's own numbers decide.
PlannedEffect of_model(Effect effect, bool on, const std::string& reason, std::optional<Interval> share = {}) {
  return {effect, on, on ? Basis::look : Basis::data, reason, share, {}, 0};
}

std::vector<PlannedEffect> plan_model(const Look& look, const PlanPilot& pilot) {
  const ThreadFamily &warp = look.warp, &weft = look.weft;
  const bool has_warp = warp.coverage > 0, has_weft = weft.coverage > 0;
  const auto either = [&](const auto& test) { return (has_warp && test(warp)) || (has_weft && test(weft)); };
  const bool surface = either([](const ThreadFamily& f) { return f.eta > 1; });
  const bool directed = either([](const ThreadFamily& f) { return f.k_d < 1; });
  const bool isotropic = either([](const ThreadFamily& f) { return f.k_d > 0; });
  const bool bends = either([](const ThreadFamily& f) {
    return std::any_of(f.offsets_deg.begin(), f.offsets_deg.end(), [&](float o) { return o != f.offsets_deg[0]; });
  });
  std::vector<PlannedEffect> all;
  all.push_back(of_model(Effect::families, has_warp && has_weft,
                         has_warp && has_weft
                             ? both("coverage", warp.coverage, weft.coverage) + "; the light is the weft's"
                             : "one family covers nothing",
                         pilot.weft));
  all.push_back(of_model(Effect::surface_lobe, surface,
                         surface ? both("eta", warp.eta, weft.eta) : "eta is 1: nothing is reflected",
                         pilot.surface));
  all.push_back(of_model(Effect::directed_volume, directed,
                         directed ? both("k_d", warp.k_d, weft.k_d) : "k_d is 1: all of it is even", pilot.volume));
  all.push_back(of_model(Effect::isotropic_volume, isotropic,
                         isotropic ? "of the volume's light, " + both("k_d", warp.k_d, weft.k_d) : "k_d is 0"));
  all.push_back(of_model(
      Effect::tangent_curve, bends,
      bends ? fmt::format("the warp bends in {} pieces, the weft in {}", warp.lengths.size(), weft.lengths.size())
            : "the threads lie straight: one tangent each"));
  return all;
}

PlannedEffect plan_weave(const Scene& scene, const Look& look, const EffectSwitches& switches) {
  PlannedEffect planned =
      described(Effect::weave, scene.near_weave_pixel > 0, switches,
                fmt::format("{} by {} threads a centimetre", look.weave.warp_per_cm, look.weave.weft_per_cm),
                "the look has no draft", "name one: --set weave.draft=plain");
  if (planned.on && !switches.named_on(Effect::weave) && !may_show_yarns(scene)) {
    planned.on = false;
    planned.basis = Basis::data;
    planned.reason += ": none fills a pixel";
  }
  return planned;
}

std::string form_text(MeshForm form) {
  return form == MeshForm::flat ? "the mesh is flat" : "the mesh is convex";
}

PlannedEffect plan_self_shadowing(MeshForm form, const EffectSwitches& switches) {
  PlannedEffect planned{Effect::self_shadowing, true, Basis::data, "the mesh has folds", {}, {}, 0};
  const bool named = switches.named_on(Effect::self_shadowing) || switches.rest == EffectSwitches::Rest::all;
  if (switches.named_off(Effect::self_shadowing) ||
      (switches.rest == EffectSwitches::Rest::none && !switches.named_on(Effect::self_shadowing))) {
    planned.on = false;
    planned.basis = Basis::asked;
    planned.reason = "switched off";
  } else if (form != MeshForm::folded) {
    planned.on = named;
    planned.basis = named ? Basis::asked : Basis::data;
    planned.reason = form_text(form) + ": nothing is in the way of its light";
  }
  return planned;
}

std::string bounces_text(int count) {
  return fmt::format("{} bounce{}", count, count == 1 ? "" : "s");
}

/// How many bounces the pilot follows: where their number is given, one more tells what comes after.
int pilot_bounces(MeshForm form, const EffectSwitches& switches) {
  if (form != MeshForm::folded) return 0;
  return switches.bounces ? std::min(*switches.bounces + 1, every_bounce) : every_bounce;
}

struct Bounces {
  PlannedEffect planned;
  int count = 0;
};

Bounces plan_bounces(const PlanPilot& pilot, MeshForm form, const EffectSwitches& switches, double error) {
  Bounces out;
  PlannedEffect& p = out.planned;
  p.effect = Effect::interreflection;
  p.cost = pilot.bounce_cost;
  const bool off = switches.named_off(p.effect) ||
                   (switches.rest == EffectSwitches::Rest::none && !switches.named_on(p.effect) && !switches.bounces);
  const bool on = switches.named_on(p.effect) || switches.rest == EffectSwitches::Rest::all;
  // What the bounces that are followed leave out.
  const auto settled = [&] {
    if (form == MeshForm::folded && pilot.indirect) {
      p.share = pilot.indirect;
      if (out.count < tracked_bounces) p.loss = pilot.lost_after[size_t(out.count)];
    }
    return out;
  };
  if (off || switches.bounces || on) {
    out.count = off ? 0 : switches.bounces.value_or(every_bounce);
    p.on = out.count > 0;
    p.basis = Basis::asked;
    p.reason = !p.on ? "switched off" : switches.bounces ? bounces_text(out.count) : "every bounce";
    if (form == MeshForm::folded && pilot.indirect)
      p.reason += fmt::format("; {} {} of the light",
                              p.on  ? "it adds"
                              : off ? "it would add"
                                    : "the first bounce would add",
                              percent_text(*pilot.indirect));
    return settled();
  }
  if (form != MeshForm::folded) {
    p.basis = Basis::data;
    p.reason = form_text(form) + ": light that leaves it does not come back";
    return settled();
  }
  p.basis = Basis::pilot;
  const double allowed = plan_allowance * error;
  while (out.count < tracked_bounces && pilot.lost_after[size_t(out.count)].high > allowed) ++out.count;
  const bool all = out.count == tracked_bounces;
  p.on = out.count > 0;
  const std::string adds = fmt::format("adds {} of the light", percent_text(pilot.indirect.value_or(Interval())));
  if (!p.on) {
    p.reason = fmt::format("{}; leaving it out costs E {}, and {} are allowed", adds,
                           percent_text(pilot.lost_after[0]), percent(allowed));
  } else {
    p.reason = fmt::format("{}; without it E would be off by {}", adds, percent_text(pilot.lost_after[0]));
    if (!all)
      p.reason +=
          fmt::format(", after {} by {}", bounces_text(out.count), percent_text(pilot.lost_after[size_t(out.count)]));
  }
  if (all) out.count = every_bounce;
  return settled();
}

}  // namespace

const std::string& basis_name(Basis basis) {
  static const std::vector<std::string> names{"look", "asked", "data", "pilot"};
  return names[size_t(basis)];
}

PlannedEffect described(Effect effect, bool is_there, const EffectSwitches& switches, const std::string& reason,
                        const std::string& missing, const std::string& remedy) {
  PlannedEffect planned{effect, is_there, is_there ? Basis::look : Basis::data, is_there ? reason : missing, {},
                        {},     0};
  planned.missing = !is_there;
  if (!is_there && switches.named_on(effect))
    throw InputError(fmt::format("--effects +{}: {}", effect_info(effect).name, missing), remedy);
  if (is_there &&
      (switches.named_off(effect) || (switches.rest == EffectSwitches::Rest::none && !switches.named_on(effect)))) {
    planned.on = false;
    planned.basis = Basis::asked;
    planned.reason = fmt::format("switched off; {}", reason);
  }
  return planned;
}

Plan make_plan(const Scene& scene, const Look& look, const EffectSwitches& switches, double error,
               const LightSettings& light, std::uint32_t seed, int threads, bool with_pilot) {
  Plan plan;
  plan.error_asked = error > 0;
  plan.error = plan.error_asked ? error : default_plan_error;
  const MeshForm form = mesh_form(*scene.mesh);
  // A floor sends light back to cloth of any form.
  const MeshForm lit_form = solid_ground(scene) ? MeshForm::folded : form;
  PlanPilot pilot;
  if (with_pilot) pilot = run_plan_pilot(scene, light, pilot_bounces(lit_form, switches), seed, threads);
  plan.effects = plan_model(look, pilot);

  PlannedEffect back =
      described(Effect::back, scene.back.has_value(), switches, fmt::format("the look names {}", look.back),
                "both sides are the same look", "name a look: --set back=NAME");
  back.share = pilot.back;
  plan.effects.push_back(back);

  plan.effects.push_back(described(Effect::maps, has_maps(scene), switches, "the look names textures",
                                   "the look has no textures", "give a field one: see docs/maps.md"));
  plan.effects.push_back(described(Effect::pattern, has_pattern(scene), switches, "the look names a pattern",
                                   "one look everywhere", "name one: pattern.mask and pattern.look"));
  const float gap = std::max(scene.front.gap, scene.back ? scene.back->gap : 0);
  PlannedEffect gaps = described(Effect::gaps, scene.has_gaps, switches,
                                 fmt::format("no thread covers {} of the cloth", percent(double(gap))),
                                 "the threads cover all of the cloth", "give the look less coverage");
  gaps.share = pilot.through_gaps;
  plan.effects.push_back(gaps);

  plan.effects.push_back(plan_weave(scene, look, switches));
  plan.effects.push_back(plan_self_shadowing(form, switches));
  Bounces bounces = plan_bounces(pilot, lit_form, switches, plan.error);
  plan.bounces = bounces.count;
  plan.bounce_share = plan.bounces > 0 ? switches.bounce_share.value_or(pilot.bounce_share) : 1;
  bounces.planned.cost *= double(plan.bounce_share);
  if (plan.bounce_share < 1)
    bounces.planned.reason += fmt::format("; followed by {} of the samples", percent(double(plan.bounce_share)));
  plan.effects.push_back(std::move(bounces.planned));

  plan.effects.push_back(plan_ground(scene, switches));
  plan.effects.push_back(plan_lens(scene, switches));
  plan.effects.push_back(plan_shutter(scene, switches));
  PlannedEffect backdrop = described(
      Effect::backdrop, scene.backdrop != Backdrop::none, switches,
      scene.backdrop == Backdrop::plain ? "one colour beside the cloth" : "the map is seen beside the cloth",
      "nothing is asked for beside the cloth", "say which: --backdrop environment");
  if (backdrop.on) backdrop.basis = Basis::asked;
  backdrop.share = pilot.backdrop;
  plan.effects.push_back(backdrop);
  plan.effects.push_back(plan_references(switches));
  plan.detail = measure_detail(*scene.mesh, detail_view(scene.camera, false), threads);
  plan.effects.push_back(plan_subdivision(*scene.mesh, plan.detail));
  return plan;
}

void apply_plan(const Plan& plan, Scene& scene, LightSettings& light) {
  light.bounces = plan.bounces;
  light.bounce_share = plan.bounce_share;
  for (const PlannedEffect& planned : plan.effects)
    if (!planned.on) remove_effect(planned.effect, scene, light);
}

void write_plan(JsonWriter& w, const Plan& plan) {
  const auto interval = [&](const char* name, const std::optional<Interval>& i) {
    if (i) w.key(name).open_object().member("value", i->value).member("low", i->low).member("high", i->high).close();
  };
  w.member("error", plan.error).member("error_asked", plan.error_asked).member("bounces", plan.bounces);
  w.member("bounce_share", plan.bounce_share);
  w.key("detail").open_object().member("edge_pixels", plan.detail.edge_pixels);
  w.member("off_pixels", plan.detail.off_pixels).member("normal_deg", plan.detail.normal_deg);
  w.member("rise_pixels", plan.detail.rise_pixels).close();
  w.key("effects").open_list();
  for (const PlannedEffect& p : plan.effects) {
    const EffectInfo& info = effect_info(p.effect);
    w.open_object().member("effect", info.name).member("what", info.what).member("on", p.on);
    w.member("basis", basis_name(p.basis)).member("reason", p.reason).member("switchable", info.switchable);
    interval("share_of_light", p.share);
    interval("loss", p.loss);
    w.member("cost", p.cost).close();
  }
  w.close();
}

std::string plan_json(const Plan& plan) {
  JsonWriter w(true);
  w.open_object();
  write_plan(w, plan);
  return w.close().text();
}

}  // namespace sateen
