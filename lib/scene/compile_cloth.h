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
  /// Largest difference, in any channel, between the reflectance that textures of `color` ask for and what the cloth
  /// shows at normal view where one texture of a number is at the end of its range; 0 where not both are there.
  float color_error = 0;
};

/// Compiles a look and the one that its pattern weaves in. InputError where a texture cannot be read, or as
/// compile_fabric says. `turn`: added to every warp angle [degrees]. `metres_per_uv`: what of the cloth one UV unit
/// spans, for textures with a size in centimetres.
///
/// Where a texture gives `color`, A is solved for every pixel from the reflectance at normal view of the threads with
/// the means of whatever else varies; a pixel that is out of reach gets the nearest A and is counted.
CompiledSide compile_side(const Look& look, const ColorManager& colors, const FabricParts& parts, float turn = 0,
                          float metres_per_uv = 1);

/// Whether some texture of a look or of its pattern's look has a size in centimetres.
bool has_sized_textures(const Look& look);

/// Puts both sides into the scene.
void set_sides(Scene& scene, CompiledSide front, std::optional<CompiledSide> back);

}  // namespace sateen
