#pragma once
#include <memory>
#include <optional>

#include "fabric/fabric.h"
#include "mesh/mesh.h"
#include "scene/blurred_map.h"
#include "scene/camera.h"
#include "scene/cloth_maps.h"
#include "scene/environment.h"
#include "scene/filter.h"
#include "scene/ground.h"
#include "scene/lens.h"
#include "scene/openness.h"
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
  std::shared_ptr<const Mesh> mesh;  ///< a stable address: the ray tracer shares its arrays
  std::shared_ptr<const RayTracer> rays;
  std::shared_ptr<const Openness> openness;  ///< guides sampling; null: nothing does
  Fabric front;
  std::optional<Fabric> back;  ///< of the cloth; empty: the same as the front
  Environment environment;
  Camera camera;
  std::shared_ptr<const PixelFilter> filter = compile_filter();
  Backdrop backdrop = Backdrop::none;
  Color backdrop_color{0, 0, 0};      ///< working space
  std::optional<BlurredMap> blurred;  ///< for Backdrop::blurred alone
  bool has_gaps = false;              ///< some look lets light straight through
  bool self_shadowing = true;         ///< false: no part of the cloth keeps light from another
  bool has_maps = false;              ///< some side has textures
  std::shared_ptr<const SideMaps> front_maps,
      back_maps;  ///< null where nothing varies; the back's own, if it has one
  std::optional<Ground> ground;
  std::optional<Lens> lens;        ///< empty: a pinhole
  std::optional<Shutter> shutter;  ///< empty: nothing turns
  float metres_per_uv = 1;         ///< the cloth's own size, which threads per centimetre are counted on
  float near_weave_pixel = 0;      ///< scene/near_weave.h; 0: threads never show one by one
};

/// All fabrics of a scene: front, back and those of their patterns.
std::vector<const Fabric*> fabrics_of(const Scene& scene);

/// The cloth frame at a point as seen along `direction` (towards the surface): z on the viewer's side, x the warp.
struct ClothPoint {
  SurfacePoint surface;
  Frame frame;           ///< may be left-handed: F does not care, and mirrored UVs stay mirrored
  Vec3 facing;           ///< geometric normal on the viewer's side
  const Fabric* fabric;  ///< of the side that is seen
  bool on_back;          ///< it is the mesh's back
  Vec3 wo;               ///< towards the viewer, cloth frame; wo.z > 0
  float gap;             ///< share of the area here that light and sight pass
  YTurn object;          ///< under a shutter: how the object stands; `frame` and `facing` are turned with it
  YarnPlace yarn;        ///< what is on top here; its `near` is 0 but where a camera sees the cloth from near
  PointValues values;    ///< what textures say here
  bool mapped;           ///< whether they say anything; false: `values` hold nothing

  const PointValues* own_values() const { return mapped ? &values : nullptr; }
};
ClothPoint cloth_point(const Scene& scene, const Hit& hit, const Vec3& direction);

/// What textures and the pattern make of a point: only for scenes that have maps. `choice` in [0, 1) says where the
/// mask is between 0 and 1 which of the two looks is met: both in their shares, over many samples. It is left as good
/// as new for another layer.
void apply_maps(const Scene& scene, const Vec3& direction, const Footprint& footprint, double& choice,
                ClothPoint& point);

/// Share of light that the gaps at a hit let pass, whichever side `direction` comes from.
float gap_along(const Scene& scene, const SurfacePoint& surface, const Vec3& direction);

/// Share of light that the gaps of all cloth along each ray let pass.
void pass_gaps(const Scene& scene, std::span<const Ray> rays, float* passed);

/// Turns frame and facing of a point as it was traced into the world; `surface` stays where the ray tracer knows it.
void turn_point(ClothPoint& point, const YTurn& object);

/// The ground that takes part in the light; null where there is none or only a catcher.
inline const Ground* solid_ground(const Scene& scene) {
  return scene.ground && scene.ground->blocks_light() ? &*scene.ground : nullptr;
}

}  // namespace sateen
