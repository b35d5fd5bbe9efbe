#include "mesh/convexity.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>

namespace sateen {

namespace {

constexpr float flat_to = 1e-6f;   // of the size of the mesh
constexpr float level_to = 1e-5f;  // of the size of a quad
constexpr float most_twist = 0.03f;
constexpr float surely = 0.01f;  // of the size of the mesh: far more than quads of a convex body are off their planes

struct Plane {
  Vec3 normal, point;
  float slack = 0;  ///< how far the quad's own corners are off it, and rounding
  float twist = 0;  ///< the same of its size
};

int corners(const std::array<std::uint32_t, 4>& quad) {
  return quad[2] == quad[3] ? 3 : 4;
}

Plane plane_of(const Mesh& mesh, const std::array<std::uint32_t, 4>& quad) {
  const Vec3 &a = mesh.positions[quad[0]], &b = mesh.positions[quad[1]], &c = mesh.positions[quad[2]],
             &d = mesh.positions[quad[3]];
  Plane plane;
  plane.normal = cross(c - a, d - b);
  if (corners(quad) == 3) plane.normal = cross(b - a, c - a);
  const float length = plane.normal.length();
  if (length > 0) plane.normal /= length;
  plane.point = corners(quad) == 3 ? (a + b + c) / 3.0f : (a + b + c + d) / 4.0f;
  for (const std::uint32_t corner : quad)
    plane.slack = std::max(plane.slack, std::abs(dot(plane.normal, mesh.positions[corner] - plane.point)));
  const float size = std::max((c - a).length(), (d - b).length());
  plane.twist = size > 0 ? plane.slack / size : 0;
  plane.slack += level_to * size;
  return plane;
}

bool is_flat(const Mesh& mesh) {
  const float size = (mesh.bounds_max - mesh.bounds_min).length();
  const Plane plane = plane_of(mesh, mesh.quads[0]);
  return plane.normal.length() > 0.5f &&
         std::all_of(mesh.positions.begin(), mesh.positions.end(),
                     [&](const Vec3& p) { return std::abs(dot(plane.normal, p - plane.point)) <= flat_to * size; });
}

/// Vertices are split at seams, with bitwise equal positions: numbers them by position.
struct Welded {
  std::vector<std::uint32_t> vertex;
  std::uint32_t count = 0;
};
struct PositionHash {
  size_t operator()(const Vec3& p) const {
    size_t h = 0;
    for (int c = 0; c < 3; ++c) h = (h ^ std::bit_cast<std::uint32_t>(p[c] + 0.0f)) * 0x9e3779b97f4a7c15u;
    return h ^ h >> 29;
  }
};
Welded weld(const Mesh& mesh) {
  Welded welded;
  std::unordered_map<Vec3, std::uint32_t, PositionHash> known;
  known.reserve(mesh.positions.size());
  welded.vertex.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions)
    welded.vertex.push_back(known.emplace(p, std::uint32_t(known.size())).first->second);
  welded.count = std::uint32_t(known.size());
  return welded;
}

/// True where no corner of the quads on either side of their common edge rises above the other's plane.
bool bends_outwards(const Mesh& mesh, const Plane& left, const Plane& right, std::uint32_t left_quad,
                    std::uint32_t right_quad) {
  const auto below = [&](const Plane& plane, std::uint32_t other) {
    return std::all_of(mesh.quads[other].begin(), mesh.quads[other].end(), [&](std::uint32_t corner) {
      return dot(plane.normal, mesh.positions[corner] - plane.point) <= plane.slack;
    });
  };
  return dot(left.normal, right.normal) > -0.999f && below(left, right_quad) && below(right, left_quad);
}

/// A few quads against a few thousand vertices: most cloth rises above some of them by far, and is known as folded
/// without its edges being looked at.
bool is_surely_folded(const Mesh& mesh) {
  constexpr size_t most_quads = 16, most_vertices = 4096;
  const float size = (mesh.bounds_max - mesh.bounds_min).length();
  const size_t quads = std::min(mesh.quads.size(), most_quads);
  const size_t stride = mesh.positions.size() / most_vertices + 1;
  for (size_t k = 0; k < quads; ++k) {
    const Plane plane = plane_of(mesh, mesh.quads[k * mesh.quads.size() / quads]);
    for (size_t i = 0; i < mesh.positions.size(); i += stride)
      if (dot(plane.normal, mesh.positions[i] - plane.point) > plane.slack + surely * size) return true;
  }
  return false;
}

bool is_convex(const Mesh& mesh) {
  const Welded welded = weld(mesh);
  std::vector<Plane> planes;
  planes.reserve(mesh.quads.size());
  for (const auto& quad : mesh.quads) {
    planes.push_back(plane_of(mesh, quad));
    // Two triangles that meet in a valley.
    if (planes.back().twist > most_twist) return false;
  }

  // Each directed edge once, its twin once in the other direction.
  std::unordered_map<std::uint64_t, std::uint32_t> edges;
  edges.reserve(mesh.quads.size() * 4);
  std::vector<std::uint32_t> piece(mesh.quads.size());  // union of quads by their common edges
  for (std::uint32_t q = 0; q < piece.size(); ++q) piece[q] = q;
  const auto root = [&](std::uint32_t q) {
    while (piece[q] != q) q = piece[q] = piece[piece[q]];
    return q;
  };
  std::int64_t directed = 0, joined = 0;
  for (std::uint32_t q = 0; q < mesh.quads.size(); ++q) {
    const int n = corners(mesh.quads[q]);
    for (int k = 0; k < n; ++k) {
      const std::uint64_t from = welded.vertex[mesh.quads[q][size_t(k)]],
                          to = welded.vertex[mesh.quads[q][size_t((k + 1) % n)]];
      if (from == to) continue;  // a pole
      ++directed;
      if (!edges.emplace(from << 32 | to, q).second) return false;
      const auto twin = edges.find(to << 32 | from);
      if (twin == edges.end()) continue;
      if (!bends_outwards(mesh, planes[q], planes[twin->second], q, twin->second)) return false;
      ++joined;
      piece[root(q)] = root(twin->second);
    }
  }
  if (joined * 2 != directed) return false;  // a border
  std::int64_t faces = 0, pieces = 0;
  std::vector<bool> used(welded.count);
  for (std::uint32_t q = 0; q < mesh.quads.size(); ++q) {
    ++faces;
    pieces += root(q) == q;
    for (const std::uint32_t corner : mesh.quads[q]) used[welded.vertex[corner]] = true;
  }
  const auto vertices = std::int64_t(std::count(used.begin(), used.end(), true));
  return pieces == 1 && vertices - joined + faces == 2;
}

}  // namespace

MeshForm mesh_form(const Mesh& mesh) {
  if (mesh.quads.empty()) return MeshForm::flat;
  if (is_flat(mesh)) return MeshForm::flat;
  return !is_surely_folded(mesh) && is_convex(mesh) ? MeshForm::convex : MeshForm::folded;
}

}  // namespace sateen
