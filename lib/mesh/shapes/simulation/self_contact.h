#pragma once
#include <array>
#include <vector>

#include "mesh/shapes/simulation/cloth.h"

namespace sateen {

/// Keeps the layers of a cloth apart: vertex against triangle and edge against edge, at a distance of `thickness`
/// (less between neighbours on the pattern), with Coulomb friction. A pair that swapped sides within a step is put
/// back to the side where it was, so a cloth that starts without crossings stays so while steps are shorter
/// than the thickness. Corners of one quad are left to the bending stiffness.
class SelfContact {
 public:
  SelfContact(const Cloth& cloth, double thickness, double friction);

  /// Corrects `x` in place; `before` are the positions at the start of the step.
  void resolve(std::vector<Vec3d>& x, const std::vector<Vec3d>& before, const std::vector<double>& inverse_mass);

 private:
  struct Pair {
    std::array<int, 4> vertices;  ///< vertex and triangle, or the ends of two edges
    double thickness;
    double slack;  ///< distance above the thickness when the pair was found [m]
  };
  bool neighbours(int a, int b) const;  ///< corners of one quad: the bending stiffness keeps these apart
  void find_pairs(const std::vector<Vec3d>& x);
  double pair_thickness(const std::array<int, 4>& vertices, bool edges) const;

  std::vector<Vec3d> pattern_;  ///< flat, z = 0
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::array<int, 2>> edges_;
  double thickness_, friction_, margin_ = 0, longest_ = 0;
  int columns_ = 0;
  bool closed_ = false;
  std::vector<Pair> vertex_triangle_, edge_edge_;
  std::vector<Vec3d> found_at_;  ///< positions when the pairs were gathered
};

/// Pairs (edge of the mesh, triangle) that pierce each other without sharing a vertex: 0 for a sound surface.
int count_crossings(const std::vector<Vec3d>& positions, const std::vector<std::array<int, 3>>& triangles);

}  // namespace sateen
