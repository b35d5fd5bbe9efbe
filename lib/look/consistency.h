#pragma once
#include <functional>
#include <string>
#include <vector>

#include "look/look.h"

namespace sateen {

/// Checks what no field can tell alone: lengths against offsets, a curve with some length, coverage of both families
/// from 0.001 to 1 together, a mask with its look. `report` takes the fields concerned, found and expected, and the
/// remedy.
void check_consistency(
    const Look& look,
    const std::function<void(const std::vector<std::string>& paths, std::string message, std::string help)>& report);

}  // namespace sateen
