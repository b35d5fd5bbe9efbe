#pragma once
#include <string>

namespace sateen {

/// The project's own space that goes by this name in configs and files, without case, blanks and signs: acescg for
/// "lin_ap1_scene" and "ACES - ACEScg", srgb_texture for "srgb_rec709_scene". Empty where it is none of them.
std::string own_space_called(const std::string& name);

/// Whether a file's name for its space says no more than that there is one: "Linear", "scene_linear", "unknown".
bool says_nothing(const std::string& name);

}  // namespace sateen
