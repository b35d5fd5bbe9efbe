#pragma once
#include <cstdint>
#include <vector>

#include "mesh/limit_surface.h"
#include "mesh/mesh.h"
#include "mesh/surface_sample.h"

namespace sateen {

/// Collects what the faces say about each vertex and turns it into the mesh's final values. The first position and
/// UV count (all agree but for rounding), normals and derivatives are averaged.
class VertexValues {
 public:
  /// Sizes the mesh's arrays, with one spare position (Embree reads 16 bytes a vertex).
  VertexValues(Mesh& mesh, std::uint32_t vertices);
  void set(std::uint32_t vertex, const SurfaceSample& sample);  ///< a vertex that only one face has; any thread
  void add(std::uint32_t vertex, const SurfaceSample& sample);  ///< one of several; one thread
  /// Back to scene units; normals to unit length; warps made up where there are none; bounds. Throws Refusal where
  /// a position is not finite.
  void finish(const ControlPoints& points, int threads);

 private:
  void mend_normals();
  void mend_warps();

  Mesh& mesh_;
  std::vector<std::uint16_t> warps_;  // samples that had a derivative
};

}  // namespace sateen
