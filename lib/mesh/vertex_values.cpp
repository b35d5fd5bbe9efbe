#include "mesh/vertex_values.h"

#include <fmt/format.h>

#include <limits>
#include <unordered_map>

#include "base/parallel.h"

namespace sateen {

namespace {
constexpr float unset = std::numeric_limits<float>::quiet_NaN();
const Vec3 zero(0, 0, 0);
bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
}  // namespace

VertexValues::VertexValues(Mesh& mesh, std::uint32_t vertices) : mesh_(mesh), warps_(vertices, 0) {
  mesh_.positions.reserve(size_t(vertices) + 1);
  mesh_.positions.resize(vertices, Vec3(unset, unset, unset));
  mesh_.normals.resize(vertices, zero);
  mesh_.dpdu.resize(vertices, zero);
  mesh_.dpdv.resize(vertices, zero);
  mesh_.uvs.resize(vertices, Vec2(0, 0));
}

void VertexValues::set(std::uint32_t vertex, const SurfaceSample& s) {
  mesh_.positions[vertex] = s.position;
  mesh_.normals[vertex] = s.normal;
  mesh_.dpdu[vertex] = s.dpdu;
  mesh_.dpdv[vertex] = s.dpdv;
  mesh_.uvs[vertex] = s.uv;
  warps_[vertex] = 1;
}

void VertexValues::add(std::uint32_t vertex, const SurfaceSample& s) {
  if (std::isnan(mesh_.positions[vertex].x)) {
    mesh_.positions[vertex] = s.position;
    mesh_.uvs[vertex] = s.uv;
  }
  mesh_.normals[vertex] += s.normal;
  if (s.dpdu == zero || !is_finite(s.dpdu) || !is_finite(s.dpdv)) return;
  mesh_.dpdu[vertex] += s.dpdu;
  mesh_.dpdv[vertex] += s.dpdv;
  ++warps_[vertex];
}

void VertexValues::mend_normals() {
  // The pieces around a vertex have areas, too: they say where no face has a tangent plane. Where two faces share
  // more than half a turn about a sharp corner, as at a hole that was cut, the limit's tangents run along the borders
  // and their cross product points backwards, and the pieces beside it fold over: there a wider ring decides.
  using Quad = std::array<std::uint32_t, 4>;
  const auto is_plane = [](const Vec3& normal) {
    constexpr float cancelled = 1e-3f;
    return dot(normal, normal) > cancelled * cancelled;
  };
  const auto area_of = [&](const Quad& q) {
    return cross(mesh_.positions[q[2]] - mesh_.positions[q[0]], mesh_.positions[q[3]] - mesh_.positions[q[1]]);
  };
  const auto is_backwards = [&](const Quad& q) {
    const Vec3 area = area_of(q);
    return std::any_of(q.begin(), q.end(), [&](std::uint32_t i) { return dot(mesh_.normals[i], area) < 0; });
  };
  if (std::all_of(mesh_.normals.begin(), mesh_.normals.end(), is_plane) &&
      std::none_of(mesh_.quads.begin(), mesh_.quads.end(), is_backwards))
    return;
  const size_t count = mesh_.normals.size();
  std::vector<Vec3> ways(count, zero), areas(count, zero), wide(count, zero);
  const auto each = [&](const auto& use) {
    for (const Quad& q : mesh_.quads) use(q, q[2] == q[3] ? 3u : 4u);
  };
  each([&](const Quad& q, size_t corners) {
    const Vec3 area = area_of(q);
    for (size_t k = 0; k < corners; ++k) ways[q[k]] += safe_unit(area), areas[q[k]] += area;
  });
  each([&](const Quad& q, size_t corners) {
    Vec3 sum(0, 0, 0);
    for (size_t k = 0; k < corners; ++k) sum += areas[q[k]];
    for (size_t k = 0; k < corners; ++k) wide[q[k]] += sum;
  });
  int made_up = 0;
  for (size_t i = 0; i < count; ++i) {
    Vec3& normal = mesh_.normals[i];
    constexpr float backwards = -0.5f;
    if (!is_plane(normal)) {
      const bool has_way = dot(ways[i], ways[i]) > 1e-6f;
      normal = has_way ? ways[i] : Vec3(0, 1, 0);
      made_up += !has_way;
    } else if (dot(normal, wide[i]) < backwards * length(normal) * length(wide[i])) {
      normal = wide[i];
    }
  }
  if (made_up)
    mesh_.warnings.push_back(fmt::format("{} {} no normal and {} given +Y", made_up,
                                         made_up == 1 ? "vertex has" : "vertices have",
                                         made_up == 1 ? "was" : "were"));
}

void VertexValues::mend_warps() {
  // Mean of the pieces' derivatives at a vertex, weighted by their areas in UV: works where the limit's own vanish
  // but the UVs around do not.
  std::vector<bool> is_bad(mesh_.dpdu.size(), false);
  bool any = false;
  constexpr float parallel = 1e-2f;  // warp and weft within 0.6 degrees of one another
  for (size_t i = 0; i < is_bad.size(); ++i) {
    const Vec3 area = cross(safe_unit(mesh_.dpdu[i]), safe_unit(mesh_.dpdv[i]));
    if (dot(area, area) > parallel * parallel) continue;
    is_bad[i] = any = true;
    mesh_.dpdu[i] = mesh_.dpdv[i] = zero;
  }
  if (!any) return;
  std::unordered_map<std::uint32_t, double> areas;
  for (const std::array<std::uint32_t, 4>& q : mesh_.quads) {
    const size_t n = q[2] == q[3] ? 3 : 4;
    for (size_t k = 0; k < n; ++k) {
      const std::uint32_t v = q[k], next = q[(k + 1) % n], last = q[(k + n - 1) % n];
      if (!is_bad[v]) continue;
      const Vec3 ds = mesh_.positions[next] - mesh_.positions[v], dt = mesh_.positions[last] - mesh_.positions[v];
      const Vec2 w = mesh_.uvs[next] - mesh_.uvs[v], x = mesh_.uvs[last] - mesh_.uvs[v];
      const float det = w.x * x.y - x.x * w.y;
      if (!(std::abs(det) > 1e-4f * w.length() * x.length())) continue;
      const float sign = det < 0 ? -1.0f : 1.0f;
      mesh_.dpdu[v] += (ds * x.y - dt * w.y) * sign;
      mesh_.dpdv[v] += (dt * w.x - ds * x.x) * sign;
      areas[v] += double(std::abs(det));
    }
  }
  for (const auto& [v, area] : areas) {
    mesh_.dpdu[v] /= float(area);
    mesh_.dpdv[v] /= float(area);
    warps_[v] = 1;
  }
}

void VertexValues::finish(const ControlPoints& points, int threads) {
  mend_normals();
  mend_warps();
  constexpr size_t block = 1 << 16;
  const size_t vertices = mesh_.positions.size();
  const size_t blocks = (vertices + block - 1) / block;
  struct Found {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    std::int64_t made_up = 0;
    bool finite = true;
  };
  std::vector<Found> found(blocks);
  const float per_uv = points.scale / points.uv_scale;
  parallel_for(int(blocks), threads, [&](int b) {
    Found& f = found[size_t(b)];
    for (size_t i = size_t(b) * block; i < std::min(vertices, size_t(b + 1) * block); ++i) {
      const Vec3 p = mesh_.positions[i] * points.scale + points.centre;
      mesh_.positions[i] = p;
      f.finite = f.finite && is_finite(p);
      for (int k = 0; k < 3; ++k) {
        f.low[k] = std::min(f.low[k], p[k]);
        f.high[k] = std::max(f.high[k], p[k]);
      }
      const Vec3 n = safe_unit(mesh_.normals[i]);
      mesh_.normals[i] = n;
      const float scale = per_uv / float(std::max<std::uint16_t>(warps_[i], 1));
      mesh_.dpdu[i] *= scale;
      mesh_.dpdv[i] *= scale;
      f.made_up += settle_warp(n, mesh_.dpdu[i], mesh_.dpdv[i]);
      mesh_.uvs[i] = mesh_.uvs[i] * points.uv_scale + points.uv_centre;
    }
  });
  Found all;
  for (const Found& f : found) {
    for (int k = 0; k < 3; ++k) {
      all.low[k] = std::min(all.low[k], f.low[k]);
      all.high[k] = std::max(all.high[k], f.high[k]);
    }
    all.made_up += f.made_up;
    all.finite = all.finite && f.finite;
  }
  if (!all.finite) throw Refusal{"a limit position is not finite"};
  mesh_.bounds_min = all.low;
  mesh_.bounds_max = all.high;
  mesh_.fallback_warps = all.made_up;
}

}  // namespace sateen
