#pragma once
#include "math/vector.h"

namespace sateen {

/// One evaluation of the limit surface, as seen from one face.
struct SurfaceSample {
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 0};               ///< unit, or zero where the surface has none
  Vec3 dpdu{0, 0, 0}, dpdv{0, 0, 0};  ///< both zero where the UVs are degenerate
  Vec2 uv{0, 0};
};

/// Normal and derivatives by UV from the derivatives by any parameters s and t. Exact where P and UV are affine in
/// (s, t). UVs count as degenerate where their Jacobian is below 1e-4 of the product of its columns.
SurfaceSample sample_from_derivatives(const Vec3& p, const Vec3& dpds, const Vec3& dpdt, const Vec2& uv,
                                      const Vec2& duvds, const Vec2& duvdt);

/// Makes the derivatives tangent to the unit normal, or makes them up (see subdivide.h). True when made up.
bool settle_warp(const Vec3& normal, Vec3& dpdu, Vec3& dpdv);

/// v / |v|, safe for any finite v that is not zero; zero for what has no direction.
Vec3 safe_unit(const Vec3& v);

}  // namespace sateen
