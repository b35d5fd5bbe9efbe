#include "scene/surface.h"

#include <cmath>
#include <limits>

namespace sateen {

namespace {

/// The triangle of a quad that holds a hit, with weights that add up to one.
struct Triangle {
  std::uint32_t a, b, c;
  double wa, wb, wc;

  template <class T>
  T mix(const std::vector<T>& values) const {
    return values[a] * float(wa) + values[b] * float(wb) + values[c] * float(wc);
  }
  template <class T>
  T heaviest(const std::vector<T>& values) const {
    return values[wa >= wb && wa >= wc ? a : wb >= wc ? b : c];
  }
};

Triangle triangle_of(const Mesh& mesh, const Hit& hit) {
  const std::array<std::uint32_t, 4>& q = mesh.quads[hit.quad];
  const double u = hit.u, v = hit.v;
  // Rounded coordinates may add up to a little over 1 on the first triangle of a quad that has no second.
  if (u + v <= 1 || q[2] == q[3]) {
    const double sum = std::max(u + v, 1.0);
    return {q[0], q[1], q[3], 1 - (u + v) / sum, u / sum, v / sum};
  }
  return {q[2], q[3], q[1], u + v - 1, 1 - u, 1 - v};
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const float square = dot(v, v);
  return square > 1e-12f && std::isfinite(square) ? v / std::sqrt(square) : otherwise;
}

// Interpolated derivatives vanish between vertices whose warps oppose one another; then the nearest vertex speaks.
Vec3 derivative(const Triangle& t, const std::vector<Vec3>& values) {
  const Vec3 mixed = t.mix(values), nearest = t.heaviest(values);
  return dot(mixed, mixed) > 1e-6f * dot(nearest, nearest) ? mixed : nearest;
}

}  // namespace

SurfacePoint surface_point(const Mesh& mesh, const Hit& hit) {
  const Triangle t = triangle_of(mesh, hit);
  // In double, so that the one rounding that counts is that of the result.
  const Vec3d a(mesh.positions[t.a]), ab = Vec3d(mesh.positions[t.b]) - a, ac = Vec3d(mesh.positions[t.c]) - a;
  const Vec3d p = a + ab * t.wb + ac * t.wc;
  SurfacePoint out;
  out.position = Vec3(p);
  const Vec3d cross = ab % ac;
  const double area = cross.length();
  out.normal = unit_or(t.mix(mesh.normals), t.heaviest(mesh.normals));
  out.geometric_normal = area > 0 ? Vec3(cross / area) : out.normal;
  out.dpdu = derivative(t, mesh.dpdu);
  out.dpdv = derivative(t, mesh.dpdv);
  out.uv = t.mix(mesh.uvs);
  // Rounding moves the position off the plane by half a unit in the last place of each coordinate. Embree shifts the
  // corners to the ray's origin and takes products of them: a few roundings of the triangle's own extent.
  constexpr double half_ulp = 0x1p-24;
  const Vec3& n = out.geometric_normal;
  const double rounding = std::abs(n.x * p.x) + std::abs(n.y * p.y) + std::abs(n.z * p.z);
  const double extent =
      std::max({std::abs(ab.x), std::abs(ab.y), std::abs(ab.z), std::abs(ac.x), std::abs(ac.y), std::abs(ac.z)});
  constexpr double embree_roundings = 16;
  out.error = float((2 * rounding + embree_roundings * extent) * half_ulp);
  return out;
}

Vec3 offset_origin(const Vec3& position, const Vec3& geometric_normal, const Vec3& direction, float error) {
  const float side = dot(geometric_normal, direction) < 0 ? -1.0f : 1.0f;
  Vec3 origin;
  for (int k = 0; k < 3; ++k) {
    const float step = side * error * geometric_normal[k];
    origin[k] = position[k] + step;
    // Away from the surface, so that rounding the sum cannot undo the step.
    if (step > 0) origin[k] = std::nextafter(origin[k], std::numeric_limits<float>::infinity());
    if (step < 0) origin[k] = std::nextafter(origin[k], -std::numeric_limits<float>::infinity());
  }
  return origin;
}

}  // namespace sateen
