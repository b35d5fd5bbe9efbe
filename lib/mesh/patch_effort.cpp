#include "mesh/patch_effort.h"

#include <algorithm>
#include <bit>
#include <set>
#include <vector>

namespace sateen {

namespace Far = OpenSubdiv::Far;

namespace {

// Control points that the faces around a vertex bring: 6 of triangles, 8 of quads where they are regular. A mesh of
// nothing beyond this is not judged, however few of its patches are alike.
constexpr int ordinary_ring = 16;
// Squares of control points, at about 50 bytes each: 50 MB, and 5 kB a face.
constexpr double always_bearable = 1e6, bearable_of_a_face = 100;

class Effort {
 public:
  explicit Effort(const Far::TopologyLevel& cage);
  double of_face(int face);

 private:
  std::vector<int> surroundings(int face) const;
  double of_positions(int face) const;
  double of_uvs(int face) const;

  const Far::TopologyLevel& cage_;
  std::vector<char> wide_;          // one a vertex: beyond the ordinary
  std::set<std::vector<int>> met_;  // surroundings of faces, of which one is counted
};

Effort::Effort(const Far::TopologyLevel& cage) : cage_(cage), wide_(size_t(cage.GetNumVertices()), 0) {
  for (int vertex = 0; vertex < cage.GetNumVertices(); ++vertex) {
    int ring = 0;
    for (const int face : cage.GetVertexFaces(vertex)) ring += cage.GetFaceVertices(face).size() - 2;
    wide_[size_t(vertex)] = ring > ordinary_ring;
  }
}

/// Equal where Bfr shares a matrix: sizes and sharpness of all around each corner, seen from the face.
std::vector<int> Effort::surroundings(int face) const {
  std::vector<int> out;
  for (const int vertex : cage_.GetFaceVertices(face)) {
    const Far::ConstIndexArray faces = cage_.GetVertexFaces(vertex), edges = cage_.GetVertexEdges(vertex);
    const int here = faces.FindIndex(face);
    out.insert(out.end(), {faces.size(), edges.size(), std::bit_cast<int>(cage_.GetVertexSharpness(vertex)), here});
    if (edges.size() == faces.size()) out.back() = 0;  // closed: begins anywhere
    const int first = edges.size() == faces.size() ? here : 0;
    for (int k = 0; k < faces.size(); ++k)
      out.push_back(cage_.GetFaceVertices(faces[(first + k) % faces.size()]).size());
    for (int k = 0; k < edges.size(); ++k)
      out.push_back(std::bit_cast<int>(cage_.GetEdgeSharpness(edges[(first + k) % edges.size()])));
  }
  return out;
}

double square_of_distinct(std::vector<int>& points) {
  std::sort(points.begin(), points.end());
  const auto count = double(std::unique(points.begin(), points.end()) - points.begin());
  return count * count;
}

double Effort::of_positions(int face) const {
  std::vector<int> points;
  for (const int vertex : cage_.GetFaceVertices(face))
    for (const int around : cage_.GetVertexFaces(vertex)) {
      if (around == face) continue;
      const Far::ConstIndexArray more = cage_.GetFaceVertices(around);
      points.insert(points.end(), more.begin(), more.end());
    }
  const Far::ConstIndexArray own = cage_.GetFaceVertices(face);
  points.insert(points.end(), own.begin(), own.end());
  return square_of_distinct(points);
}

/// Coordinates have patches of their own where a seam cuts the faces around a vertex, none of them alike.
double Effort::of_uvs(int face) const {
  const Far::ConstIndexArray vertices = cage_.GetFaceVertices(face), values = cage_.GetFaceFVarValues(face);
  if (std::all_of(vertices.begin(), vertices.end(), [&](int v) { return cage_.DoesVertexFVarTopologyMatch(v); }))
    return 0;
  std::vector<int> points;
  for (int corner = 0; corner < vertices.size(); ++corner)
    for (const int around : cage_.GetVertexFaces(vertices[corner])) {
      const Far::ConstIndexArray theirs = cage_.GetFaceFVarValues(around);
      if (theirs[cage_.GetFaceVertices(around).FindIndex(vertices[corner])] == values[corner])
        points.insert(points.end(), theirs.begin(), theirs.end());
    }
  return square_of_distinct(points);
}

double Effort::of_face(int face) {
  const Far::ConstIndexArray vertices = cage_.GetFaceVertices(face);
  if (cage_.IsFaceHole(face) ||
      std::none_of(vertices.begin(), vertices.end(), [&](int v) { return wide_[size_t(v)]; }))
    return 0;
  const double uvs = cage_.GetNumFVarChannels() > 0 ? of_uvs(face) : 0;
  return met_.insert(surroundings(face)).second ? uvs + of_positions(face) : uvs;
}

}  // namespace

bool patches_cost_too_much(const Far::TopologyLevel& cage) {
  const double bearable = always_bearable + bearable_of_a_face * cage.GetNumFaces();
  Effort effort(cage);
  double all = 0;
  for (int face = 0; face < cage.GetNumFaces(); ++face)
    if ((all += effort.of_face(face)) > bearable) return true;
  return false;
}

}  // namespace sateen
