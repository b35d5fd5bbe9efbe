#pragma once
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/control_mesh.h"
#include "mesh/mesh.h"

namespace sateen {

/// What every mesh promises, whatever it was made from.
inline void expect_sound(const Mesh& mesh) {
  const size_t n = mesh.positions.size();
  ASSERT_EQ(mesh.normals.size(), n);
  ASSERT_EQ(mesh.dpdu.size(), n);
  ASSERT_EQ(mesh.dpdv.size(), n);
  ASSERT_EQ(mesh.uvs.size(), n);
  ASSERT_FALSE(mesh.quads.empty());
  ASSERT_GT(mesh.positions.capacity(), n) << "Embree reads 16 bytes at the last position";
  const Vec3 size = mesh.bounds_max - mesh.bounds_min;
  for (size_t i = 0; i < n; ++i) {
    const Vec3 &p = mesh.positions[i], &u = mesh.dpdu[i], &v = mesh.dpdv[i], &normal = mesh.normals[i];
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(std::isfinite(p[k]) && std::isfinite(u[k]) && std::isfinite(v[k])) << i;
      ASSERT_GE(p[k], mesh.bounds_min[k]);
      ASSERT_LE(p[k], mesh.bounds_max[k]);
    }
    ASSERT_TRUE(std::isfinite(mesh.uvs[i].x) && std::isfinite(mesh.uvs[i].y)) << i;
    ASSERT_NEAR(length(normal), 1, 1e-5) << i;
    ASSERT_GT(u.length(), 0) << i;
    ASSERT_GT(v.length(), 0) << i;
    ASSERT_NEAR(dot(u.normalized(), normal), 0, 1e-3) << i;
    ASSERT_NEAR(dot(v.normalized(), normal), 0, 1e-3) << i;
  }
  ASSERT_TRUE(std::isfinite(size.length()));
  std::vector<bool> used(n, false);
  for (const std::array<std::uint32_t, 4>& q : mesh.quads)
    for (const std::uint32_t v : q) {
      ASSERT_LT(v, n);
      used[v] = true;
    }
  for (size_t i = 0; i < n; ++i) ASSERT_TRUE(used[i]) << "vertex " << i << " belongs to no quad";
}

/// A cage over (0..nx) x (0..ny), one unit a cell, bent by `shape`; UVs are those of `chart`.
template <class Shape, class Chart>
ControlMesh grid_cage(int nx, int ny, const Shape& shape, const Chart& chart) {
  ControlMesh cage;
  cage.name = "grid";
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      cage.positions.push_back(shape(float(i), float(j)));
      cage.uvs.push_back(chart(float(i), float(j)));
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int v = j * (nx + 1) + i;
      cage.face_sizes.push_back(4);
      for (const int k : {v, v + 1, v + nx + 2, v + nx + 1}) {
        cage.position_indices.push_back(k);
        cage.uv_indices.push_back(k);
      }
    }
  return cage;
}

}  // namespace sateen
