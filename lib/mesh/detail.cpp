#include "mesh/detail.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "mesh/hems.h"
#include "mesh/subdivide.h"
#include "mesh/surface_sample.h"

namespace sateen {

namespace {

// An edge below this is no facet: all but a fortieth of the pixel filter's weight lies within 2 pixels, and what is
// wrong on one side of a shorter edge is made up for on the other.
constexpr float facet_pixels = 4;
// A quarter of the narrowest lobe of a satin, 2 degrees; highlights of interpolated normals show no facet below it.
constexpr float most_normal_deg = 0.5f;
// Where the sun grazes, flat triangles cut its light before the shading does, and the edge of the shadow follows
// them. Seen on a sphere where the surface rises by 0.2 pixels over a facet, no more at 0.05.
constexpr float most_rise_pixels = 0.1f;
constexpr double left_out = 1e-3;

/// Lengths by a value that is not negative, in steps of an eighth of an octave.
class Lengths {
 public:
  void add(float value, float length) {
    bins_[std::min(std::bit_cast<std::uint32_t>(value) >> shift, last)] += double(length);
  }
  void add(const Lengths& other) {
    for (size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
  }
  /// What all but a share of the length `all` stays below.
  float bound(double all) const {
    double above = 0;
    size_t i = bins_.size();
    while (i > 0 && above + bins_[i - 1] <= left_out * all) above += bins_[--i];
    return i == 0 ? 0 : std::bit_cast<float>(std::uint32_t(i) << shift);
  }

 private:
  static constexpr int shift = 20;  // leaves the exponent and three bits
  static constexpr std::uint32_t last = (0x7f800000u >> shift) - 1;
  std::array<double, last + 1> bins_{};
};

struct Sums {
  Lengths off, normal, rise, fourth;  // fourth: 4^(levels missing)
  double length = 0;
  float longest = 0;

  void add(float pixels, float off_pixels, float normal_deg, float rise_pixels) {
    length += double(pixels);
    longest = std::max(longest, pixels);
    off.add(off_pixels, pixels);
    const float size = pixels / facet_pixels;
    const float facet = std::max(normal_deg / most_normal_deg, rise_pixels / most_rise_pixels);
    fourth.add(std::max(off_pixels / most_off_pixels, std::min(size * size, facet)), pixels);
    if (size < 1) return;
    normal.add(normal_deg, pixels);
    rise.add(rise_pixels, pixels);
  }
  void add(const Sums& other) {
    off.add(other.off);
    normal.add(other.normal);
    rise.add(other.rise);
    fourth.add(other.fourth);
    length += other.length;
    longest = std::max(longest, other.longest);
  }
};

class Measure {
 public:
  Measure(const Mesh& mesh, const DetailView& view) : mesh_(mesh), view_(view), pixels_(mesh.positions.size()) {}
  Sums run(int threads);

 private:
  void add_chord(std::uint32_t a, std::uint32_t b, Sums& sums) const;
  void add_quad(const std::array<std::uint32_t, 4>& q, Sums& sums) const;
  void add_hems(Sums& sums) const;

  float pixel(std::uint32_t a, std::uint32_t b) const {
    const float p = pixels_[a], q = pixels_[b];
    return p > 0 && q > 0 ? std::min(p, q) : std::max(p, q);
  }
  /// The share of a displacement along the unit vector `direction` that is not along the line of sight.
  float seen_share(const Vec3& at, const Vec3& direction) const {
    if (!view_.eye) return 1;
    const float along = dot(safe_unit(at - *view_.eye), direction);
    return std::sqrt(std::max(0.0f, 1 - along * along));
  }

