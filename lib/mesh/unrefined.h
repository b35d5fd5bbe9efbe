#pragma once
#include "mesh/control_mesh.h"
#include "mesh/mesh.h"

namespace sateen {

/// The cage itself as a mesh, for cages that OpenSubdiv refuses: quads as they are, other faces as fans from their
/// first corner, holes cut; normals are means of the faces around a vertex (weighted by area), derivatives those of
/// the faces' corners. Vertices are split where texture coordinates are.
Mesh unrefined_mesh(const ControlMesh& cage);

}  // namespace sateen
