#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/color.h"
#include "scene/scene.h"

namespace sateen {

/// One side of the cloth compiled from its look with the look's textures and pattern.
struct CompiledSide {
  Fabric fabric;                         ///< of the textures' means, which samplers and albedo tables go by
  std::shared_ptr<const SideMaps> maps;  ///< null where nothing varies
  std::vector<std::string> warnings;     ///< pixels out of range, counted
};

/// Compiles a look and the one that its pattern weaves in. InputError where a texture cannot be read, or as
/// compile_fabric says. `turn`: added to every warp angle [degrees].
///
/// Where a texture gives `color`, A is solved for every pixel from the reflectance at normal view of the threads with
/// the means of whatever else varies; a pixel that is out of reach gets the nearest A and is counted.
CompiledSide compile_side(const Look& look, const ColorManager& colors, const FabricParts& parts, float turn = 0);

/// Puts both sides into the scene.
void set_sides(Scene& scene, CompiledSide front, std::optional<CompiledSide> back);

}  // namespace sateen