  const Mesh& mesh_;
  const DetailView& view_;
  std::vector<float> pixels_;  // scene units a pixel at each vertex, 0 where it is not seen
};

void Measure::add_chord(std::uint32_t a, std::uint32_t b, Sums& sums) const {
  const float pixel_here = pixel(a, b);
  if (!(pixel_here > 0)) return;
  const Vec3 &p = mesh_.positions[a], &q = mesh_.positions[b], &n = mesh_.normals[a], &o = mesh_.normals[b];
  const Vec3 edge = q - p;
  const float size = length(edge);
  if (!(size > 0)) return;
  const Vec3 along = edge / size, mean = n + o;
  const Vec3 up = safe_unit(mean - along * dot(mean, along));
  // Slopes of the surface's curve at both ends, over the chord. Beyond 80 degrees they say nothing more.
  constexpr float steepest = 0.17f;
  const float s = -dot(n, along) / std::max(dot(n, up), steepest);
  const float t = -dot(o, along) / std::max(dot(o, up), steepest);
  const float off = size * std::max(std::abs(4 * s + 2 * t), std::abs(2 * s + 4 * t)) / 8;
  const float share = std::max(seen_share(p, n), seen_share(q, o));
  // The normal: a linear slope against the cubic's quadratic one.
  sums.add(size / pixel_here, off * share / pixel_here, degrees(0.75f * std::abs(s + t)), off / pixel_here);
}

void Measure::add_quad(const std::array<std::uint32_t, 4>& q, Sums& sums) const {
  add_chord(q[0], q[1], sums);
  add_chord(q[1], q[2], sums);
  if (q[2] == q[3]) return add_chord(q[2], q[0], sums);
  add_chord(q[2], q[3], sums);
  add_chord(q[3], q[0], sums);
  add_chord(q[1], q[3], sums);  // along which the ray tracer splits it
}

void Measure::add_hems(Sums& sums) const {
  for (const HemEdge& hem : hem_edges(mesh_)) {
    const float pixel_here = pixel(hem.a, hem.b);
    if (!(pixel_here > 0)) continue;
    const Vec3& p = mesh_.positions[hem.a];
    const Vec3 edge = mesh_.positions[hem.b] - p;
    const float size = length(edge), off = size * size * hem.curvature / 8;
    const float share = seen_share(p, safe_unit(cross(mesh_.normals[hem.a], edge)));
    sums.add(size / pixel_here, off * share / pixel_here, 0, 0);
  }
}

Sums Measure::run(int threads) {
  constexpr size_t block = 1 << 15;
  const auto blocks = [&](size_t count, const auto& body) {
    parallel_for(int((count + block - 1) / block), threads,
                 [&](int i) { body(size_t(i), size_t(i) * block, std::min(count, size_t(i + 1) * block)); });
  };
  blocks(pixels_.size(), [&](size_t, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      const float size = view_.pixel_size(mesh_.positions[i]);
      pixels_[i] = size > 0 && std::isfinite(size) ? size : 0;
    }
  });
  std::vector<Sums> parts((mesh_.quads.size() + block - 1) / block);
  blocks(mesh_.quads.size(), [&](size_t part, size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) add_quad(mesh_.quads[i], parts[part]);
  });
  Sums all;
  for (const Sums& part : parts) all.add(part);
  add_hems(all);
  return all;
}

/// Fine enough that a cage's curves are resolved, as small as can be.
int level_to_measure(const ControlMesh& cage) {
  constexpr std::int64_t quick = 20'000, bearable = 400'000;
  return quads_at_level(cage, 2) <= quick ? 2 : quads_at_level(cage, 1) <= bearable ? 1 : 0;
}

}  // namespace

Detail measure_detail(const Mesh& mesh, const DetailView& view, int threads) {
  const Sums sums = Measure(mesh, view).run(threads);
  Detail out;
  out.edge_pixels = sums.longest;
  out.off_pixels = sums.off.bound(sums.length);
  out.normal_deg = sums.normal.bound(sums.length);
  out.rise_pixels = sums.rise.bound(sums.length);
  // 12 levels are beyond any that there is.
  out.missing_levels = std::clamp(0.5f * std::log2(sums.fourth.bound(sums.length)), -12.0f, 12.0f);
  return out;
}

DetailedMesh subdivide_for_view(const ControlMesh& cage, const DetailView& view, std::int64_t most_quads,
                                int threads) {
  const auto fits = [&](int level) { return quads_at_level(cage, level) <= most_quads; };
  DetailedMesh out;
  int level = level_to_measure(cage);
  while (level > 0 && !fits(level)) --level;
  out.mesh = subdivide(cage, level, threads);
  if (!out.mesh.refined) return out;
  if (cage.scheme == ControlMesh::Scheme::bilinear) {
    out.wanted = 1;
  } else {
    const float missing = measure_detail(out.mesh, view, threads).missing_levels;
    out.wanted = std::clamp(level + int(std::ceil(missing)), 0, finest_level);
  }
  out.level = out.wanted;
  while (out.level > 0 && !fits(out.level)) --out.level;
  if (out.level != level) {
    out.mesh = {};
    out.mesh = subdivide(cage, out.level, threads);
  }
  return out;
}

}  // namespace sateen
