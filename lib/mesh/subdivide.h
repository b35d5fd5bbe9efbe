#pragma once
#include <cstdint>

#include "mesh/control_mesh.h"
#include "mesh/mesh.h"

namespace sateen {

inline constexpr int finest_level = 6;

/// The limit surface of the cage, sampled where `level` uniform refinements (0 to 6) would put vertices: positions,
/// normals, UVs and dP/du, dP/dv are those of the limit surface itself, evaluated by OpenSubdiv's Bfr face by face,
/// so no refined levels are ever held. Scheme as the cage says; Catmull-Clark for triangles too unless it says Loop.
/// A quad gives 4^level quads; an n-gon n 4^(level-1), and at level 0 a triangle or a fan around its limit centre.
///
/// Vertices are split, with bitwise equal positions, at UV seams, where UVs turn mirrored, at infinitely sharp
/// and at non-manifold edges. Elsewhere derivatives that differ from face to face (linear UVs) are averaged.
/// A vertex whose UVs are missing or degenerate gets as warp the object's X axis (Z where the normal is within
/// acos(0.9) of X) projected on the surface, one unit of the held mesh per UV unit, and counts in fallback_warps;
/// corners without UVs read uv (0, 0). Holes are cut.
///
/// What of the cage is no surface is cut first (mesh/manifold.h), with a warning that counts it. A cage that
/// OpenSubdiv refuses is returned unrefined with a warning. InputError when its arrays do not fit together, `level`
/// is out of range or the result would pass 2^31 quads; OperationError when memory runs out.
Mesh subdivide(const ControlMesh& cage, int level, int threads = 0);

/// Quads that subdivide() would make, holes included.
std::int64_t quads_at_level(const ControlMesh& cage, int level);

}  // namespace sateen
