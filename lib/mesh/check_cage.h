#pragma once
#include <span>
#include <string>

#include "mesh/control_mesh.h"

namespace sateen {

/// InputError where the cage's arrays do not fit together: sizes below 3, indices out of range, a face that meets a
/// vertex twice, numbers that are not finite. read_obj never makes such a cage.
void check_cage(const ControlMesh& cage);

bool meets_a_vertex_twice(std::span<const int> corners);

/// Why OpenSubdiv cannot count the cage: it has 16 bits for the corners of a face and the faces of a vertex. Empty
/// where it can.
std::string beyond_limits(const ControlMesh& cage);

/// "1 face", "2 faces".
std::string counted(long long count, const std::string& thing);

}  // namespace sateen
