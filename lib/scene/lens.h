#pragma once
#include <optional>
#include <span>

#include "sampling/sampler.h"
#include "scene/camera.h"
#include "scene/ray_tracer.h"

namespace sateen {

/// A lens as photographers name it.
struct LensSettings {
  float f_stop = 2.8f;         ///< focal length over diameter, 0.1 to 1000
  std::optional<float> focus;  ///< metres along the view; empty: see focus_distance
  int blades = 0;              ///< of the aperture, 3 to 32; 0: round
  float metres_per_unit = 1;   ///< of the scene, as the mesh's author has it
};

/// Thin lens in the units that the mesh is held in. What lies at `focus` from the camera, measured along its view, is sharp.
struct Lens {
  float radius = 0, focus = 1;
  int blades = 0;  ///< 0: round
};

/// Distance to the cloth in the middle of the picture; where there is none, to the middle of the object's bounds.
float focus_distance(const Mesh& mesh, const RayTracer& rays, const Camera& camera);

/// A sensor 36 mm wide along the picture's longer side: the focal length follows from the field of view, 78 mm for
/// 26 degrees, the radius from it and the f-stop. InputError for a focus that is not in front of the camera.
Lens compile_lens(const LensSettings& settings, const Mesh& mesh, const RayTracer& rays, const Camera& camera);

/// Bends pinhole rays: each leaves from its place on the lens (`u`) towards where the pinhole's ray meets the plane
/// of focus. Directions still reach the plane at distance 1.
void through_lens(const Camera& camera, const Lens& lens, const Batch2& u, std::span<Ray> rays);

}  // namespace sateen
