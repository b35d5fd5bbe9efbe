#pragma once
#include <optional>
#include <vector>

#include "mesh/control_mesh.h"

namespace sateen {

/// A cage that was cut where it is no surface. OpenSubdiv's masks of limit tangents and its patches are sized for
/// manifolds and are written out of bounds elsewhere.
struct CutCage {
  ControlMesh cage;
  std::vector<int> origin;      ///< of each vertex: the vertex of the given cage
  int edges = 0, vertices = 0;  ///< of the given cage, that were cut
};

/// Empty where every edge has one face or two that run along it opposite ways, and the faces around every vertex
/// make one fan. Elsewhere vertices are doubled, one for each fan, so that all of that holds; nothing moves. As in
/// OpenSubdiv a cut edge is infinitely sharp, and so is a cut vertex, but where two cut edges and nothing else that
/// is sharp pass through it, the pieces keep a common smooth border. Creases and corners follow; with
/// Boundary::none, faces at a border of the given cage become holes, as they would there.
std::optional<CutCage> cut_into_manifolds(const ControlMesh& cage);

}  // namespace sateen
