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
Vec3d pattern(const Vec3d& d, double pole) {
  const double stretch = radius * std::sqrt(2 / (1 + std::abs(d.z)));
  return Vec3d(stretch * d.y, -pole * stretch * d.x, 0);
}

/// Control points of a Catmull-Clark surface of quads whose limit points are `targets`. Inside, the limit point of a
/// vertex of valence n is (n^2 C + 4 sum of edge neighbours + sum of the quads' far corners) / (n (n + 5)) [Halstead
/// et al. 1993]; on a border (4 C + both neighbours) / 6. Moving each control point by what its limit misses
/// converges.
std::vector<Vec3d> controls_for_limit(const std::vector<int>& quads, const std::vector<Vec3d>& targets) {
  std::map<std::pair<int, int>, int> sides;
  std::vector<double> valence(targets.size(), 0);
  for (size_t i = 0; i < quads.size(); ++i) {
    sides[std::minmax(quads[i], quads[i / 4 * 4 + (i + 1) % 4])] += 1;
    valence[size_t(quads[i])] += 1;
  }
  std::vector<std::vector<int>> border(targets.size());
  for (const auto& [side, faces] : sides) {
    if (faces != 1) continue;
    border[size_t(side.first)].push_back(side.second);
    border[size_t(side.second)].push_back(side.first);
  }
  std::vector<Vec3d> control = targets;
  for (int round = 0; round < 80; ++round) {
    std::vector<Vec3d> limit(targets.size());
    for (size_t p = 0; p < limit.size(); ++p) limit[p] = control[p] * valence[p] * valence[p];
    for (size_t i = 0; i < quads.size(); ++i) {
      const auto corner = [&](size_t k) { return control[size_t(quads[i / 4 * 4 + (i + k) % 4])]; };
      limit[size_t(quads[i])] += corner(1) * 2.0 + corner(3) * 2.0 + corner(2);  // edges are met from two faces
    }
    for (size_t p = 0; p < limit.size(); ++p) {
      limit[p] /= valence[p] * (valence[p] + 5);
      if (border[p].size() == 2)
        limit[p] = (control[p] * 4.0 + control[size_t(border[p][0])] + control[size_t(border[p][1])]) / 6.0;
    }
    for (size_t p = 0; p < limit.size(); ++p) control[p] += targets[p] - limit[p];
  }
  return control;
}

}  // namespace

ControlMesh sphere() {
  ControlMesh mesh;
  mesh.name = "sphere";
  mesh.metres_per_uv = 1;
  std::map<Key, int> points;
  std::map<std::pair<int, int>, int> uvs;  // point and half
  std::vector<Vec3d> directions, patterns;
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
            const auto [at, fresh] = uvs.try_emplace({p, half}, int(patterns.size()));
            if (fresh) patterns.push_back(pattern(directions[size_t(p)], half));
            mesh.position_indices.push_back(p);
            mesh.uv_indices.push_back(at->second);
          }
        }
      }
    }
  }
  std::vector<Vec3d> targets;
  for (const Vec3d& d : directions) targets.push_back(d * radius);
  for (const Vec3d& c : controls_for_limit(mesh.position_indices, targets))
    mesh.positions.push_back(Vec3(float(c.x), float(c.y + radius), float(c.z)));
  // The UVs are smooth too: without this their derivatives are off by a quarter around the cube's corners.
  for (const Vec3d& c : controls_for_limit(mesh.uv_indices, patterns))
    mesh.uvs.push_back(Vec2(float(c.x), float(c.y)));
  return mesh;
}

}  // namespace sateen::shapes
