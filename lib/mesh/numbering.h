#pragma once
#include <opensubdiv/far/topologyLevel.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/control_mesh.h"

namespace sateen {

/// Which vertex of the refined mesh each sample of each cage face writes to. A cage edge has segments - 1 inner
/// points; edges on which values jump (UV seams, sharp and non-manifold edges) have a set of points for each face,
/// equal in position: those are listed in `copies`.
struct Numbering {
  int segments = 1;                          ///< 2^level pieces a cage edge
  bool triangles = false;                    ///< Loop: triangular faces and pieces
  std::vector<std::uint32_t> face_corner;    ///< first corner of each face, and one past the last
  std::vector<std::uint32_t> corner_vertex;  ///< one a corner
  std::vector<std::uint32_t> edge_start;     ///< one a corner: first inner point of the edge to the next corner
  std::vector<bool> edge_reversed;           ///< one a corner: the points run from the next corner to this one
  std::vector<std::uint32_t> face_start;     ///< first vertex inside each face
  std::vector<std::uint32_t> face_quad;      ///< first quad of each face, and one past the last
  std::vector<bool> has_limit;               ///< false: a hole, or without a limit surface
  std::uint32_t vertices = 0;
  struct Copy {
    std::uint32_t to, from, count;
  };
  std::vector<Copy> copies;  ///< positions to be made equal, in order

  int size(size_t face) const { return int(face_corner[face + 1] - face_corner[face]); }
  /// Inner point k (1 to segments - 1) of the edge that leaves the given corner.
  std::uint32_t edge_point(std::uint32_t corner, int k) const {
    return edge_start[corner] + std::uint32_t(edge_reversed[corner] ? segments - 1 - k : k - 1);
  }
};

std::int64_t quads_of_face(int corners, int segments, bool triangles);

/// `mirrored[f]`: the UVs of face f run the other way round. `origin`: of each vertex, the first one in the same
/// place (mesh/manifold.h); empty: itself.
Numbering number_vertices(const OpenSubdiv::Far::TopologyLevel& cage, int level, bool triangles, bool has_uvs,
                          std::vector<bool> has_limit, const std::vector<bool>& mirrored,
                          const std::vector<int>& origin = {});

}  // namespace sateen
