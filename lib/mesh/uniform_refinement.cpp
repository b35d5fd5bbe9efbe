#include "mesh/uniform_refinement.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <unordered_map>

#include "mesh/patch_effort.h"
#include "mesh/vertex_values.h"

namespace sateen {

namespace Far = OpenSubdiv::Far;

namespace {

constexpr int most_neighbours = 400;

/// What PrimvarRefiner wants of a value.
template <class V>
struct Primvar {
  V value{0};
  void Clear(void* = nullptr) { value = V(0); }
  void AddWithWeight(const Primvar& other, float weight) { value += other.value * weight; }
};
using Point = Primvar<Vec3>;
using Coordinate = Primvar<Vec2>;

template <class V, class Step>
std::vector<Primvar<V>> refined(const std::vector<V>& base, int levels, const Step& step) {
  std::vector<Primvar<V>> values(base.size());
  for (size_t i = 0; i < base.size(); ++i) values[i].value = base[i];
  for (int level = 1; level <= levels; ++level) values = step(level, values);
  return values;
}

struct Limits {
  std::vector<Point> positions, tangents, others;
};

Limits limits(const Far::TopologyRefiner& refiner, const ControlPoints& points, int level) {
  const Far::PrimvarRefiner primvars(refiner);
  const Far::TopologyLevel& last = refiner.GetLevel(level);
  Limits out;
  const size_t vertices = size_t(last.GetNumVertices());
  const std::vector<Point> positions = refined(points.positions, level, [&](int to, const std::vector<Point>& from) {
    std::vector<Point> next(size_t(refiner.GetLevel(to).GetNumVertices()));
    primvars.Interpolate(to, from, next);
    return next;
  });
  out.positions.resize(vertices);
  out.tangents.resize(vertices);
  out.others.resize(vertices);
  primvars.Limit(positions, out.positions, out.tangents, out.others);
  return out;
}

/// Texture coordinates at the limit, by value, and the value of every corner of every face in the order of `level`.
struct LimitUvs {
  std::vector<Coordinate> by_value;
  std::vector<int> of_corner;
};

std::vector<Coordinate> limit_uvs(const Far::TopologyRefiner& refiner, const ControlPoints& points, int level) {
  const Far::PrimvarRefiner primvars(refiner);
  const std::vector<Coordinate> uvs = refined(points.uvs, level, [&](int to, const std::vector<Coordinate>& from) {
    std::vector<Coordinate> next(size_t(refiner.GetLevel(to).GetNumFVarValues()));
    primvars.InterpolateFaceVarying(to, from, next);
    return next;
  });
  std::vector<Coordinate> out(size_t(refiner.GetLevel(level).GetNumFVarValues()));
  primvars.LimitFaceVarying(uvs, out);
  return out;
}

/// Refines anew. Of the cage itself OpenSubdiv looks up a value's tag at the value's index, though tags are kept by
/// vertex, and reads beyond them: there the limit is taken at the corners' children.
LimitUvs uvs_at(Far::TopologyRefiner& refiner, const ControlPoints& points, int level) {
  LimitUvs out;
  const int fine = std::max(level, 1);
  if (fine != level) {
    refiner.Unrefine();
    Far::TopologyRefiner::UniformOptions options(fine);
    options.fullTopologyInLastLevel = true;
    refiner.RefineUniform(options);
  }
  out.by_value = limit_uvs(refiner, points, fine);
  const Far::TopologyLevel &faces = refiner.GetLevel(level), &last = refiner.GetLevel(fine);
  for (int face = 0; face < faces.GetNumFaces(); ++face) {
    const Far::ConstIndexArray vertices = faces.GetFaceVertices(face);
    for (int k = 0; k < vertices.size(); ++k) {
      int at = face, corner = k;
      if (fine != level) {
        at = faces.GetFaceChildFaces(face)[k];
        corner = last.GetFaceVertices(at).FindIndex(faces.GetVertexChildVertex(vertices[k]));
      }
      out.of_corner.push_back(last.GetFaceFVarValues(at)[corner]);
    }
  }
  return out;
}

bool is_sharp(const Far::TopologyLevel& level, int vertex) {
  if (level.GetVertexFaces(vertex).size() == 1) return false;
  constexpr float infinitely_sharp = 10;
  if (level.IsVertexNonManifold(vertex) || level.GetVertexSharpness(vertex) >= infinitely_sharp) return true;
  const Far::ConstIndexArray edges = level.GetVertexEdges(vertex);
  return std::any_of(edges.begin(), edges.end(), [&](int edge) {
    return !level.IsEdgeBoundary(edge) && level.GetEdgeSharpness(edge) >= infinitely_sharp;
  });
}

}  // namespace

bool needs_uniform_refinement(const Far::TopologyLevel& cage) {
  for (int i = 0; i < cage.GetNumVertices(); ++i) {
    const int faces = cage.GetVertexFaces(i).size();
    if (faces > most_neighbours || (faces == 2 && cage.GetVertexEdges(i).size() == 2)) return true;
  }
  for (int i = 0; i < cage.GetNumFaces(); ++i)
    if (cage.GetFaceVertices(i).size() > most_neighbours) return true;
  return patches_cost_too_much(cage);
}

Mesh uniformly_refined(Far::TopologyRefiner& refiner, const ControlPoints& points, int level) {
  Far::TopologyRefiner::UniformOptions options(level);
  options.fullTopologyInLastLevel = true;  // the limit masks need it
  refiner.RefineUniform(options);
  const Limits limit = limits(refiner, points, level);
  const LimitUvs uvs = points.uvs.empty() ? LimitUvs() : uvs_at(refiner, points, level);
  const Far::TopologyLevel& last = refiner.GetLevel(level);

  std::unordered_map<std::uint64_t, std::uint32_t> known;
  std::vector<std::pair<int, int>> vertices;  // refined vertex and UV value
  Mesh mesh;
  std::vector<std::uint32_t> corners;
  size_t corner = 0;
  for (int face = 0; face < last.GetNumFaces(); ++face) {
    const Far::ConstIndexArray face_vertices = last.GetFaceVertices(face);
    const size_t first = corner;
    corner += size_t(face_vertices.size());
    if (last.IsFaceHole(face)) continue;
    corners.clear();
    for (int k = 0; k < face_vertices.size(); ++k) {
      const int uv = points.uvs.empty() ? 0 : uvs.of_corner[first + size_t(k)];
      const std::uint64_t key = std::uint64_t(face_vertices[k]) << 32 | std::uint32_t(uv);
      const auto [at, fresh] = known.try_emplace(key, std::uint32_t(vertices.size()));
      if (fresh) vertices.emplace_back(face_vertices[k], uv);
      corners.push_back(at->second);
    }
    if (corners.size() == 4) {
      mesh.quads.push_back({corners[0], corners[1], corners[2], corners[3]});
      continue;
    }
    for (size_t k = 1; k + 1 < corners.size(); ++k)
      mesh.quads.push_back({corners[0], corners[k], corners[k + 1], corners[k + 1]});
  }
  if (mesh.quads.empty()) throw Refusal{"no face has a limit surface"};

  // Once a vertex: one of many faces may have as many UVs.
  std::vector<char> sharp(limit.positions.size());
  for (size_t i = 0; i < sharp.size(); ++i) sharp[i] = is_sharp(last, int(i));
  VertexValues values(mesh, std::uint32_t(vertices.size()));
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const auto [vertex, uv] = vertices[i];
    SurfaceSample sample;
    sample.position = limit.positions[size_t(vertex)].value;
    if (!points.uvs.empty()) sample.uv = uvs.by_value[size_t(uv)].value;
    // Where several smooth pieces meet, one tangent plane would be as wrong as another: the mean of the pieces is
    // taken.
    if (!sharp[size_t(vertex)])
      sample.normal = safe_unit(
          cross(safe_unit(limit.tangents[size_t(vertex)].value), safe_unit(limit.others[size_t(vertex)].value)));
    values.set(i, sample);
  }
  values.finish(points, 1);
  return mesh;
}

}  // namespace sateen
