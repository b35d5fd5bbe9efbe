#pragma once
#include <vector>

#include "mesh/mesh.h"

namespace sateen {

/// An edge of the mesh that has quads on one side only. Vertices that were split at seams count as one.
struct HemEdge {
  std::uint32_t a, b;
  float curvature;  ///< of the hem in the plane of the surface, 1 / scene units; 0 at corners (turns of 45 degrees)
};
std::vector<HemEdge> hem_edges(const Mesh& mesh);

}  // namespace sateen
