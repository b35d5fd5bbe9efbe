#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "mesh/shape_cages.h"

namespace sateen::shapes {

namespace {

constexpr double radius = 0.15;  // metres
constexpr int cells = 8;         // quads along an edge of the cube; even, so that an edge line runs along z = 0

using Key = std::array<int, 3>;  // point of the cube's grid, each coordinate 0 to cells

// Cells of equal angle rather than equal length keep the quads alike.
Vec3d direction(const Key& key) {
  Vec3d p;
  for (int k = 0; k < 3; ++k) p[k] = std::tan((2.0 * key[size_t(k)] / cells - 1) * std::numbers::pi / 4);
  return p.normalized();
}

// Lambert's equal-area map of the half ball around `pole` (+1: +Z, -1: -Z); metres; u is up.
Vec2 pattern(const Vec3d& d, double pole) {
  const double stretch = radius * std::sqrt(2 / (1 + std::abs(d.z)));
  return Vec2(float(stretch * d.y), float(-pole * stretch * d.x));
}

}  // namespace

ControlMesh sphere() {
  ControlMesh mesh;
  mesh.name = "sphere";
  mesh.metres_per_uv = 1;
  std::map<Key, int> points;
  std::map<std::pair<int, int>, int> uvs;  // point and half
  std::vector<Vec3d> directions;
  const auto point = [&](const Key& key) {
    const auto [at, fresh] = points.try_emplace(key, int(directions.size()));
    if (fresh) directions.push_back(direction(key));
    return at->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int end = 0; end < 2; ++end) {
      for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
          const int a = (axis + 1) % 3, b = (axis + 2) % 3;
          std::array<Key, 4> corners;
          for (int k = 0; k < 4; ++k) {
            const bool far_i = k == 1 || k == 2, far_j = k >= 2;
            corners[size_t(k)][size_t(axis)] = end * cells;
            corners[size_t(k)][size_t(a)] = i + far_i;
            corners[size_t(k)][size_t(b)] = j + far_j;
          }
          if (end == 0) std::swap(corners[1], corners[3]);
          int z = 0;
          for (const Key& key : corners) z += key[2];
          const int half = z > 2 * cells ? 1 : -1;
          mesh.face_sizes.push_back(4);
          for (const Key& key : corners) {
            const int p = point(key);
            const auto [at, fresh] = uvs.try_emplace({p, half}, int(mesh.uvs.size()));
            if (fresh) mesh.uvs.push_back(pattern(directions[size_t(p)], half));
            mesh.position_indices.push_back(p);
            mesh.uv_indices.push_back(at->second);
          }
        }
      }
    }
  }
  // The limit point of a Catmull-Clark vertex of valence n is (n^2 C + 4 sum of edge neighbours + sum of the quads' far
  // corners) / (n (n + 5)) [Halstead et al. 1993]. Moving each control point by what its limit point misses converges.
  const size_t n_points = directions.size();
  std::vector<double> valence(n_points, 0);
  for (const int p : mesh.position_indices) valence[size_t(p)] += 1;
  std::vector<Vec3d> control(n_points);
  for (size_t p = 0; p < n_points; ++p) control[p] = directions[p] * radius;
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3d> limit(n_points);
    for (size_t p = 0; p < n_points; ++p) limit[p] = control[p] * valence[p] * valence[p];
    for (size_t face = 0; face < mesh.face_sizes.size(); ++face) {
      for (size_t k = 0; k < 4; ++k) {
        const auto corner = [&](size_t i) { return size_t(mesh.position_indices[face * 4 + (k + i) % 4]); };
        // Each edge neighbour is met from two faces.
        limit[corner(0)] += control[corner(1)] * 2.0 + control[corner(3)] * 2.0 + control[corner(2)];
      }
    }
    for (size_t p = 0; p < n_points; ++p)
      control[p] += directions[p] * radius - limit[p] / (valence[p] * (valence[p] + 5));
  }
  for (const Vec3d& c : control) mesh.positions.push_back(Vec3(float(c.x), float(c.y + radius), float(c.z)));
  return mesh;
}

}  // namespace sateen::shapes
