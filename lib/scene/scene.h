#pragma once
#include <memory>
#include <optional>

#include "fabric/fabric.h"
#include "mesh/mesh.h"
#include "scene/blurred_map.h"
#include "scene/camera.h"
#include "scene/environment.h"
#include "scene/ground.h"
#include "scene/lens.h"
#include "scene/ray_tracer.h"
#include "scene/shutter.h"
#include "scene/surface.h"

namespace sateen {

/// What is seen where there is no cloth.
enum class Backdrop {
  none,         ///< nothing: black, alpha 0
  environment,  ///< the map itself
  plain,        ///< one colour
  blurred       ///< the map through a wide kernel, `Scene::blurred`
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
  std::optional<BlurredMap> blurred;     ///< for Backdrop::blurred alone
  bool has_gaps = false;                 ///< some look lets light straight through
  bool self_shadowing = true;            ///< false: no part of the cloth keeps light from another
  std::optional<Ground> ground;
  std::optional<Lens> lens;              ///< empty: a pinhole
  std::optional<Shutter> shutter;        ///< empty: nothing turns
};

/// The cloth frame at a point as seen along `direction` (towards the surface): z on the viewer's side, x the warp.
struct ClothPoint {
  SurfacePoint surface;
  Frame frame;            ///< may be left-handed: F does not care, and mirrored UVs stay mirrored
  Vec3 facing;            ///< geometric normal on the viewer's side
  const Fabric* fabric;   ///< of the side that is seen
  Vec3 wo;                ///< towards the viewer, cloth frame; wo.z > 0
  YTurn object;           ///< under a shutter: how the object stands; `frame` and `facing` are turned with it
};
ClothPoint cloth_point(const Scene& scene, const Hit& hit, const Vec3& direction);

/// Turns frame and facing of a point as it was traced into the world; `surface` stays where the ray tracer knows it.
void turn_point(ClothPoint& point, const YTurn& object);

/// The ground that takes part in the light; null where there is none or only a catcher.
inline const Ground* solid_ground(const Scene& scene) {
  return scene.ground && scene.ground->blocks_light() ? &*scene.ground : nullptr;
}

}  // namespace sateen
