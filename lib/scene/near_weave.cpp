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

/// Width of the yarns [metres of cloth] of which the narrower family decides whether they show; 0 without a weave.
double narrowest_yarn(const Scene& scene) {
  double spacing = 0;
  for (const Fabric* fabric : fabrics_of(scene))
    if (!fabric->weave.empty())
      spacing = std::max(spacing, std::min(fabric->weave.warp_spacing, fabric->weave.weft_spacing));
  return spacing;
}

/// The largest pixel in which yarns of that width begin to show where lengths of cloth are stretched in the image by
/// at most the root of `square`.
double showing_pixel(const Scene& scene, double spacing, double square) {
  return spacing * std::sqrt(square) / double(scene.metres_per_uv) / double(begins);
}

/// For derivatives of which no more is known than their lengths: in any direction they stretch by at most the root of
/// their sum, and facets may be tilted by 45 degrees from the plane that they span.
double square_at_most(float du2, float dv2) {
  return 2 * (double(du2) + double(dv2));
}

/// The smaller side of a pixel at depth 1, across the ray in the picture's corner.
float pixel_at_unit(const Camera& camera) {
  const float aslant = std::sqrt(1 + camera.tan_x * camera.tan_x + camera.tan_y * camera.tan_y);
  return 2 * std::min(camera.tan_x / float(camera.width), camera.tan_y / float(camera.height)) / aslant;
}

/// Square of the largest stretch between a quad's corners, whose derivatives are interpolated: no mean of them
/// stretches more than the one that does most; facets are tilted from them as they are at the corners.
double quad_stretch(const Mesh& mesh, const std::array<std::uint32_t, 4>& quad) {
  constexpr float between = 0.95f;  // of the least cosine at the corners
  const auto place = [&](size_t k) { return mesh.positions[quad[k]]; };
  const std::array<Vec3, 2> facets{cross(place(1) - place(0), place(3) - place(0)),
                                   cross(place(3) - place(2), place(1) - place(2))};
  float u = 0, v = 0, most = 0, cosine = 1;
  bool regular = true;
  for (const std::uint32_t corner : quad) {
    const Vec3 &du = mesh.dpdu[corner], &dv = mesh.dpdv[corner], n = cross(du, dv);
    const float uu = dot(du, du), vv = dot(dv, dv), uv = dot(du, dv);
    u = std::max(u, uu);
    v = std::max(v, vv);
    most = std::max(most, (uu + vv) / 2 + std::hypot((uu - vv) / 2, uv));
    // Where they oppose one another each is taken from the nearest corner by itself.
    regular =
        regular && dot(n, n) > 1e-4f * uu * vv && dot(du, mesh.dpdu[quad[0]]) > 0 && dot(dv, mesh.dpdv[quad[0]]) > 0;
    for (const Vec3& facet : facets)
      if (const float size = length(facet) * length(n); size > 0)
        cosine = std::min(cosine, std::abs(dot(facet, n)) / size);
  }
  const double usual = square_at_most(u, v), cut = double(between * cosine);
  return regular && cut > 0 ? std::min(usual, double(most) / (cut * cut)) : usual;
}

/// Whether some of a quad may be seen, and the least depth there. A lens and the pixels' filter look beside the
/// frame.
bool in_view(const Scene& scene, const std::array<std::uint32_t, 4>& quad, float& depth) {
  constexpr float beside = 10;  // pixels: the widest filter's radius is 8
  const Camera& camera = scene.camera;
  const float tx = camera.tan_x * (1 + 2 * beside / float(camera.width)),
              ty = camera.tan_y * (1 + 2 * beside / float(camera.height));
  float nearest = far_away, farthest = 0, aside = 0;
  std::array<float, 4> out{far_away, far_away, far_away, far_away};  // beyond each side of the frame, at least
  for (const std::uint32_t corner : quad) {
    const Vec3 d = scene.mesh->positions[corner] - camera.position;
    const float z = dot(d, camera.forward), x = dot(d, camera.right), y = dot(d, camera.up);
    nearest = std::min(nearest, z);
    farthest = std::max(farthest, z);
    if (scene.lens) aside = std::max(aside, scene.lens->radius * std::abs(1 - z / scene.lens->focus));
    const std::array<float, 4> over{x - tx * z, -x - tx * z, y - ty * z, -y - ty * z};
    for (size_t k = 0; k < 4; ++k) out[k] = std::min(out[k], over[k]);
  }
  depth = std::max(nearest, 0.0f);
  return farthest > 0 && *std::max_element(out.begin(), out.end()) <= aside;
}

}  // namespace

float near_share(float pixels) {
  const float t = std::clamp(std::log(std::max(pixels, 1e-6f) / begins) / std::log(alone / begins), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float near_weave_pixel(const Scene& scene) {
  const double spacing = narrowest_yarn(scene);
  if (!(spacing > 0)) return 0;
  double stretch = 0;
  for (size_t i = 0; i < scene.mesh->dpdu.size(); ++i)
    stretch = std::max(stretch, square_at_most(dot(scene.mesh->dpdu[i], scene.mesh->dpdu[i]),
                                               dot(scene.mesh->dpdv[i], scene.mesh->dpdv[i])));
  return float(showing_pixel(scene, spacing, stretch));
}

bool may_show_yarns(const Scene& scene, float depth) {
  return std::abs(depth) * pixel_at_unit(scene.camera) < scene.near_weave_pixel;
}

bool may_show_yarns(const Scene& scene, bool from_all_around) {
  if (!(scene.near_weave_pixel > 0)) return false;
  const Vec3 middle = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  const float nearest = length(scene.camera.position - middle) - length(scene.mesh->bounds_max - middle);
  if (!may_show_yarns(scene, std::max(nearest, 0.0f))) return false;
  if (from_all_around || scene.shutter) return true;
  const double spacing = narrowest_yarn(scene);
  const Mesh& mesh = *scene.mesh;
  return std::any_of(mesh.quads.begin(), mesh.quads.end(), [&](const std::array<std::uint32_t, 4>& quad) {
    float depth = 0;
    return in_view(scene, quad, depth) &&
           double(depth * pixel_at_unit(scene.camera)) < showing_pixel(scene, spacing, quad_stretch(mesh, quad));
  });
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
