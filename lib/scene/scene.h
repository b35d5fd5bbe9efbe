#pragma once
#include <memory>
#include <optional>

#include "fabric/fabric.h"
#include "mesh/mesh.h"
#include "scene/camera.h"
#include "scene/environment.h"
#include "scene/ray_tracer.h"
#include "scene/surface.h"

namespace sateen {

/// What is seen where there is no cloth.
enum class Backdrop {
  none,         ///< nothing: black, alpha 0
  environment,  ///< the map itself
  plain         ///< one colour
};

/// Everything that is rendered, compiled; const while rendering. A copy shares mesh and ray tracer.
struct Scene {
  std::shared_ptr<const Mesh> mesh;      ///< a stable address: the ray tracer shares its arrays
  std::shared_ptr<const RayTracer> rays;
  Fabric front;
  std::optional<Fabric> back;            ///< of the cloth; empty: the same as the front
  Environment environment;
  Camera camera;
  Backdrop backdrop = Backdrop::none;
  Color backdrop_color{0, 0, 0};         ///< working space
  bool has_gaps = false;                 ///< some look lets light straight through
  bool self_shadowing = true;            ///< false: no part of the cloth keeps light from another
  float metres_per_uv = 1;               ///< the cloth's own size, which threads per centimetre are counted on
  float near_weave_pixel = 0;            ///< scene/near_weave.h; 0: threads never show one by one
};

/// The cloth frame at a point as seen along `direction` (towards the surface): z on the viewer's side, x the warp.
struct ClothPoint {
  SurfacePoint surface;
  Frame frame;            ///< may be left-handed: F does not care, and mirrored UVs stay mirrored
  Vec3 facing;            ///< geometric normal on the viewer's side
  const Fabric* fabric;   ///< of the side that is seen
  Vec3 wo;                ///< towards the viewer, cloth frame; wo.z > 0
  YarnPlace yarn;         ///< what is on top here; its `near` is 0 but where a camera sees the cloth from near
};
ClothPoint cloth_point(const Scene& scene, const Hit& hit, const Vec3& direction);

}  // namespace sateen
