#include "mesh/manifold.h"

#include <algorithm>
#include <map>

#include "mesh/corner_groups.h"
#include "mesh/edge_table.h"

namespace sateen {

namespace {

constexpr float infinitely_sharp = 10;  // Sdc::Crease::SHARPNESS_INFINITE

using Sides = std::span<const EdgeTable::Side>;

class Cutter {
 public:
  explicit Cutter(const ControlMesh& cage) : cage_(cage), table_(cage), fans_(cage.position_indices.size()) {}
  bool is_manifold();
  CutCage cut();

 private:
  bool is_joined(int a, Sides sides) const;
  std::uint32_t corner_at(const EdgeTable::Side& side, int vertex) const {
    return cage_.position_indices[side.corner] == vertex ? side.corner : table_.next(side.corner);
  }
  void double_vertices(CutCage& out) const;
  void sharpen(CutCage& out) const;
  void move_creases(CutCage& out) const;
  void make_border_holes(CutCage& out) const;

  const ControlMesh& cage_;
  EdgeTable table_;
  CornerGroups fans_;
  std::vector<char> is_cut_;  // one a vertex
  int cut_edges_ = 0;
};

/// Two faces, one on each side of the edge.
bool Cutter::is_joined(int a, Sides sides) const {
  return sides.size() == 2 &&
         (cage_.position_indices[sides[0].corner] == a) != (cage_.position_indices[sides[1].corner] == a);
}

bool Cutter::is_manifold() {
  table_.each([&](int a, int b, Sides sides) {
    if (is_joined(a, sides)) {
      for (const int end : {a, b}) fans_.join(corner_at(sides[0], end), corner_at(sides[1], end));
    } else if (sides.size() > 1) {
      ++cut_edges_;
    }
  });
  is_cut_.assign(cage_.positions.size(), 0);
  std::vector<char> met(cage_.positions.size(), 0);
  bool any = false;
  for (std::uint32_t corner = 0; corner < cage_.position_indices.size(); ++corner) {
    if (fans_.find(corner) != corner) continue;
    const size_t vertex = size_t(cage_.position_indices[corner]);
    if (met[vertex]) is_cut_[vertex] = 1, any = true;
    met[vertex] = 1;
  }
  return !any && cut_edges_ == 0;
}

void Cutter::double_vertices(CutCage& out) const {
  ControlMesh& cage = out.cage;
  out.origin.resize(cage.positions.size());
  for (size_t i = 0; i < out.origin.size(); ++i) out.origin[i] = int(i);
  std::vector<char> met(cage.positions.size(), 0);
  // Roots go before the corners that they stand for.
  for (std::uint32_t corner = 0; corner < cage.position_indices.size(); ++corner) {
    const int vertex = cage_.position_indices[corner];
    const std::uint32_t root = fans_.root(corner);
    if (root != corner) {
      cage.position_indices[corner] = cage.position_indices[root];
    } else if (met[size_t(vertex)]) {
      cage.position_indices[corner] = int(cage.positions.size());
      cage.positions.push_back(Vec3(cage.positions[size_t(vertex)]));
      out.origin.push_back(vertex);
    }
    met[size_t(vertex)] = 1;
  }
  out.vertices = int(std::count(is_cut_.begin(), is_cut_.end(), char(1)));
  out.edges = cut_edges_;
}

void Cutter::sharpen(CutCage& out) const {
  // A vertex keeps a smooth border where two cut edges pass through it, every fan reaches from one to the other over
  // two faces or more, and nothing else there is sharp.
  std::vector<char> edges_cut(cage_.positions.size(), 0), sharp(cage_.positions.size(), 0);
  std::vector<int> edges(cage_.positions.size(), 0), faces(cage_.positions.size(), 0);
  table_.each([&](int a, int b, Sides sides) {
    for (const int end : {a, b}) {
      ++edges[size_t(end)];
      if (sides.size() == 1) sharp[size_t(end)] = 1;
      if (sides.size() > 1 && !is_joined(a, sides) && edges_cut[size_t(end)] < 3) ++edges_cut[size_t(end)];
    }
  });
  std::map<int, int> in_fan;  // faces around each doubled vertex
  for (const int v : out.cage.position_indices)
    if (is_cut_[size_t(out.origin[size_t(v)])]) ++in_fan[v];
  for (const auto& [vertex, count] : in_fan)
    if (count == 1) sharp[size_t(out.origin[size_t(vertex)])] = 1;
  for (const int v : cage_.position_indices) ++faces[size_t(v)];
  const auto mark = [&](int v) { sharp[size_t(v)] = 1; };
  for (const ControlMesh::Crease& crease : cage_.creases)
    std::for_each(crease.vertices.begin(), crease.vertices.end(), mark);
  for (const ControlMesh::Corner& corner : cage_.corners) mark(corner.vertex);
  const auto stays_smooth = [&](int v) {
    return edges_cut[size_t(v)] == 2 && !sharp[size_t(v)] && faces[size_t(v)] > edges[size_t(v)];
  };
  std::erase_if(out.cage.corners, [&](const ControlMesh::Corner& c) { return is_cut_[size_t(c.vertex)]; });
  for (const auto& [vertex, count] : in_fan)
    if (!stays_smooth(out.origin[size_t(vertex)])) out.cage.corners.push_back({vertex, infinitely_sharp});
}

void Cutter::move_creases(CutCage& out) const {
  out.cage.creases.clear();
  // Every edge of the cut cage that lies where the given one has this edge.
  const auto crease = [&](int a, int b, Sides sides, float sharpness) {
    std::vector<std::pair<int, int>> known;
    for (const EdgeTable::Side& side : sides) {
      const std::pair<int, int> edge(out.cage.position_indices[corner_at(side, a)],
                                     out.cage.position_indices[corner_at(side, b)]);
      if (std::find(known.begin(), known.end(), edge) != known.end()) continue;
      known.push_back(edge);
      out.cage.creases.push_back({{edge.first, edge.second}, sharpness});
    }
  };
  for (const ControlMesh::Crease& given : cage_.creases)
    for (size_t i = 0; i + 1 < given.vertices.size(); ++i) {
      const int a = std::min(given.vertices[i], given.vertices[i + 1]),
                b = std::max(given.vertices[i], given.vertices[i + 1]);
      crease(a, b, table_.find(a, b), given.sharpness);
    }
  // Two faces of one fan that meet at a cut edge again.
  table_.each([&](int a, int b, Sides sides) {
    if (sides.size() > 1 && !is_joined(a, sides)) crease(a, b, sides, infinitely_sharp);
  });
}

void Cutter::make_border_holes(CutCage& out) const {
  std::vector<char> at_border(cage_.positions.size(), 0);
  std::vector<std::pair<int, int>> sharp;
  for (const ControlMesh::Crease& crease : cage_.creases)
    for (size_t i = 0; i + 1 < crease.vertices.size() && crease.sharpness >= infinitely_sharp; ++i)
      sharp.push_back(std::minmax({crease.vertices[i], crease.vertices[i + 1]}));
  std::sort(sharp.begin(), sharp.end());
  table_.each([&](int a, int b, Sides sides) {
    if (sides.size() == 1 && !std::binary_search(sharp.begin(), sharp.end(), std::pair(a, b)))
      at_border[size_t(a)] = at_border[size_t(b)] = 1;
  });
  for (std::uint32_t corner = 0; corner < cage_.position_indices.size(); ++corner)
    if (at_border[size_t(cage_.position_indices[corner])]) out.cage.holes.push_back(int(table_.face_of(corner)));
  std::sort(out.cage.holes.begin(), out.cage.holes.end());
  out.cage.holes.erase(std::unique(out.cage.holes.begin(), out.cage.holes.end()), out.cage.holes.end());
  out.cage.boundary = ControlMesh::Boundary::edge_only;
}

CutCage Cutter::cut() {
  CutCage out;
  out.cage = cage_;
  double_vertices(out);
  sharpen(out);
  move_creases(out);
  if (cage_.boundary == ControlMesh::Boundary::none) make_border_holes(out);
  return out;
}

}  // namespace

std::optional<CutCage> cut_into_manifolds(const ControlMesh& cage) {
  Cutter cutter(cage);
  if (cutter.is_manifold()) return std::nullopt;
  return cutter.cut();
}

}  // namespace sateen
