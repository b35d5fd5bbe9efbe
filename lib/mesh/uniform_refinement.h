#pragma once
#include <opensubdiv/far/topologyRefiner.h>

#include "mesh/limit_surface.h"
#include "mesh/mesh.h"

namespace sateen {

/// True where Bfr must not be used: OpenSubdiv 3.5.0 writes out of bounds around an interior vertex of two faces (its
/// pull requests 1301, 1336 and 1353 mend that later), its patches grow with the square of the valence, so that a
/// vertex or face of 1,000 takes seconds, and where none are alike with the cube (mesh/patch_effort.h).
bool needs_uniform_refinement(const OpenSubdiv::Far::TopologyLevel& cage);

/// The limit surface by uniform refinement in Far, for such cages: positions, normals and UVs are the limit's as in
/// subdivide(), derivatives are differences to the neighbouring vertices. Unlike there, vertices are split at UV
/// seams only, level 0 fans polygons from their first corner, and faces on a border that is not interpolated stay.
/// Far's limit masks ask for quads and for semi-sharp creases that have decayed: at level 0 beside other polygons,
/// and below the level that equals a crease's sharpness, vertices lie a little off the limit. Finishes the mesh but
/// for its name. Throws Refusal.
Mesh uniformly_refined(OpenSubdiv::Far::TopologyRefiner& refiner, const ControlPoints& points, int level);

}  // namespace sateen
