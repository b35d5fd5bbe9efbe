#pragma once
#include <string>
#include <vector>

#include "look/look.h"

namespace sateen {

/// What an unknown key of a look file, or an unknown path of --set, was probably meant to be. `group` is "warp",
/// "weft", "pattern", or empty at the top level.
std::string key_help(const std::string& key, const std::string& group);

/// apply_overrides that returns the paths of the fields it has set, a shorthand's both.
std::vector<std::string> apply_overrides_naming_fields(Look& look, const std::vector<std::string>& overrides);

}  // namespace sateen
