#include "mesh/hems.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "mesh/surface_sample.h"

namespace sateen {

namespace {

struct Edge {
  std::uint64_t key;  // of its two ends, whichever way round
  std::uint32_t a, b;
};

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
}

std::vector<Edge> met_once(std::vector<Edge> edges) {
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) { return e.key < f.key; });
  std::vector<Edge> out;
  for (size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || edges[i - 1].key != edges[i].key) && (i + 1 == edges.size() || edges[i + 1].key != edges[i].key))
      out.push_back(edges[i]);
  return out;
}

size_t corners(const std::array<std::uint32_t, 4>& quad) {
  return quad[2] == quad[3] ? 3 : 4;
}

/// Edges between vertices whose fan of quads is open. In a closed fan every neighbour follows the vertex in one quad
/// and goes before it in another, so that the difference of all their numbers is zero.
std::vector<Edge> open_edges(const Mesh& mesh) {
  std::vector<std::uint32_t> open(mesh.positions.size(), 0);
  for (const auto& q : mesh.quads)
    for (size_t k = 0, n = corners(q); k < n; ++k) open[q[k]] += q[(k + 1) % n] - q[(k + n - 1) % n];
  std::vector<Edge> edges;
  for (const auto& q : mesh.quads)
    for (size_t k = 0, n = corners(q); k < n; ++k) {
      const std::uint32_t a = q[k], b = q[(k + 1) % n];
      if (open[a] && open[b]) edges.push_back({edge_key(a, b), a, b});
    }
  return met_once(std::move(edges));
}

}  // namespace

std::vector<HemEdge> hem_edges(const Mesh& mesh) {
  std::vector<Edge> edges = open_edges(mesh);
  std::map<std::array<float, 3>, std::uint32_t> places;
  std::unordered_map<std::uint32_t, std::uint32_t> first;  // of the vertices in the same place
  const auto place = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return first[v] = places.try_emplace({p.x, p.y, p.z}, v).first->second;
  };
  for (Edge& e : edges) {
    const std::uint32_t a = place(e.a), b = place(e.b);
    e.key = edge_key(a, b);
  }
  edges = met_once(std::move(edges));

  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
  for (const Edge& e : edges) {
    neighbours[first[e.a]].push_back(e.b);
    neighbours[first[e.b]].push_back(e.a);
  }
  const auto curvature = [&](std::uint32_t v) {
    const std::vector<std::uint32_t>& next = neighbours[first[v]];
    if (next.size() != 2) return 0.0f;
    const Vec3 in = mesh.positions[v] - mesh.positions[next[0]], out = mesh.positions[next[1]] - mesh.positions[v];
    const Vec3 d = safe_unit(in), e = safe_unit(out);
    constexpr float corner = 0.7f;
    const float across = length(in + out);
    if (dot(d, e) < corner || !(across > 0)) return 0.0f;
    // Of the circle through three points, what of it turns about the normal.
    return 2 * std::abs(dot(mesh.normals[v], cross(d, e))) / across;
  };
  std::vector<HemEdge> hems;
  hems.reserve(edges.size());
  for (const Edge& e : edges) hems.push_back({e.a, e.b, std::max(curvature(e.a), curvature(e.b))});
  return hems;
}

}  // namespace sateen
