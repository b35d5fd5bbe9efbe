#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "mesh/control_mesh.h"
#include "mesh/mesh.h"

namespace sateen {

/// How a mesh is looked at.
struct DetailView {
  std::function<float(const Vec3&)> pixel_size;  ///< scene units at a point; not positive where it is not seen
  std::optional<Vec3> eye;                       ///< empty: it will be seen from all around
};

/// How far the flat pieces of a mesh are from its limit surface where they are seen. All but the longest edge are
/// values that 0.1 % of the length of all edges and diagonals on the screen exceed, so that one bad corner of a cage
/// decides about nothing; within 10 %, upwards. A picture bears what stands behind each.
struct Detail {
  float edge_pixels = 0;     ///< the longest edge
  float off_pixels = 0;      ///< chords from the surface or the hem, across the line of sight: silhouettes; 0.25
  float normal_deg = 0;      ///< interpolated normals from the surface's, on facets: edges of 4 pixels and more; 0.5
  float rise_pixels = 0;     ///< of the surface over a facet, from whatever side; 0.1
  float missing_levels = 0;  ///< finer levels until a picture bears all of it; below 0: that it could do without
};

/// What a picture bears of Detail::off_pixels: about half of the pixel filter's standard deviation.
inline constexpr float most_off_pixels = 0.25f;

/// Between two vertices the surface is taken for the cubic that meets their positions and normals, and the larger
/// curvature of its two ends for all of it, so that what is said holds of finer levels too: there chords are off by a
/// quarter a level, edges half as long. In the plane of the surface, a hem's curve is measured by its neighbours.
Detail measure_detail(const Mesh& mesh, const DetailView& view, int threads = 0);

struct DetailedMesh {
  Mesh mesh;
  int level = 0;
  int wanted = 0;  ///< the level that the view asks for: above `level` where `most_quads` would be passed
};

/// The limit surface at the coarsest level that a picture bears, as measured on a coarse one: at most `finest_level`
/// and at most `most_quads` quads, but never below level 0. A bilinear cage, which has no curvature to measure, is
/// refined once. Errors as subdivide().
DetailedMesh subdivide_for_view(const ControlMesh& cage, const DetailView& view, std::int64_t most_quads,
                                int threads = 0);

}  // namespace sateen
