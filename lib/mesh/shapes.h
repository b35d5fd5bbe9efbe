#pragma once
#include <string>
#include <vector>

#include "mesh/control_mesh.h"

namespace sateen {

/// Names of the cages that need no file: swatch, sphere, drape, skirt.
std::vector<std::string> built_in_shapes();
bool is_built_in_shape(const std::string& name);

/// The cage of a built-in shape, in metres, Y up, standing on or hanging over y = 0; UVs in metres along the cloth's
/// own warp and weft (metres_per_uv = 1). InputError with the nearest name when unknown.
ControlMesh built_in_shape(const std::string& name);

}  // namespace sateen
