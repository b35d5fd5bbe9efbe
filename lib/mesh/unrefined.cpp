#include "mesh/unrefined.h"

#include <algorithm>
#include <unordered_map>

#include "mesh/vertex_values.h"

namespace sateen {

namespace {

/// Corners of the faces that are shown, that share position and UV, share a vertex.
std::vector<std::uint32_t> vertices_of_corners(const ControlMesh& cage, const std::vector<bool>& shown,
                                               std::uint32_t& vertices) {
  std::vector<std::uint32_t> out(cage.position_indices.size());
  std::unordered_map<std::uint64_t, std::uint32_t> known;
  size_t i = 0;
  for (size_t face = 0; face < shown.size(); ++face)
    for (const size_t end = i + size_t(cage.face_sizes[face]); i < end; ++i) {
      if (!shown[face]) continue;
      const int uv = cage.uv_indices.empty() ? -1 : cage.uv_indices[i];
      const std::uint64_t key = std::uint64_t(cage.position_indices[i]) << 32 | std::uint32_t(uv);
      out[i] = known.try_emplace(key, std::uint32_t(known.size())).first->second;
    }
  vertices = std::uint32_t(known.size());
  return out;
}

void add_face(const ControlMesh& cage, const ControlPoints& points, const std::vector<std::uint32_t>& vertices,
              size_t begin, size_t size, VertexValues& values, Mesh& mesh) {
  const auto position = [&](size_t k) { return points.positions[size_t(cage.position_indices[begin + k % size])]; };
  const auto uv = [&](size_t k) {
    const int i = cage.uv_indices.empty() ? -1 : cage.uv_indices[begin + k % size];
    return i >= 0 ? points.uvs[size_t(i)] : points.uvs.empty() ? Vec2(0, 0) : points.uvs.back();
  };
  for (size_t k = 0; k < size; ++k) {
    const Vec3 ds = position(k + 1) - position(k), dt = position(k + size - 1) - position(k);
    SurfaceSample s =
        sample_from_derivatives(position(k), ds, dt, uv(k), uv(k + 1) - uv(k), uv(k + size - 1) - uv(k));
    s.normal = cross(ds, dt) * 1e12f;  // by area; finish() makes it a unit vector
    values.add(vertices[begin + k], s);
  }
  if (size == 4) {
    const std::uint32_t* v = &vertices[begin];
    mesh.quads.push_back({v[0], v[1], v[2], v[3]});
    return;
  }
  for (size_t k = 1; k + 1 < size; ++k)
    mesh.quads.push_back({vertices[begin], vertices[begin + k], vertices[begin + k + 1], vertices[begin + k + 1]});
}

}  // namespace

Mesh unrefined_mesh(const ControlMesh& cage) {
  Mesh mesh;
  const ControlPoints points = control_points(cage);
  std::vector<bool> shown(cage.face_sizes.size(), true);
  for (const int face : cage.holes) shown[size_t(face)] = false;
  // A mesh of nothing but holes cannot be shown: then they are filled.
  if (std::find(shown.begin(), shown.end(), true) == shown.end()) shown.assign(shown.size(), true);
  std::uint32_t count = 0;
  const std::vector<std::uint32_t> vertices = vertices_of_corners(cage, shown, count);
  VertexValues values(mesh, count);
  size_t begin = 0;
  for (size_t face = 0; face < shown.size(); ++face) {
    const size_t size = size_t(cage.face_sizes[face]);
    if (shown[face]) add_face(cage, points, vertices, begin, size, values, mesh);
    begin += size;
  }
  values.finish(points, 1);
  return mesh;
}

}  // namespace sateen
