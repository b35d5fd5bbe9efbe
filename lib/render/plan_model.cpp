#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "render/plan_parts.h"

namespace sateen {

namespace {

/// From the least to the largest value that some point of the cloth has.
struct Range {
  float low = 0, high = 0;
};

/// What one family of a fabric's threads is like, as it was compiled with its textures.
struct FamilyNumbers {
  Range coverage, eta, k_d;
  int pieces = 0;  ///< of its tangent curve
  bool slopes = false;

  bool there() const { return coverage.high > 0; }
  bool bends() const { return there() && (slopes || pieces > 1); }
};

struct FabricNumbers {
  std::string of;  ///< "", "pattern", "back", "back's pattern"
  std::array<FamilyNumbers, 2> family;
};

FamilyNumbers numbers_of(const Fabric& fabric, const FabricMaps& maps, size_t family) {
  const Threads<float>& t = fabric.threads;
  FamilyNumbers out;
  const int first = t.first[family];
  if (first < 0) return out;
  const auto range = [&](const FabricMaps::Map& map, float constant) {
    return map ? Range{map->low[0], map->high[0]} : Range{constant, constant};
  };
  double coverage = 0;
  std::set<std::array<float, 4>> pieces;
  for (size_t k = 0; k < size_t(t.count); ++k) {
    if ((t.along_x[k] > 0) != (family == 0) || !(t.weight[k] > 0)) continue;
    coverage += double(t.weight[k]);
    pieces.insert({t.start[k], t.span[k], t.own.cosine[k], t.own.sine[k]});
    out.slopes = out.slopes || t.flat[k] == 0;
  }
  out.pieces = int(pieces.size());
  out.coverage = range(maps.coverage[family], float(coverage));
  out.eta = range(maps.eta[family], std::sqrt(t.eta2[size_t(first)]));
  out.k_d = range(maps.k_d[family], t.isotropic[size_t(first)]);
  return out;
}

std::vector<FabricNumbers> numbers_of(const Scene& scene) {
  std::vector<FabricNumbers> all;
  const auto add = [&](const std::string& of, const Fabric& fabric, const FabricMaps& maps) {
    all.push_back({of, {numbers_of(fabric, maps, 0), numbers_of(fabric, maps, 1)}});
  };
  const auto add_side = [&](const std::string& of, const std::string& pattern, const Fabric& fabric,
                            const std::shared_ptr<const SideMaps>& maps) {
    add(of, fabric, maps ? maps->own : FabricMaps());
    if (maps && maps->pattern) add(pattern, maps->pattern->fabric, maps->pattern->maps);
  };
  add_side("", "pattern", scene.front, scene.front_maps);
  if (scene.back) add_side("back", "back's pattern", *scene.back, scene.back_maps);
  return all;
}

std::string range_text(const Range& r) {
  const std::string low = fmt::format("{:.4g}", r.low), high = fmt::format("{:.4g}", r.high);
  return low == high ? low : low + " to " + high;
}

/// "eta 1.4 in the warp, 1.345 in the weft; pattern: eta 1.46 in warp and weft".
std::string numbers_text(const std::vector<FabricNumbers>& all, const char* name, Range FamilyNumbers::*number) {
  std::string text, before;
  for (const FabricNumbers& fabric : all) {
    const auto& [warp, weft] = fabric.family;
    const std::string a = range_text(warp.*number), b = range_text(weft.*number);
    std::string one = !warp.there()   ? fmt::format("{} {} in the weft, there is no warp", name, b)
                      : !weft.there() ? fmt::format("{} {} in the warp, there is no weft", name, a)
                      : a == b        ? fmt::format("{} {} in warp and weft", name, a)
                                      : fmt::format("{} {} in the warp, {} in the weft", name, a, b);
    if (one == before) continue;  // a pattern of the same threads
    before = one;
    text += (text.empty() ? "" : "; ") + (fabric.of.empty() ? one : fabric.of + ": " + one);
  }
  return text;
}

std::string pieces_text(const std::vector<FabricNumbers>& all) {
  std::string text, before;
  for (const FabricNumbers& fabric : all) {
    const std::string one =
        fmt::format("the warp bends in {} pieces, the weft in {}", fabric.family[0].pieces, fabric.family[1].pieces);
    if (one == before) continue;
    before = one;
    text += (text.empty() ? "" : "; ") + (fabric.of.empty() ? one : fabric.of + ": " + one);
  }
  return text;
}

/// What a look's own numbers decide.
PlannedEffect of_model(Effect effect, bool on, const std::string& reason, std::optional<Interval> share = {}) {
  return {effect, on, on ? Basis::look : Basis::data, reason, share, {}, 0};
}

}  // namespace

std::vector<PlannedEffect> plan_model(const Scene& scene, const PlanPilot& pilot) {
  const std::vector<FabricNumbers> all = numbers_of(scene);
  const auto some = [&](const auto& test) {
    return std::any_of(all.begin(), all.end(), [&](const FabricNumbers& fabric) {
      return std::any_of(fabric.family.begin(), fabric.family.end(),
                         [&](const FamilyNumbers& f) { return f.there() && test(f); });
    });
  };
  const bool both = std::any_of(all.begin(), all.end(), [](const FabricNumbers& fabric) {
    return fabric.family[0].there() && fabric.family[1].there();
  });
  const bool surface = some([](const FamilyNumbers& f) { return f.eta.high > 1; });
  const bool directed = some([](const FamilyNumbers& f) { return f.k_d.low < 1; });
  const bool isotropic = some([](const FamilyNumbers& f) { return f.k_d.high > 0; });
  const bool bends = some([](const FamilyNumbers& f) { return f.bends(); });
  const std::string k_d = numbers_text(all, "k_d", &FamilyNumbers::k_d);
  return {of_model(Effect::families, both,
                   both ? numbers_text(all, "coverage", &FamilyNumbers::coverage) + "; the light is the weft's"
                        : "one family covers nothing",
                   pilot.weft),
          of_model(Effect::surface_lobe, surface,
                   surface ? numbers_text(all, "eta", &FamilyNumbers::eta) : "eta is 1: nothing is reflected",
                   pilot.surface),
          of_model(Effect::directed_volume, directed, directed ? k_d : "k_d is 1: all of it is even", pilot.volume),
          of_model(Effect::isotropic_volume, isotropic, isotropic ? "of the volume's light, " + k_d : "k_d is 0"),
          of_model(Effect::tangent_curve, bends,
                   bends ? pieces_text(all) : "the threads lie straight: one tangent each")};
}

float most_gap(const Scene& scene) {
  float most = 0;
  for (const FabricNumbers& fabric : numbers_of(scene))
    most = std::max(most, 1 - fabric.family[0].coverage.low - fabric.family[1].coverage.low);
  return most;
}

}  // namespace sateen
