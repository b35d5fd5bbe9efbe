#include "mesh/weld.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "mesh/check_cage.h"
#include "mesh/corner_groups.h"
#include "mesh/edge_table.h"

namespace sateen {

namespace {

constexpr double coincide_to = 1e-3;  // of the shorter edge: what six digits of text may round of a fine mesh

struct BorderEdge {
  int from, to;
  Vec3d middle;
  double length;
};

std::vector<BorderEdge> border_edges(const ControlMesh& cage, const EdgeTable& table) {
  std::vector<BorderEdge> borders;
  table.each([&](int, int, std::span<const EdgeTable::Side> sides) {
    if (sides.size() != 1) return;
    BorderEdge e{cage.position_indices[sides[0].corner], cage.position_indices[table.next(sides[0].corner)], {}, 0};
    const Vec3d p(cage.positions[size_t(e.from)]), q(cage.positions[size_t(e.to)]);
    e.middle = (p + q) * 0.5;
    // Without squares, which vanish or overflow in a very small or large mesh.
    const Vec3d d = q - p;
    e.length = std::hypot(d.x, d.y, d.z);
    if (e.length > 0) borders.push_back(e);
  });
  return borders;
}

bool coincide(const ControlMesh& cage, int a, int b, double tolerance) {
  const Vec3d d = Vec3d(cage.positions[size_t(a)]) - Vec3d(cage.positions[size_t(b)]);
  return std::hypot(d.x, d.y, d.z) <= tolerance;
}

/// For each border edge the only other one in its place, itself where there is none, -1 where there are several.
std::vector<int> partners(const ControlMesh& cage, const std::vector<BorderEdge>& borders) {
  std::vector<int> order(borders.size()), partner(borders.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = partner[i] = int(i);
  // Sorted along a direction that no seam is likely to be square to, an edge meets few others within its tolerance.
  const Vec3d across(0.3596, 0.5507, 0.7533);
  std::vector<double> place;
  for (const BorderEdge& e : borders) place.push_back(across.dot(e.middle));
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const double x = place[size_t(i)], y = place[size_t(j)];
    return x != y ? x < y : i < j;
  });
  for (size_t n = 0; n < order.size(); ++n) {
    const int i = order[n];
    const BorderEdge& e = borders[size_t(i)];
    for (size_t m = n + 1; m < order.size(); ++m) {
      const int j = order[m];
      const BorderEdge& f = borders[size_t(j)];
      const double tolerance = coincide_to * std::min(e.length, f.length);
      if (place[size_t(j)] - place[size_t(i)] > coincide_to * e.length) break;
      const bool opposite = coincide(cage, e.from, f.to, tolerance) && coincide(cage, e.to, f.from, tolerance);
      const bool along = coincide(cage, e.from, f.from, tolerance) && coincide(cage, e.to, f.to, tolerance);
      if (!opposite && !along) continue;
      for (const auto& [one, other] : {std::pair(i, j), std::pair(j, i)})
        partner[size_t(one)] = opposite && partner[size_t(one)] == one ? other : -1;
    }
  }
  return partner;
}

/// Groups of vertices that become one. Two vertices of one face stay two.
class Welder {
 public:
  Welder(const ControlMesh& cage, const EdgeTable& table, const std::vector<BorderEdge>& borders)
      : groups_(cage.positions.size()) {
    for (const BorderEdge& e : borders) faces_[std::uint32_t(e.from)], faces_[std::uint32_t(e.to)];
    for (std::uint32_t corner = 0; corner < cage.position_indices.size(); ++corner)
      if (const auto at = faces_.find(std::uint32_t(cage.position_indices[corner])); at != faces_.end())
        at->second.push_back(table.face_of(corner));
  }
  bool can_join(int a, int b) {
    const std::uint32_t i = groups_.find(std::uint32_t(a)), j = groups_.find(std::uint32_t(b));
    if (i == j) return true;
    const std::vector<std::uint32_t>& other = faces_[j];
    return std::none_of(faces_[i].begin(), faces_[i].end(), [&](std::uint32_t face) {
      return std::find(other.begin(), other.end(), face) != other.end();
    });
  }
  void join(int a, int b) {
    const std::uint32_t i = groups_.find(std::uint32_t(a)), j = groups_.find(std::uint32_t(b));
    if (i == j) return;
    groups_.join(i, j);
    const std::uint32_t kept = groups_.find(i), gone = kept == i ? j : i;
    faces_[kept].insert(faces_[kept].end(), faces_[gone].begin(), faces_[gone].end());
  }
  CornerGroups& groups() { return groups_; }

 private:
  CornerGroups groups_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> faces_;  // around the vertices of each group
};

CornerGroups pieces_of(const ControlMesh& cage) {
  CornerGroups pieces(cage.positions.size());
  size_t at = 0;
  for (const int size : cage.face_sizes) {
    for (int i = 1; i < size; ++i)
      pieces.join(std::uint32_t(cage.position_indices[at]), std::uint32_t(cage.position_indices[at + size_t(i)]));
    at += size_t(size);
  }
  return pieces;
}

struct Welding {
  CornerGroups vertices;
  Touching touching;
};

Welding find_welding(const ControlMesh& cage) {
  const EdgeTable table(cage);
  const std::vector<BorderEdge> borders = border_edges(cage, table);
  const std::vector<int> partner = partners(cage, borders);
  Welder welder(cage, table, borders);
  CornerGroups pieces = pieces_of(cage);
  Touching touching;
  std::set<std::uint32_t> met;
  for (size_t i = 0; i < borders.size(); ++i) {
    if (partner[i] <= int(i)) continue;
    const BorderEdge &e = borders[i], &f = borders[size_t(partner[i])];
    if (!welder.can_join(e.from, f.to)) continue;
    welder.join(e.from, f.to);
    if (welder.can_join(e.to, f.from)) welder.join(e.to, f.from);
    ++touching.edges;
    met.insert({pieces.find(std::uint32_t(e.from)), pieces.find(std::uint32_t(f.from))});
  }
  touching.pieces = int(met.size());
  for (std::uint32_t v = 0; v < cage.positions.size(); ++v) touching.vertices += welder.groups().find(v) != v;
  return {std::move(welder.groups()), touching};
}

}  // namespace

Touching touching_borders(const ControlMesh& cage) {
  return find_welding(cage).touching;
}

Touching weld_borders(ControlMesh& cage) {
  Welding welding = find_welding(cage);
  std::vector<int> number(cage.positions.size());
  int kept = 0;
  for (std::uint32_t v = 0; v < number.size(); ++v) {
    const std::uint32_t group = welding.vertices.find(v);  // its smallest vertex
    if (group == v) cage.positions[size_t(kept)] = Vec3(cage.positions[v]);
    number[v] = group == v ? kept++ : number[group];
  }
  cage.positions.resize(size_t(kept));
  const auto move = [&](int& v) { v = number[size_t(v)]; };
  std::for_each(cage.position_indices.begin(), cage.position_indices.end(), move);
  for (ControlMesh::Crease& crease : cage.creases)
    std::for_each(crease.vertices.begin(), crease.vertices.end(), move);
  for (ControlMesh::Corner& corner : cage.corners) move(corner.vertex);
  return welding.touching;
}

std::string touching_text(const Touching& t) {
  if (t.edges == 0) return {};
  const std::string what = t.pieces == 1 ? "borders" : fmt::format("{} pieces", t.pieces);
  return fmt::format(
      "its {} touch along {} but are not joined: a crease shows there; weld them on export, or with --weld", what,
      counted(t.edges, "edge"));
}

}  // namespace sateen
