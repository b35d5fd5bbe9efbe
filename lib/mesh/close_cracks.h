#pragma once
#include "mesh/mesh.h"

namespace sateen {

/// Gives vertices that lie apart by no more than rounding, 5e-7 of the mesh's size, the same position: borders that
/// were cut apart and refined each by itself then meet without a crack.
void close_cracks(Mesh& mesh);

}  // namespace sateen
