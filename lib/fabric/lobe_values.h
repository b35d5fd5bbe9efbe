#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "fabric/fabric.h"

namespace sateen {

/// Two unit directions in the cloth frame: x warp, y weft, z the cloth's normal.
struct LobePair {
  Vec3 wi, wo;
};

/// Reads {"rows": [{"wi": [x, y, z], "wo": [x, y, z]}, ...]}, extra keys ignored. InputError with file:line:column of
/// every row that is not a pair of unit directions (within 1e-3; they are made exact).
std::vector<LobePair> read_lobe_pairs(const std::filesystem::path& path);
std::vector<LobePair> parse_lobe_pairs(const std::string& text, const std::string& file);

/// F with its cosine inside and the sampler's density, for every pair, from the kernel that renders. Both are 0 where
/// wo is not above the cloth.
std::vector<BsdfValue> lobe_values(const Fabric& fabric, FabricSampler sampler, const std::vector<LobePair>& pairs);

/// {"rows": [{"f": [r, g, b], "pdf": p}, ...]}, one row a line, nine digits: every float exactly.
std::string lobe_values_text(const std::vector<BsdfValue>& values);

const std::vector<std::string>& sampler_names();           ///< "uniform", "talk", "table"
FabricSampler sampler_from_name(const std::string& name);  ///< InputError with the nearest name

}  // namespace sateen
