#include "render/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"
#include "look/json.h"

namespace sateen {

namespace {

std::vector<std::string> switchable_names() {
  std::vector<std::string> names;
  for (const EffectInfo& info : effect_list())
    if (info.switchable) names.push_back(info.name);
  return names;
}

bool contains(const std::vector<Effect>& effects, Effect effect) {
  return std::find(effects.begin(), effects.end(), effect) != effects.end();
}

void close_all_gaps(Fabric& fabric) {
  // The darkening by Q stays: it is part of the cloth's own light.
  fabric.gap = 0;
  close_gaps(fabric.weave);
}

/// Changes the maps of both sides, and lets go of those that say nothing any more.
template <class Change>
void keep_maps(Scene& scene, const Change& change) {
  for (std::shared_ptr<const SideMaps>* side : {&scene.front_maps, &scene.back_maps}) {
    if (!*side) continue;
    auto changed = std::make_shared<SideMaps>(**side);
    change(*changed);
    *side = changed->own.any() || changed->pattern ? changed : nullptr;
  }
  scene.has_maps = scene.front_maps || scene.back_maps;
}

}  // namespace

const std::vector<EffectInfo>& effect_list() {
  static const std::vector<EffectInfo> all{
      {Effect::families, "families", "two families of threads", false},
      {Effect::surface_lobe, "surface-lobe", "highlight at the surface of the threads", false},
      {Effect::directed_volume, "directed-volume", "directed glow from inside the threads", false},
      {Effect::isotropic_volume, "isotropic-volume", "even glow from inside the threads", false},
      {Effect::tangent_curve, "tangent-curve", "threads that bend over and under each other", false},
      {Effect::back, "back", "another look on the back of the cloth", true},
      {Effect::maps, "maps", "colours and numbers from textures", true},
      {Effect::pattern, "pattern", "a second look woven in by a mask", true},
      {Effect::gaps, "gaps", "light and sight straight through between the threads", true},
      {Effect::weave, "weave", "threads one by one where the camera is near", true},
      {Effect::self_shadowing, "self-shadowing", "folds that keep light from one another", true},
      {Effect::interreflection, "interreflection", "light from fold to fold", true},
      {Effect::ground, "ground", "what the cloth stands on", true},
      {Effect::depth_of_field, "depth-of-field", "a lens that is sharp at one distance", true},
      {Effect::motion_blur, "motion-blur", "a shutter that is open while things turn", true},
      {Effect::backdrop, "backdrop", "what is seen beside the cloth", true},
      {Effect::references, "references", "grey and chrome balls and a colour chart", true},
      {Effect::subdivision, "subdivision", "the limit surface of the mesh", false},
  };
  return all;
}

const EffectInfo& effect_info(Effect effect) {
  return effect_list()[size_t(effect)];
}

Effect effect_from_name(const std::string& name) {
  std::vector<std::string> names;
  for (const EffectInfo& info : effect_list()) {
    if (info.name == name) return info.effect;
    names.push_back(info.name);
  }
  throw InputError(fmt::format("there is no effect {}", shown_name(name)), suggestion(name, names));
}

bool EffectSwitches::named_on(Effect effect) const {
  return contains(on, effect);
}
bool EffectSwitches::named_off(Effect effect) const {
  return contains(off, effect);
}
bool EffectSwitches::is_asked(Effect effect) const {
  return !named_off(effect) && (named_on(effect) || rest == Rest::all);
}
bool EffectSwitches::is_off(Effect effect) const {
  return named_off(effect) || (rest == Rest::none && !named_on(effect));
}

EffectSwitches read_effects(const std::string& list) {
  EffectSwitches switches;
  for (size_t at = 0; at <= list.size();) {
    const size_t end = std::min(list.find(',', at), list.size());
    const std::string word = list.substr(at, end - at);
    at = end + 1;
    if (word == "auto" || word == "all" || word == "none") {
      switches.rest = word == "auto"  ? EffectSwitches::Rest::automatic
                      : word == "all" ? EffectSwitches::Rest::all
                                      : EffectSwitches::Rest::none;
      continue;
    }
    if (word.empty() || (word[0] != '+' && word[0] != '-')) {
      const std::vector<std::string> names = switchable_names();
      const std::string near = nearest_name(word, names);
      throw InputError(
          fmt::format("--effects has {}, expected auto, all, none, or names with + or -", shown_name(word)),
          near.empty() ? suggestion(word, {"auto", "all", "none"}) : fmt::format("did you mean +{}?", near));
    }
    const Effect effect = effect_from_name(word.substr(1));
    if (!effect_info(effect).switchable)
      throw InputError(fmt::format("{} is part of the cloth model and cannot be switched", word.substr(1)),
                       fmt::format("change the look, or switch one of {}", fmt::join(switchable_names(), ", ")));
    (word[0] == '+' ? switches.on : switches.off).push_back(effect);
    if (switches.named_on(effect) && switches.named_off(effect))
      throw InputError(fmt::format("--effects has both +{0} and -{0}", word.substr(1)), "leave one of them out");
  }
  return switches;
}

bool has_maps(const Scene& scene) {
  const auto some = [](const std::shared_ptr<const SideMaps>& side) {
    return side && (side->own.any() || (side->pattern && side->pattern->maps.any()));
  };
  return some(scene.front_maps) || some(scene.back_maps);
}

bool has_pattern(const Scene& scene) {
  return (scene.front_maps && scene.front_maps->pattern) || (scene.back_maps && scene.back_maps->pattern);
}

void remove_effect(Effect effect, Scene& scene, LightSettings& light) {
  switch (effect) {
    case Effect::back:
      scene.back.reset();
      break;
    case Effect::maps:
      // The pattern is another effect: its mask stays, with the plain values of both looks.
      keep_maps(scene, [](SideMaps& side) {
        side.own = {};
        if (side.pattern) side.pattern->maps = {};
      });
      break;
    case Effect::pattern:
      keep_maps(scene, [](SideMaps& side) { side.pattern.reset(); });
      break;
    case Effect::gaps:
      close_all_gaps(scene.front);
      if (scene.back) close_all_gaps(*scene.back);
      keep_maps(scene, [](SideMaps& side) {
        if (side.pattern) close_all_gaps(side.pattern->fabric);
      });
      scene.has_gaps = false;
      break;
    case Effect::weave:
      scene.near_weave_pixel = 0;
      break;
    case Effect::self_shadowing:
      scene.self_shadowing = false;
      renew_openness(scene);
      break;
    case Effect::interreflection:
      light.bounces = 0;
      break;
    case Effect::backdrop:
      scene.backdrop = Backdrop::none;
      break;
    case Effect::ground:
      if (solid_ground(scene)) renew_openness(scene);
      scene.ground.reset();
      break;
    case Effect::depth_of_field:
      scene.lens.reset();
      break;
    case Effect::motion_blur:
      if (scene.shutter) renew_openness(scene);
      scene.shutter.reset();
      break;
    case Effect::references:  // laid over the picture
    case Effect::subdivision:
    case Effect::families:
    case Effect::surface_lobe:
    case Effect::directed_volume:
    case Effect::isotropic_volume:
    case Effect::tangent_curve:
      break;  // a look's own numbers decide
  }
}

std::string effects_text(const Scene& scene, const LightSettings& light) {
  std::vector<std::string> names;
  const auto add = [&](bool on, Effect effect) {
    if (on) names.push_back(effect_info(effect).name);
  };
  add(scene.back.has_value(), Effect::back);
  add(has_maps(scene), Effect::maps);
  add(has_pattern(scene), Effect::pattern);
  add(scene.has_gaps, Effect::gaps);
  add(scene.near_weave_pixel > 0, Effect::weave);
  add(scene.self_shadowing, Effect::self_shadowing);
  add(light.bounces > 0, Effect::interreflection);
  add(scene.ground.has_value(), Effect::ground);
  add(scene.lens.has_value(), Effect::depth_of_field);
  add(scene.shutter.has_value(), Effect::motion_blur);
  add(scene.backdrop != Backdrop::none, Effect::backdrop);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ","));
}

}  // namespace sateen
