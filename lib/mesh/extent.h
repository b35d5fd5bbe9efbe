#pragma once
#include <string>
#include <vector>

#include "mesh/control_mesh.h"
#include "mesh/mesh.h"

namespace sateen {

/// Throws InputError for a mesh of which nothing can be seen, none of its faces having an area, with the reason as
/// the cage that it was made from tells it: corners in one point or on a line, or faces that are lost beside how far
/// apart they lie. Returns what is to be told of one whose faces keep few steps beside that, or that lies so far from
/// the origin that it may have been rounded before it was written.
std::vector<std::string> check_extent(const ControlMesh& cage, const Mesh& mesh);

}  // namespace sateen
