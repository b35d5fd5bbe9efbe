#include "mesh/check_cage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace sateen {

namespace {

constexpr int most_neighbours = 65535;  // Far::VALENCE_LIMIT

[[noreturn]] void refuse(const ControlMesh& cage, const std::string& message) {
  throw InputError(fmt::format("{}: {}", cage.name.empty() ? "mesh" : cage.name, message));
}

void check_index(const ControlMesh& cage, const char* what, long long index, size_t count) {
  if (index < 0 || size_t(index) >= count)
    refuse(cage, fmt::format("{} {} does not exist, expected 0 to {}", what, index, (long long)count - 1));
}

void check_faces(const ControlMesh& cage) {
  size_t at = 0;
  for (size_t face = 0; face < cage.face_sizes.size(); ++face) {
    const int size = cage.face_sizes[face];
    if (size < 3) refuse(cage, fmt::format("face {} has {} corners, expected at least 3", face, size));
    if (size_t(size) > cage.position_indices.size() - at)
      refuse(cage, fmt::format("face {} has {} corners, but the list of corners ends before", face, size));
    for (size_t i = at; i < at + size_t(size); ++i)
      check_index(cage, "vertex", cage.position_indices[i], cage.positions.size());
    if (meets_a_vertex_twice({&cage.position_indices[at], size_t(size)}))
      refuse(cage, fmt::format("face {} meets a vertex twice", face));
    at += size_t(size);
  }
  if (at != cage.position_indices.size())
    refuse(cage, fmt::format("has {} corners, but its faces use {}", cage.position_indices.size(), at));
  if (cage.uv_indices.empty()) return;
  if (cage.uv_indices.size() != at)
    refuse(cage, fmt::format("has {} indices of texture coordinates for {} corners", cage.uv_indices.size(), at));
  for (const int i : cage.uv_indices)
    if (i != -1) check_index(cage, "texture coordinate", i, cage.uvs.size());
}

void check_tags(const ControlMesh& cage) {
  const auto check_sharpness = [&](float sharpness) {
    if (!(sharpness >= 0 && sharpness <= 10))
      refuse(cage, fmt::format("has a sharpness of {}, expected 0 to 10", sharpness));
  };
  for (const ControlMesh::Crease& crease : cage.creases) {
    check_sharpness(crease.sharpness);
    for (const int v : crease.vertices) check_index(cage, "vertex of a crease", v, cage.positions.size());
  }
  for (const ControlMesh::Corner& corner : cage.corners) {
    check_sharpness(corner.sharpness);
    check_index(cage, "vertex of a corner", corner.vertex, cage.positions.size());
  }
  for (const int face : cage.holes) check_index(cage, "face of a hole", face, cage.face_sizes.size());
}

}  // namespace

void check_cage(const ControlMesh& cage) {
  if (cage.face_sizes.empty()) refuse(cage, "has no face");
  check_faces(cage);
  check_tags(cage);
  for (size_t i = 0; i < cage.positions.size(); ++i)
    if (const Vec3& p = cage.positions[i]; !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      refuse(cage, fmt::format("vertex {} is at ({}, {}, {}), expected finite numbers", i, p.x, p.y, p.z));
  for (const Vec2& uv : cage.uvs)
    if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) refuse(cage, "a texture coordinate is not finite");
}

bool meets_a_vertex_twice(std::span<const int> corners) {
  constexpr size_t few = 8;  // corners: quicker than sorting
  if (corners.size() <= few) {
    for (size_t i = 0; i < corners.size(); ++i)
      for (size_t j = i + 1; j < corners.size(); ++j)
        if (corners[i] == corners[j]) return true;
    return false;
  }
  std::vector<int> sorted(corners.begin(), corners.end());
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

std::string beyond_limits(const ControlMesh& cage) {
  for (size_t face = 0; face < cage.face_sizes.size(); ++face)
    if (cage.face_sizes[face] > most_neighbours)
      return fmt::format("a face has {} corners, which is more than {}", cage.face_sizes[face], most_neighbours);
  // An edge of the fan that does not close is one more than its faces.
  std::vector<int> faces(cage.positions.size(), 0);
  for (const int v : cage.position_indices)
    if (++faces[size_t(v)] >= most_neighbours)
      return fmt::format("a vertex belongs to {} faces or more", most_neighbours);
  return {};
}

std::string counted(long long count, const std::string& thing) {
  if (count == 1) return "1 " + thing;
  if (thing == "vertex") return fmt::format("{} vertices", count);
  return fmt::format("{} {}s", count, thing);
}

}  // namespace sateen
