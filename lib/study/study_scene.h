#pragma once
#include <string>
#include <vector>

#include "render/assemble.h"

namespace sateen {

/// Name of the constant map of radiance 1, the light of a furnace; it needs no file.
inline constexpr const char* white_light = "white";

/// Looks and lights that a study covers unless told otherwise.
const std::vector<std::string>& study_looks();
const std::vector<std::string>& study_lights();

/// The map of a light's name as assemble_scene() takes it. "interior", where no such map is on the search path, is
/// looked for at ../shared/hdri beside the project; empty where it is not there either.
std::string study_map(const std::string& light);

/// What a plot calls a map: the name, or the file's name without folder and extension.
std::string light_label(const std::string& map);

/// assemble_scene(), which also knows `white_light`.
Scene assemble_study_scene(SceneSettings settings, const ColorManager& colors, SceneReport& report);

/// The smallest share of the sphere that half of a map's luminous energy comes from, 0 to 1; 0.5 for a constant map.
double half_light_share(const Environment& environment);

}  // namespace sateen
