#pragma once
#include <filesystem>
#include <string_view>

#include "mesh/control_mesh.h"

namespace sateen {

/// Reads a Wavefront OBJ with OpenSubdiv's `t` tags. Positions, texture coordinates and faces are read; groups,
/// materials, normals and lines are passed over. InputError with file:line:column, all errors at once.
ControlMesh read_obj(const std::filesystem::path& path);
ControlMesh parse_obj(std::string_view text, const std::string& name);

}  // namespace sateen
