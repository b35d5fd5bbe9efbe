#pragma once
#include "mesh/mesh.h"

namespace sateen {

/// Whether a mesh can keep light from itself.
enum class MeshForm {
  folded,  ///< it may
  flat,    ///< one plane, seen from either side
  convex   ///< a closed convex body, seen from outside
};

/// `flat` where all vertices lie in a plane to 1e-6 of the size. `convex` where the surface is closed (every edge
/// between exactly two faces), in one piece of a sphere's topology and bent outwards at every edge: then it is the
/// boundary of a convex body (van Heijenoort 1952). Quads of a limit surface are not quite flat; what a neighbour may
/// rise above a quad's mean plane is what its own corners do, and those at most three hundredths of its size. A folded
/// mesh costs next to nothing.
MeshForm mesh_form(const Mesh& mesh);

}  // namespace sateen
