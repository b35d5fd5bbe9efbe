#pragma once
#include "math/vector.h"

namespace sateen {

/// Right-handed orthonormal shading frame; for cloth x = warp, y = weft, z = normal.
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  Vec3 to_local(const Vec3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 to_world(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Frame around the unit normal `z` with x as near to `along` as can be; nullopt-like fallback: where `along` is
/// parallel to z or not finite, x is the projection of the world axis least aligned with z.
inline Frame frame_from(const Vec3& z, const Vec3& along) {
  Frame f;
  f.z = z;
  Vec3 x = along - z * dot(along, z);
  const float x2 = dot(x, x), a2 = dot(along, along);
  if (!(x2 > 1e-12f * a2) || !std::isfinite(x2)) {
    const Vec3 a(std::abs(z.x), std::abs(z.y), std::abs(z.z));
    const Vec3 axis = a.x <= a.y && a.x <= a.z ? Vec3(1, 0, 0) : a.y <= a.z ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
    x = axis - z * dot(axis, z);
  }
  f.x = normalize(x);
  f.y = cross(z, f.x);
  return f;
}

}  // namespace sateen
