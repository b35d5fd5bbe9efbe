#pragma once
#include <string>

#include "look/wif_text.h"

namespace sateen {

/// What a draft says of its threads that no look takes from it yet, by name, in one sentence: colours, spacing,
/// thickness and their unit, symbols; by whole sections or by the keys of [WARP] and [WEFT]. Empty where it says
/// nothing of them.
std::string unused_thread_values(const WifText& text);

}  // namespace sateen
