#pragma once
#include "mesh/control_mesh.h"

namespace sateen {

/// Borders of a cage that lie on one another: pairs of edges with one face each, whose ends coincide to a thousandth
/// of the shorter edge, run opposite ways, and are the only two there.
struct Touching {
  int edges = 0;     ///< pairs
  int pieces = 0;    ///< of the cage, that have such an edge; pieces are joined by common vertices
  int vertices = 0;  ///< that welding does away with
};
Touching touching_borders(const ControlMesh& cage);

/// Joins them: faces use one vertex for all that coincide. Texture coordinates stay as they are, so that a seam in
/// them remains; creases and corners follow. The first of them stays, the others go.
Touching weld_borders(ControlMesh& cage);

/// "its 2 pieces touch along 3 edges but are not joined: a crease shows there ...", with the remedy; empty where
/// nothing touches.
std::string touching_text(const Touching& touching);

}  // namespace sateen
