#include "render/verify.h"

#include <fmt/format.h>

#include "render/compare.h"

namespace sateen {

namespace {

constexpr int verify_samples = 64;
constexpr std::uint32_t another_seed = 0x9e3779b9u;  // the pilot's own luck must not judge it

/// The scene as planned, or with one more effect.
struct Variant {
  Scene scene;
  LightSettings light;
};
Variant with_effect(const Scene& whole, Plan plan, Effect effect, const LightSettings& light) {
  plan.effects[size_t(effect)].on = true;
  if (effect == Effect::interreflection) plan.bounces = every_bounce;
  // Nothing else sends light of a closed body back to it: what was ruled out for want of gaps comes with them.
  if (effect == Effect::gaps)
    for (const Effect other : {Effect::self_shadowing, Effect::interreflection}) {
      PlannedEffect& planned = plan.effects[size_t(other)];
      if (planned.on || planned.basis != Basis::data) continue;
      planned.on = true;
      if (other == Effect::interreflection) plan.bounces = every_bounce;
    }
  plan.bounce_share = 1;
  Variant variant{whole, light};
  apply_plan(plan, variant.scene, variant.light);
  return variant;
}

Verdict judge(const Plan& plan, const PlannedEffect& planned, const Interval& loss) {
  Verdict verdict{planned.effect, true, loss, Verdict::Outcome::right, {}};
  if (planned.basis == Basis::asked)
    verdict.note = "as the user asked";
  else if (loss.low > plan.error)
    verdict.outcome = Verdict::Outcome::wrong;
  else if (loss.high > plan.error)
    verdict.outcome = Verdict::Outcome::undecided;
  return verdict;
}

}  // namespace

std::vector<Verdict> verify_plan(const Scene& scene, const Plan& plan, const LightSettings& light, double error_floor,
                                 std::uint32_t seed, int threads, const std::function<void(double)>& tell) {
  PixelGrid grid = grid_of(scene.camera);
  grid.samples = verify_samples;
  grid.place = {0.2f, 0.7f};
  std::vector<const PlannedEffect*> open;
  for (const PlannedEffect& planned : plan.effects)
    // Paths that end early are ruled out too, in part.
    if (effect_info(planned.effect).switchable && (!planned.on || planned.loss)) open.push_back(&planned);

  Scene as_planned = scene;
  LightSettings planned_light = light;
  apply_plan(plan, as_planned, planned_light);
  planned_light.bounce_share = 1;  // it changes the noise alone
  const GridPicture base = trace_picture(as_planned, planned_light, seed + another_seed, grid, threads);
  std::vector<Verdict> verdicts;
  for (const PlannedEffect* planned : open) {
    if (tell) tell(double(verdicts.size() + 1) / double(open.size() + 1));
    const Variant more = with_effect(scene, plan, planned->effect, light);
    const bool same = effects_text(more.scene, more.light) == effects_text(as_planned, planned_light) &&
                      more.light.bounces == planned_light.bounces;
    if (same) {
      verdicts.push_back({planned->effect, false, {}, Verdict::Outcome::right, planned->reason});
      continue;
    }
    const GridPicture on = trace_picture(more.scene, more.light, seed + another_seed, grid, threads);
    verdicts.push_back(judge(plan, *planned, picture_loss(differences(base, on, error_floor), error_floor)));
  }
  if (tell) tell(1);
  return verdicts;
}

void write_verdicts(JsonWriter& w, const std::vector<Verdict>& verdicts) {
  static const char* const outcomes[] = {"right", "undecided", "wrong"};
  w.key("verified").open_list();
  for (const Verdict& v : verdicts) {
    w.open_object().member("effect", effect_info(v.effect).name).member("tested", v.tested);
    if (v.tested)
      w.key("loss")
          .open_object()
          .member("value", v.loss.value)
          .member("low", v.loss.low)
          .member("high", v.loss.high)
          .close();
    w.member("outcome", outcomes[int(v.outcome)]).member("note", v.note).close();
  }
  w.close();
}

}  // namespace sateen
