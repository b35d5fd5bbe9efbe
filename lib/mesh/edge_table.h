#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/control_mesh.h"

namespace sateen {

/// The edges of a cage with the faces along them. One entry a corner: the edge from it to the next corner.
class EdgeTable {
 public:
  explicit EdgeTable(const ControlMesh& cage);

  struct Side {
    int other;             ///< the edge's vertex of the larger number
    std::uint32_t corner;  ///< where the face enters the edge
  };
  /// Calls body(a, b, sides) for each edge, a < b, in order.
  template <class Body>
  void each(const Body& body) const {
    for (size_t a = 0; a + 1 < start_.size(); ++a)
      for (size_t i = start_[a], end = i; i < start_[a + 1]; i = end) {
        while (end < start_[a + 1] && sides_[end].other == sides_[i].other) ++end;
        body(int(a), sides_[i].other, std::span<const Side>(&sides_[i], end - i));
      }
  }
  /// The sides of an edge, none where there is no such edge.
  std::span<const Side> find(int a, int b) const;

  std::uint32_t face_of(std::uint32_t corner) const { return face_[corner]; }
  std::uint32_t next(std::uint32_t corner) const {
    return corner + 1 < first_[face_[corner] + 1] ? corner + 1 : first_[face_[corner]];
  }

 private:
  std::vector<std::uint32_t> first_, face_;  // first corner of each face and one past the last; face of each corner
  std::vector<std::uint32_t> start_;         // first side of each vertex
  std::vector<Side> sides_;
};

}  // namespace sateen
