#include "scene/near_weave.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

// Pixels that a yarn fills where it begins to show, and where it shows alone. The pixel's filter leaves of a grating
// of one pixel nothing and of one of two pixels a fifth, so nothing that could beat with the pixels is ever blended
// in.
constexpr float begins = 1, alone = 3;
constexpr float most_strands = 0.4f;  // of the strands in a yarn's shading; tuned by eye on linen

/// Weave coordinates [metres] of a texture coordinate: x along the warp.
struct WeaveAxes {
  double c, s, metres;

  WeaveAxes(const Scene& scene, const Fabric& fabric)
      : c(std::cos(double(fabric.warp_angle))), s(std::sin(double(fabric.warp_angle))), metres(scene.metres_per_uv) {}
  double x(const Vec2& uv) const { return metres * (double(uv.x) * c + double(uv.y) * s); }
  double y(const Vec2& uv) const { return metres * (double(uv.y) * c - double(uv.x) * s); }
};

}  // namespace

float near_share(float pixels) {
  const float t = std::clamp(std::log(std::max(pixels, 1e-6f) / begins) / std::log(alone / begins), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float near_weave_pixel(const Scene& scene) {
  double spacing = 0;
  for (const Fabric* fabric : fabrics_of(scene))
    if (!fabric->weave.empty()) spacing = std::max({spacing, fabric->weave.warp_spacing, fabric->weave.weft_spacing});
  double stretch = 0;  // scene units per metre of cloth at most
  for (size_t i = 0; i < scene.mesh->dpdu.size(); ++i)
    stretch = std::max(stretch, double(dot(scene.mesh->dpdu[i], scene.mesh->dpdu[i])) +
                                    double(dot(scene.mesh->dpdv[i], scene.mesh->dpdv[i])));
  return float(spacing * std::sqrt(2 * stretch) / double(scene.metres_per_uv) / double(begins));
}

bool may_show_yarns(const Scene& scene, float depth) {
  const float step =
      std::min(scene.camera.tan_x / float(scene.camera.width), scene.camera.tan_y / float(scene.camera.height));
  return std::abs(depth) * 2 * step < scene.near_weave_pixel;
}

bool may_show_yarns(const Scene& scene) {
  const Vec3 middle = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  const float nearest = length(scene.camera.position - middle) - length(scene.mesh->bounds_max - middle);
  return scene.near_weave_pixel > 0 && may_show_yarns(scene, std::max(nearest, 0.0f));
}

void place_yarn(const Scene& scene, const Footprint& pixel, ClothPoint& point) {
  const Weave& weave = point.fabric->weave;
  if (weave.empty()) return;
  const WeaveAxes axes(scene, *point.fabric);
  const double pixels = std::min(weave.weft_spacing / std::hypot(axes.x(pixel.dx), axes.x(pixel.dy)),
                                 weave.warp_spacing / std::hypot(axes.y(pixel.dx), axes.y(pixel.dy)));
  const float near = near_share(float(std::min(pixels, 1e6)));
  if (!(near > 0)) return;
  const double x = axes.x(point.surface.uv), y = axes.y(point.surface.uv);
  const std::array<double, 2> coverage{double(point.values.family[0].coverage),
                                       double(point.values.family[1].coverage)};
  // Where textures say how much the threads cover, the yarns there are as wide.
  point.yarn = point.mapped && coverage != weave.coverage ? yarn_at(weave, coverage, x, y) : yarn_at(weave, x, y);
  point.yarn.near = near;
  point.yarn.strands = most_strands * near_share(float(std::min(pixels, 1e6) / strands_across));
}

}  // namespace sateen
