#pragma once
#include <array>
#include <vector>

#include "mesh/numbering.h"

namespace sateen {

/// Where one cage face is sampled, and which vertex each sample makes.
struct FacePoint {
  std::uint32_t vertex;
  Vec2 st;       ///< Bfr's coordinates on the face
  Vec2 towards;  ///< the middle of its smooth piece
};

/// The points of a face: first those on its border, `border` in number, which other faces may share, then those
/// inside. `quads` are the face's pieces in the order of its numbering, wound as the face is.
struct FacePoints {
  std::vector<FacePoint> points;
  size_t border = 0;
  std::vector<std::array<std::uint32_t, 4>> quads;

  void set_face(const Numbering& numbering, size_t face);

 private:
  void add(std::uint32_t vertex, float s, float t, const Vec2& towards) {
    points.push_back({vertex, {s, t}, towards});
  }
  void set_quad(const Numbering& n, size_t face);
  void set_triangle(const Numbering& n, size_t face);
  void set_polygon(const Numbering& n, size_t face);
  void set_coarse_polygon(const Numbering& n, size_t face);
  std::vector<std::uint32_t> grid_;  // vertices of the piece being made
};

}  // namespace sateen
