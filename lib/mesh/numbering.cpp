#include "mesh/numbering.h"

#include <map>

#include "mesh/corner_groups.h"

namespace sateen {

namespace {

using OpenSubdiv::Far::ConstIndexArray;
using OpenSubdiv::Far::TopologyLevel;
constexpr std::uint32_t none = 0xffffffffu;
constexpr float infinitely_sharp = 10;  // Sdc::Crease::SHARPNESS_INFINITE

int place_of(const ConstIndexArray& vertices, int vertex) {
  int i = 0;
  while (vertices[i] != vertex) ++i;
  return i;
}

class Numberer {
 public:
  Numberer(const TopologyLevel& cage, bool has_uvs, const std::vector<bool>& mirrored, const std::vector<int>& origin,
           Numbering& out)
      : cage_(cage), has_uvs_(has_uvs), mirrored_(mirrored), origin_(origin), out_(out) {}

  bool joined(int edge) const;
  void number_corners();
  void number_edges();
  void number_faces();

 private:
  const TopologyLevel& cage_;
  bool has_uvs_;
  std::size_t origin(int vertex) const {
    return std::size_t(origin_.empty() ? vertex : origin_[std::size_t(vertex)]);
  }
  std::vector<std::uint32_t> alike_edges() const;

  const std::vector<bool>& mirrored_;
  const std::vector<int>& origin_;
  Numbering& out_;
};

/// Of each edge, the first one in the same place.
std::vector<std::uint32_t> Numberer::alike_edges() const {
  std::vector<std::uint32_t> alike(std::size_t(cage_.GetNumEdges()));
  std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> known;
  for (std::uint32_t e = 0; e < alike.size(); ++e) {
    alike[e] = e;
    const ConstIndexArray ends = cage_.GetEdgeVertices(int(e));
    // Edges were doubled at borders alone.
    if (origin_.empty() || cage_.GetEdgeFaces(int(e)).size() != 1) continue;
    alike[e] = known.try_emplace(std::minmax(origin(ends[0]), origin(ends[1])), e).first->second;
  }
  return alike;
}

bool Numberer::joined(int edge) const {
  const ConstIndexArray faces = cage_.GetEdgeFaces(edge);
  if (faces.size() != 2 || cage_.IsEdgeNonManifold(edge)) return false;
  const size_t f = size_t(faces[0]), g = size_t(faces[1]);
  if (f == g || !out_.has_limit[f] || !out_.has_limit[g]) return false;
  if (cage_.GetEdgeSharpness(edge) >= infinitely_sharp || mirrored_[f] != mirrored_[g]) return false;
  if (!has_uvs_) return true;
  const ConstIndexArray f_vertices = cage_.GetFaceVertices(faces[0]), g_vertices = cage_.GetFaceVertices(faces[1]);
  const ConstIndexArray f_uvs = cage_.GetFaceFVarValues(faces[0]), g_uvs = cage_.GetFaceFVarValues(faces[1]);
  const ConstIndexArray ends = cage_.GetEdgeVertices(edge);
  for (int end = 0; end < 2; ++end)
    if (f_uvs[place_of(f_vertices, ends[end])] != g_uvs[place_of(g_vertices, ends[end])]) return false;
  return true;
}

void Numberer::number_corners() {
  const size_t corners = out_.face_corner.back();
  CornerGroups groups(corners);
  for (int edge = 0; edge < cage_.GetNumEdges(); ++edge) {
    if (!joined(edge)) continue;
    const ConstIndexArray faces = cage_.GetEdgeFaces(edge), ends = cage_.GetEdgeVertices(edge);
    for (int end = 0; end < 2; ++end) {
      const auto corner = [&](int face) {
        return out_.face_corner[size_t(face)] + std::uint32_t(place_of(cage_.GetFaceVertices(face), ends[end]));
      };
      groups.join(corner(faces[0]), corner(faces[1]));
    }
  }
  out_.corner_vertex.resize(corners);
  std::vector<std::uint32_t> first(size_t(cage_.GetNumVertices()), none);
  for (size_t face = 0; face < out_.has_limit.size(); ++face) {
    if (!out_.has_limit[face]) continue;
    const ConstIndexArray vertices = cage_.GetFaceVertices(int(face));
    for (std::uint32_t corner = out_.face_corner[face]; corner < out_.face_corner[face + 1]; ++corner) {
      const std::uint32_t root = groups.find(corner);
      if (root != corner) {
        out_.corner_vertex[corner] = out_.corner_vertex[root];
        continue;
      }
      const std::uint32_t vertex = out_.corner_vertex[corner] = out_.vertices++;
      std::uint32_t& canonical = first[origin(vertices[int(corner - out_.face_corner[face])])];
      if (canonical == none)
        canonical = vertex;
      else
        out_.copies.push_back({vertex, canonical, 1});
    }
  }
}

void Numberer::number_edges() {
  const std::uint32_t points = std::uint32_t(out_.segments - 1);
  if (points == 0) return;
  out_.edge_start.resize(out_.face_corner.back());
  out_.edge_reversed.resize(out_.face_corner.back());
  const std::vector<std::uint32_t> alike = alike_edges();
  std::vector<std::uint32_t> own(alike.size(), none), first(alike.size(), none);
  for (size_t face = 0; face < out_.has_limit.size(); ++face) {
    if (!out_.has_limit[face]) continue;
    const ConstIndexArray edges = cage_.GetFaceEdges(int(face)), vertices = cage_.GetFaceVertices(int(face));
    for (int i = 0; i < edges.size(); ++i) {
      const std::uint32_t corner = out_.face_corner[face] + std::uint32_t(i);
      const size_t edge = size_t(edges[i]);
      const ConstIndexArray ends = cage_.GetEdgeVertices(edges[i]);
      // Edges in the same place run the same way.
      const bool turned = !origin_.empty() && origin(ends[0]) > origin(ends[1]);
      out_.edge_reversed[corner] = (ends[0] != vertices[i]) != turned;
      if (own[edge] != none && joined(edges[i])) {
        out_.edge_start[corner] = own[edge];
        continue;
      }
      out_.edge_start[corner] = own[edge] = out_.vertices;
      std::uint32_t& canonical = first[alike[edge]];
      if (canonical == none)
        canonical = out_.vertices;
      else
        out_.copies.push_back({out_.vertices, canonical, points});
      out_.vertices += points;
    }
  }
}

void Numberer::number_faces() {
  const int n = out_.segments;
  out_.face_start.resize(out_.has_limit.size());
  out_.face_quad.resize(out_.has_limit.size() + 1);
  std::uint32_t quads = 0;
  for (size_t face = 0; face < out_.has_limit.size(); ++face) {
    out_.face_start[face] = out_.vertices;
    out_.face_quad[face] = quads;
    if (!out_.has_limit[face]) continue;
    const int size = out_.size(face);
    if (out_.triangles) {
      out_.vertices += std::uint32_t((n - 1) * (n - 2) / 2);
    } else if (size == 4) {
      out_.vertices += std::uint32_t((n - 1) * (n - 1));
    } else if (n == 1) {
      out_.vertices += size > 4 ? 1u : 0u;
    } else {
      out_.vertices += 1u + std::uint32_t(size) * std::uint32_t((n / 2 - 1) * (n / 2));
    }
    quads += std::uint32_t(quads_of_face(size, n, out_.triangles));
  }
  out_.face_quad.back() = quads;
}

}  // namespace

std::int64_t quads_of_face(int corners, int segments, bool triangles) {
  const std::int64_t n = segments;
  if (triangles || corners == 4) return n * n;
  if (n == 1) return corners == 3 ? 1 : corners;
  return corners * (n / 2) * (n / 2);
}

Numbering number_vertices(const TopologyLevel& cage, int level, bool triangles, bool has_uvs,
                          std::vector<bool> has_limit, const std::vector<bool>& mirrored,
                          const std::vector<int>& origin) {
  Numbering out;
  out.segments = 1 << level;
  out.triangles = triangles;
  out.has_limit = std::move(has_limit);
  out.face_corner.resize(size_t(cage.GetNumFaces()) + 1);
  for (int face = 0; face < cage.GetNumFaces(); ++face)
    out.face_corner[size_t(face) + 1] =
        out.face_corner[size_t(face)] + std::uint32_t(cage.GetFaceVertices(face).size());
  Numberer numberer(cage, has_uvs, mirrored, origin, out);
  numberer.number_corners();
  numberer.number_edges();
  numberer.number_faces();
  return out;
}

}  // namespace sateen
