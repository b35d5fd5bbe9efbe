#pragma once
#include "mesh/control_mesh.h"
#include "mesh/mesh.h"

namespace sateen {

/// Refines the cage uniformly `level` times (0 to 6) and puts every vertex on the limit surface, with limit
/// tangents. A cage that OpenSubdiv refuses is returned unrefined with a warning.
Mesh subdivide(const ControlMesh& cage, int level, int threads = 0);

}  // namespace sateen
