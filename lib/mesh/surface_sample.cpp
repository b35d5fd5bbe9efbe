#include "mesh/surface_sample.h"

namespace sateen {

Vec3 safe_unit(const Vec3& v) {
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0) || !std::isfinite(largest)) return Vec3(0, 0, 0);
  const Vec3 w = v / largest;
  return w / length(w);
}

SurfaceSample sample_from_derivatives(const Vec3& p, const Vec3& dpds, const Vec3& dpdt, const Vec2& uv,
                                      const Vec2& duvds, const Vec2& duvdt) {
  SurfaceSample out;
  out.position = p;
  out.uv = uv;
  // Unit tangents first: a product of two short ones would underflow.
  const Vec3 normal = cross(safe_unit(dpds), safe_unit(dpdt));
  constexpr float parallel = 1e-5f;  // rounding of the tangents' directions
  if (dot(normal, normal) > parallel * parallel) out.normal = safe_unit(normal);
  const float det = duvds.x * duvdt.y - duvdt.x * duvds.y;
  constexpr float degenerate = 1e-4f;
  if (std::abs(det) > degenerate * duvds.length() * duvdt.length()) {
    out.dpdu = (dpds * duvdt.y - dpdt * duvds.y) / det;
    out.dpdv = (dpdt * duvds.x - dpds * duvdt.x) / det;
  }
  return out;
}

bool settle_warp(const Vec3& n, Vec3& dpdu, Vec3& dpdv) {
  const Vec3 u = dpdu - n * dot(dpdu, n), v = dpdv - n * dot(dpdv, n);
  const Vec3 area = cross(safe_unit(u), safe_unit(v));
  constexpr float parallel = 1e-4f;
  if (dot(area, area) > parallel * parallel && std::isfinite(dot(u, u)) && std::isfinite(dot(v, v))) {
    dpdu = u;
    dpdv = v;
    return false;
  }
  const Vec3 axis = std::abs(n.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  dpdu = safe_unit(axis - n * dot(axis, n));
  dpdv = cross(n, dpdu);
  return true;
}

}  // namespace sateen
