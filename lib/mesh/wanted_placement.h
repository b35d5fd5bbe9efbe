#pragma once
#include "mesh/control_mesh.h"

namespace sateen {

/// How settle_placement() would move and scale a cage as its positions are now.
Placement wanted_placement(const ControlMesh& cage);

}  // namespace sateen
