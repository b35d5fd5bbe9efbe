#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/plan_parts.h"

namespace sateen {

namespace {

constexpr double visible_pixels = 0.5;

/// The object as the camera sees it: a sphere around its bounds.
struct Extent {
  Vec3 middle;
  double radius, nearest, farthest;  ///< along the view
  double pixels_at_unit;             ///< that one scene unit fills at depth 1
};
Extent extent_of(const Scene& scene) {
  Extent e;
  e.middle = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  e.radius = double((scene.mesh->bounds_max - e.middle).length());
  const double depth = double(dot(e.middle - scene.camera.position, scene.camera.forward));
  e.nearest = std::max(depth - e.radius, 1e-3 * e.radius);
  e.farthest = std::max(depth + e.radius, e.nearest);
  e.pixels_at_unit = scene.camera.width / (2 * double(scene.camera.tan_x));
  return e;
}

/// Leaves out what is too small to see, unless the pilot sees it: lobes may be narrower than the turn, threads finer
/// than the blur.
void rule_out(PlanWork& work, PlannedEffect& planned, const std::string& why) {
  if (!planned.on || work.settings.switches.is_asked(planned.effect)) return;
  planned.reason += ": " + why;
  decide_by_pilot(work, planned);
}

}  // namespace

PlannedEffect plan_ground(const Scene& scene, const EffectSwitches& switches) {
  const GroundKind kind = scene.ground ? scene.ground->kind : GroundKind::floor;
  return described(Effect::ground, scene.ground.has_value(), switches,
                   kind == GroundKind::catcher ? "a catcher takes the cloth's shadow"
                   : kind == GroundKind::floor ? "a floor takes shadow and sends light"
                                               : "a cyclorama takes shadow and sends light",
                   "the cloth stands in the air", "say which: --ground floor");
}

PlannedEffect plan_lens(PlanWork& work, const Scene& whole) {
  double blur = 0;
  if (whole.lens) {
    const Extent e = extent_of(whole);
    const double radius = double(whole.lens->radius), focus = double(whole.lens->focus);
    for (const double depth : {e.nearest, e.farthest})
      blur = std::max(blur, 2 * radius * std::abs(1 / depth - 1 / focus) * e.pixels_at_unit);
  }
  PlannedEffect planned = described(Effect::depth_of_field, whole.lens.has_value(), work.settings.switches,
                                    fmt::format("the lens blurs the object by up to {:.2g} pixels", blur),
                                    "a pinhole: all is sharp", "name an aperture: --f-stop 2.8");
  // Behind and before the object there is something to blur where it is seen.
  const bool seen_behind = whole.backdrop == Backdrop::environment || whole.backdrop == Backdrop::blurred;
  if (blur < visible_pixels && !seen_behind && !whole.ground)
    rule_out(work, planned,
             fmt::format("less than half of one; it is {:.3g} units large, whose size --metres-per-unit says",
                         2 * extent_of(whole).radius * whole.mesh->placement.unit));
  return planned;
}

PlannedEffect plan_shutter(PlanWork& work, const Scene& whole) {
  double moved = 0;
  if (whole.shutter) {
    const Extent e = extent_of(whole);
    const double object = std::abs(double(whole.shutter->object_angle)),
                 camera = std::abs(double(whole.shutter->camera_angle));
    moved = std::max(object, camera) * e.radius / e.nearest * e.pixels_at_unit;
    // To a camera that walks what is far behind the object moves by the whole angle.
    const bool seen_behind = whole.backdrop == Backdrop::environment || whole.backdrop == Backdrop::blurred;
    if (seen_behind || whole.ground) moved = std::max(moved, camera * e.pixels_at_unit);
    // And so do shadows that fall far.
    if (whole.ground) moved = std::max(moved, object * e.pixels_at_unit);
  }
  PlannedEffect planned =
      described(Effect::motion_blur, whole.shutter.has_value(), work.settings.switches,
                fmt::format("things move by up to {:.2g} pixels while the shutter is open", moved), "nothing moves",
                "say by how much: --shutter 5");
  if (moved < visible_pixels) rule_out(work, planned, "less than half of one");
  return planned;
}

PlannedEffect plan_references(const EffectSwitches& switches) {
  PlannedEffect planned =
      described(Effect::references, switches.references, switches,
                "laid over the picture; they take no part in its light", "not asked for", "--references");
  if (planned.on) planned.basis = Basis::asked;
  return planned;
}

PlannedEffect plan_subdivision(const Mesh& mesh, const Detail& detail) {
  PlannedEffect planned;
  planned.effect = Effect::subdivision;
  planned.on = true;
  planned.basis = Basis::data;
  planned.reason = fmt::format("{} triangles; silhouettes off by {:.2g} of {} pixels, edges up to {:.2g} long",
                               mesh.triangles(), detail.off_pixels, most_off_pixels, detail.edge_pixels);
  if (detail.normal_deg > 0) planned.reason += fmt::format(", facets' normals by {:.2g} degrees", detail.normal_deg);
  return planned;
}

}  // namespace sateen
