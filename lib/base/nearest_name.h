#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sateen {

/// The candidate closest to `name` by Damerau-Levenshtein distance (case ignored), or an empty string when none
/// is within a third of the name's length (at least 1, at most 4 edits).
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// "did you mean X?" or, where nothing is near, "known: a, b, c".
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace sateen
