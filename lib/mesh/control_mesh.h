#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "math/vector.h"
#include "mesh/placement.h"

namespace sateen {

/// A cage as its author wrote it: n-gons, face-varying UVs, OpenSubdiv tags. Y is up; lengths in scene units, or as
/// the placement says.
struct ControlMesh {
  struct Crease {
    std::vector<int> vertices;
    float sharpness = 0;
  };  ///< chain of vertices; sharpness 0 to 10
  struct Corner {
    int vertex = 0;
    float sharpness = 0;
  };
  enum class Scheme { catmull_clark, loop, bilinear };
  enum class Boundary { none, edge_only, edge_and_corner };
  enum class FvarBoundary { none, corners_only, corners_plus1, corners_plus2, boundaries, all };

  std::vector<Vec3> positions;
  std::vector<Vec2> uvs;              ///< may be empty
  std::vector<int> face_sizes;        ///< corners of each face
  std::vector<int> position_indices;  ///< one a corner
  std::vector<int> uv_indices;        ///< one a corner, -1 where the corner has none; empty when no face has
  std::vector<Crease> creases;
  std::vector<Corner> corners;
  std::vector<int> holes;  ///< faces that are cut out
  Scheme scheme = Scheme::catmull_clark;
  Boundary boundary = Boundary::edge_and_corner;
  FvarBoundary fvar_boundary = FvarBoundary::corners_plus1;
  float metres_per_uv = 0;  ///< 0: unknown
  Placement placement;
  std::string name;
  std::vector<std::string> warnings;  ///< dropped faces and the like, each with place and count
};

}  // namespace sateen
