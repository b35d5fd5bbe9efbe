#pragma once
#include <cstddef>
#include <string_view>

namespace sateen {

/// How unlike two names are: Damerau-Levenshtein distance, case ignored; at most 1 where one holds the other, of three
/// letters at least.
std::size_t name_distance(std::string_view a, std::string_view b);

}  // namespace sateen
