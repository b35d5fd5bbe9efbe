#include "study/cost_steps.h"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/subdivide.h"

namespace sateen {

namespace {

void ask_bounces(RenderRequest& request, int number) {
  request.light.bounces = number;
  request.effects.bounces = number;
  std::erase(request.effects.on, Effect::interreflection);
  std::erase(request.effects.off, Effect::interreflection);
}

// The share of the samples that follow bounces is planned for their number, as beside --bounces.
CostSteps bounces(const CostBase& base) {
  const int own = base.light.bounces;
  std::vector<int> numbers{0, 1, 2, 4};
  if (std::max(own, base.most_bounces) <= numbers.back()) numbers.push_back(8);  // else those are the finest
  for (const int each : {own, base.most_bounces})
    if (std::find(numbers.begin(), numbers.end(), each) == numbers.end()) numbers.push_back(each);
  std::sort(numbers.begin(), numbers.end());
  CostSteps made{{"bounces"}, {}};
  for (const int number : numbers) {
    CostStep step{fmt::format("{}", number), {fmt::format("--bounces {}", number)}, number == own, base.light};
    step.ask = [number](RenderRequest& request) { ask_bounces(request, number); };
    if (!step.asked) {
      RenderRequest request{{}, base.light, base.effects};
      step.ask(request);
      step.light.bounces = number;
      step.light.bounce_share =
          make_plan(base.described, base.look,
                    {request.effects, 0, base.error_floor, request.light, base.seed, base.threads})
              .bounce_share;
    }
    made.steps.push_back(std::move(step));
  }
  return made;
}

CostSteps strategies(const CostBase& base) {
  CostSteps made{{"strategy"}, {}};
  // Not advised: strategies of one picture differ by less than a few short renders tell, and advice would flip by
  // seed.
  made.list.biased = made.list.has_finest = made.list.advised = false;
  made.list.note = "all converge to the same picture: true error squared times time decides";
  for (const std::string& name : strategy_names()) {
    LightSettings light = base.light;
    light.strategy = strategy_from_name(name);
    made.steps.push_back({name,
                          {"--strategy " + name},
                          light.strategy == base.light.strategy,
                          light,
                          {},
                          [light](RenderRequest& request) { request.light.strategy = light.strategy; }});
  }
  return made;
}

CostSteps candidates(const CostBase& base) {
  const bool own = base.light.strategy == Strategy::resampled;
  CostSteps made{{"candidates"}, {}};
  made.list.biased = made.list.advised = false;
  made.list.note = "of strategy resampled; true error squared times time decides";
  const CandidateCounts settled = base.light.candidates;
  std::vector<CandidateCounts> counts{1, 2, 4, 8, 16};
  if (own && std::find(counts.begin(), counts.end(), settled) == counts.end()) counts.push_back(settled);
  for (const CandidateCounts& each : counts) {
    LightSettings light = base.light;
    light.strategy = Strategy::resampled;
    light.candidates = each;
    const std::string text = candidates_text(each);
    made.steps.push_back({text,
                          {"--strategy resampled", "--candidates " + text},
                          own && each == settled,
                          light,
                          {},
                          [each](RenderRequest& request) {
                            request.light.strategy = Strategy::resampled;
                            request.light.candidates = each;
                            request.effects.candidates = each;
                          }});
  }
  return made;
}

void follow_plan(const CostBase& base, Scene& scene) {
  LightSettings planned = base.light;
  apply_plan(base.plan, scene, planned);
}

CostSteps levels(const CostBase& base) {
  constexpr std::int64_t most_triangles = 6'000'000;
  const int own = base.settings.level;
  int finest = own;
  std::int64_t triangles = base.scene.mesh->triangles();
  while (finest < finest_level && finest < own + 2 && 4 * triangles <= most_triangles) ++finest, triangles *= 4;
  CostSteps made{{"subdivision level"}, {}};
  for (int level = std::max(0, finest - 4); level <= finest; ++level)
    made.steps.push_back({fmt::format("{}", level),
                          {fmt::format("--level {}", level)},
                          level == own,
                          base.light,
                          [&base, level](Scene& scene) {
                            SceneSettings settings = base.settings;
                            settings.level = level;
                            SceneReport report;
                            const Camera camera = scene.camera;  // one framing for all
                            scene = assemble_scene(settings, base.colors, report);
                            scene.camera = camera;
                            set_stage(scene, settings.stage, base.threads);
                            follow_plan(base, scene);
                          },
                          [level](RenderRequest& request) { request.scene.level = level; }});
  return made;
}

CostSteps approximation(const CostBase& base, const Approximation& each) {
  const Approximations& own = base.settings.approximations;
  CostSteps made{{each.name}, {}};
  made.list.biased = each.biased;
  made.list.advised = each.advised;
  made.list.note = each.note;
  for (const std::string& text : each.ladder(own, base.scene)) {
    SceneSettings settings = base.settings;
    each.read(text, settings.approximations);
    CostStep step{text, {}, text == each.text(own), base.light};
    if (text != each.text({})) step.flags = {each.flag + " " + text};
    step.make = [&base, settings, &each](Scene& scene) {
      each.rebuild(settings, base.colors, scene);
      follow_plan(base, scene);
    };
    step.ask = [text, &each](RenderRequest& request) { each.read(text, request.scene.approximations); };
    made.steps.push_back(std::move(step));
  }
  return made;
}

}  // namespace

std::string effects_flags_of(const Plan& finest, const Plan& plain, EffectSwitches& effects) {
  bool differs = false;
  for (const PlannedEffect& each : finest.effects) {
    // Bounces have a list of their own.
    if (each.effect == Effect::interreflection || !effect_info(each.effect).switchable) continue;
    if (each.on == plain.of(each.effect).on) continue;
    differs = true;
    (each.on ? effects.on : effects.off).push_back(each.effect);
  }
  if (!differs) return "";
  using Rest = EffectSwitches::Rest;
  std::string words = effects.rest == Rest::all ? "all" : effects.rest == Rest::none ? "none" : "auto";
  for (const Effect effect : effects.on) words += ",+" + effect_info(effect).name;
  for (const Effect effect : effects.off) words += ",-" + effect_info(effect).name;
  return "--effects " + words;
}

std::vector<CostSteps> cost_steps(const CostBase& base) {
  std::vector<CostSteps> all{bounces(base), levels(base)};
  for (const Approximation& each : approximation_list()) all.push_back(approximation(base, each));
  all.push_back(strategies(base));
  all.push_back(candidates(base));
  return all;
}

RenderRequest request_of(const std::vector<CostSteps>& all, const std::vector<PriceList>& lists,
                         const std::vector<int>& chosen, RenderRequest asked) {
  for (size_t i = 0; i < chosen.size(); ++i) {
    if (chosen[i] < 0 || lists[i].prices[size_t(chosen[i])].asked) continue;
    for (const CostSteps& each : all)
      for (const CostStep& step : each.steps)
        if (each.list.name == lists[i].name && step.setting == lists[i].prices[size_t(chosen[i])].setting)
          step.ask(asked);
  }
  return asked;
}

}  // namespace sateen
