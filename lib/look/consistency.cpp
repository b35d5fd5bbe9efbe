#include "look/consistency.h"

#include <fmt/format.h>

#include <algorithm>

namespace sateen {

void check_consistency(const Look& look,
                       const std::function<void(const std::vector<std::string>&, std::string, std::string)>& report) {
  // Thinner than this the shares drown in the rounding of float.
  constexpr float least_length = 1e-3f, least_coverage = 1e-3f;
  for (const auto& [name, family] : {std::pair<std::string, const ThreadFamily&>("warp", look.warp),
                                     std::pair<std::string, const ThreadFamily&>("weft", look.weft)}) {
    const size_t pieces = family.offsets_deg.size() - 1;
    if (family.lengths.size() != pieces)
      report({name + ".lengths", name + ".offsets_deg"},
             fmt::format("{} has {} lengths, expected {} for its {} offsets", name, family.lengths.size(), pieces,
                         pieces + 1),
             "one length for each piece between neighbouring offsets");
    else if (*std::max_element(family.lengths.begin(), family.lengths.end()) < least_length)
      report({name + ".lengths", name + ".offsets_deg"},
             fmt::format("the lengths of {} are all below {:g}, expected one above", name, least_length), {});
  }
  if (look.pattern_look.empty() && (look.pattern_mask > 0 || look.textures.contains("pattern.mask")))
    report({"pattern.mask"}, "the pattern has a mask but no look to weave in", "name one: \"look\": \"...\"");
  // What textures hold is seen when the scene is put together.
  if (look.textures.contains("warp.coverage") || look.textures.contains("weft.coverage")) return;
  const float sum = look.warp.coverage + look.weft.coverage;
  constexpr float rounding = 1e-4f;
  if (sum > 1 + rounding || sum < least_coverage)
    report({"weft.coverage", "warp.coverage"},
           fmt::format("the coverage of warp ({}) and weft ({}) adds up to {:.4g}, expected {:g} to 1",
                       look.warp.coverage, look.weft.coverage, sum, least_coverage),
           {});
}

}  // namespace sateen
