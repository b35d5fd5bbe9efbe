#include "mesh/shapes/simulation/self_contact.h"

#include <algorithm>
#include <set>

namespace sateen {
namespace {

struct Box {
  Vec3d low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  void add(const Vec3d& p) {
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  Box grown(double by) const { return {low - Vec3d(by), high + Vec3d(by)}; }
};

bool overlap(const Box& a, const Box& b) {
  for (int k = 0; k < 3; ++k)
    if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
  return true;
}

/// Boxes sorted into the cells of a regular grid.
class CellGrid {
 public:
  CellGrid(const std::vector<Box>& boxes, double cell) : cell_(cell) {
    Box all;
    for (const Box& b : boxes) all.add(b.low), all.add(b.high);
    origin_ = all.low;
    for (int k = 0; k < 3; ++k) size_[k] = 1 + int((all.high[k] - all.low[k]) / cell_);
    starts_.assign(std::size_t(size_[0]) * size_[1] * size_[2] + 1, 0);
    for (const Box& b : boxes) each_cell(b, [&](int c) { ++starts_[c + 1]; });
    for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
    entries_.resize(starts_.back());
    std::vector<int> next(starts_.begin(), starts_.end() - 1);
    for (int i = 0; i < int(boxes.size()); ++i) each_cell(boxes[i], [&](int c) { entries_[next[c]++] = i; });
  }
  int cell_of(const Vec3d& p) const {
    int index = 0;
    for (int k = 2; k >= 0; --k)
      index = index * size_[k] + std::clamp(int((p[k] - origin_[k]) / cell_), 0, size_[k] - 1);
    return index;
  }
  template <class Visit>
  void each_cell(const Box& b, Visit visit) const {
    int low[3], high[3];
    for (int k = 0; k < 3; ++k) {
      low[k] = std::clamp(int((b.low[k] - origin_[k]) / cell_), 0, size_[k] - 1);
      high[k] = std::clamp(int((b.high[k] - origin_[k]) / cell_), 0, size_[k] - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x) visit((z * size_[1] + y) * size_[0] + x);
  }
  int cells() const { return int(starts_.size()) - 1; }
  const int* begin(int c) const { return entries_.data() + starts_[c]; }
  const int* end(int c) const { return entries_.data() + starts_[c + 1]; }

 private:
  double cell_;
  Vec3d origin_;
  int size_[3];
  std::vector<int> starts_, entries_;
};

/// Vector from the nearest point of the second feature to that of the first is sum c x.
using Coefficients = std::array<double, 4>;

/// Nearest point of a triangle to a point, by its Voronoi regions.
Coefficients nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, -1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {1, 0, -1, 0};
  if (d6 >= 0 && d5 <= d6) return {1, 0, 0, -1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1, -(1 - d1 / (d1 - d3)), -d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1, -(1 - d2 / (d2 - d6)), 0, -d2 / (d2 - d6)};
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {1, 0, -(1 - t), -t};
  }
  const double all = va + vb + vc;
  return {1, -va / all, -vb / all, -vc / all};
}

Coefficients nearest_on_edges(const Vec3d& p0, const Vec3d& p1, const Vec3d& q0, const Vec3d& q1) {
  const Vec3d d1 = p1 - p0, d2 = q1 - q0, r = p0 - q0;
  const double a = d1.dot(d1), e = d2.dot(d2), f = d2.dot(r), c = d1.dot(r), b = d1.dot(d2);
  const double det = a * e - b * b;
  double s = det > 1e-9 * a * e ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0.5;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return {1 - s, s, -(1 - t), -t};
}

Vec3d blend(const Coefficients& c, const std::array<int, 4>& v, const std::vector<Vec3d>& x) {
  return x[v[0]] * c[0] + x[v[1]] * c[1] + x[v[2]] * c[2] + x[v[3]] * c[3];
}

Coefficients nearest(bool edges, const std::array<int, 4>& v, const std::vector<Vec3d>& x) {
  return edges ? nearest_on_edges(x[v[0]], x[v[1]], x[v[2]], x[v[3]])
               : nearest_on_triangle(x[v[0]], x[v[1]], x[v[2]], x[v[3]]);
}

std::vector<std::array<int, 2>> edges_of(const std::vector<std::array<int, 3>>& triangles) {
  std::set<std::array<int, 2>> all;
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k) all.insert({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  return {all.begin(), all.end()};
}

}  // namespace

SelfContact::SelfContact(const Cloth& cloth, double thickness, double friction)
    : triangles_(cloth_triangles(cloth)), edges_(edges_of(triangles_)), thickness_(thickness), friction_(friction) {
  columns_ = cloth.columns, closed_ = cloth.closed;
  for (const Vec2d& p : cloth.pattern) pattern_.push_back({p.x, p.y, 0});
  for (const auto& e : edges_) longest_ = std::max(longest_, (pattern_[e[0]] - pattern_[e[1]]).length());
}

double SelfContact::pair_thickness(const std::array<int, 4>& v, bool edges) const {
  return std::min(thickness_, 0.5 * blend(nearest(edges, v, pattern_), v, pattern_).length());
}

bool SelfContact::neighbours(int a, int b) const {
  const int rows = std::abs(a / columns_ - b / columns_), columns = std::abs(a % columns_ - b % columns_);
  return rows <= 1 && (columns <= 1 || (closed_ && columns == columns_ - 1));
}

void SelfContact::find_pairs(const std::vector<Vec3d>& x) {
  found_at_ = x;
  vertex_triangle_.clear();
  edge_edge_.clear();
  const double reach = thickness_ + margin_, cell = longest_ + reach;
  const auto keep = [&](std::vector<Pair>& pairs, const std::array<int, 4>& v, bool edges) {
    const double distance = blend(nearest(edges, v, x), v, x).length();
    if (distance >= reach) return;
    const double h = pair_thickness(v, edges);
    if (distance < h + margin_) pairs.push_back({v, h, distance - h});
  };

  std::vector<Box> boxes(triangles_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const int v : triangles_[i]) boxes[i].add(x[v]);
    boxes[i] = boxes[i].grown(reach);
  }
  const CellGrid triangle_cells(boxes, cell);
  for (int v = 0; v < int(x.size()); ++v) {
    Box point;
    point.add(x[v]);
    const int c = triangle_cells.cell_of(x[v]);
    for (const int* i = triangle_cells.begin(c); i != triangle_cells.end(c); ++i) {
      const auto& t = triangles_[*i];
      if (!(neighbours(v, t[0]) && neighbours(v, t[2])) && overlap(point, boxes[*i]))
        keep(vertex_triangle_, {v, t[0], t[1], t[2]}, false);
    }
  }

  boxes.assign(edges_.size(), {});
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const int v : edges_[i]) boxes[i].add(x[v]);
    boxes[i] = boxes[i].grown(0.5 * reach);
  }
  const CellGrid edge_cells(boxes, cell);
  for (int c = 0; c < edge_cells.cells(); ++c)
    for (const int* i = edge_cells.begin(c); i != edge_cells.end(c); ++i)
      for (const int* j = i + 1; j < edge_cells.end(c); ++j) {
        const auto &a = edges_[*i], &b = edges_[*j];
        if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) continue;
        if ((neighbours(a[0], b[0]) && neighbours(a[1], b[1])) || !overlap(boxes[*i], boxes[*j])) continue;
        Vec3d corner;  // a pair may share several cells: take it in the one that holds the overlap's low corner
        for (int k = 0; k < 3; ++k) corner[k] = std::max(boxes[*i].low[k], boxes[*j].low[k]);
        if (edge_cells.cell_of(corner) == c) keep(edge_edge_, {a[0], a[1], b[0], b[1]}, true);
      }
  const auto nearer = [](const Pair& a, const Pair& b) { return a.slack < b.slack; };
  std::stable_sort(vertex_triangle_.begin(), vertex_triangle_.end(), nearer);
  std::stable_sort(edge_edge_.begin(), edge_edge_.end(), nearer);
}

void SelfContact::resolve(std::vector<Vec3d>& x, const std::vector<Vec3d>& before,
                          const std::vector<double>& inverse_mass) {
  const auto farthest = [&](const std::vector<Vec3d>& from) {
    double squared = from.empty() ? 1e30 : 0;
    for (std::size_t i = 0; i < from.size(); ++i) squared = std::max(squared, (x[i] - from[i]).length2());
    return std::sqrt(squared);
  };
  double reached = farthest(found_at_);
  if (reached > 0.5 * margin_) {
    // Far enough to serve for some steps. Pairs come from the start of the step, where no layers cross.
    reached = farthest(before);
    margin_ = std::clamp(4 * reached, 0.3 * thickness_, 0.8 * thickness_);
    find_pairs(before);
  }

  const auto push = [&](const Pair& pair, bool edges) {
    const auto& v = pair.vertices;
    const Coefficients c = nearest(edges, v, x);
    const Vec3d gap = blend(c, v, x);
    const double distance = gap.length();
    if (distance >= pair.thickness) return;
    const Vec3d old_gap = blend(nearest(edges, v, before), v, before);
    const bool crossed = gap.dot(old_gap) <= 0;
    const Vec3d n = crossed ? old_gap.normalized() : gap / distance;
    const double depth = pair.thickness - gap.dot(n);
    const Vec3d slip = blend(c, v, x) - blend(c, v, before);
    // Inelastic: stop the approach, then recover the distance slowly instead of throwing the layers apart.
    const double correction = crossed ? depth : std::min(depth, std::max(0.0, -slip.dot(n)) + 0.002 * pair.thickness);
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += c[k] * c[k] * inverse_mass[v[k]];
    if (sum <= 0 || !(n.length2() > 0.5)) return;
    const Vec3d along = slip - n * slip.dot(n);
    const double s = along.length();
    Vec3d change = n * correction;
    if (s > 0) change -= along * (std::min(friction_ * correction, s) / s);
    for (int k = 0; k < 4; ++k) x[v[k]] += change * (c[k] * inverse_mass[v[k]] / sum);
  };
  const auto push_all = [&](const std::vector<Pair>& pairs, bool edges) {
    for (const Pair& pair : pairs) {
      if (pair.slack > 2 * reached) break;
      push(pair, edges);
    }
  };
  push_all(vertex_triangle_, false);
  push_all(edge_edge_, true);
}

int count_crossings(const std::vector<Vec3d>& x, const std::vector<std::array<int, 3>>& triangles) {
  const auto edges = edges_of(triangles);
  std::vector<Box> boxes(triangles.size());
  double longest = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      boxes[i].add(x[triangles[i][k]]);
      longest = std::max(longest, (x[triangles[i][k]] - x[triangles[i][(k + 1) % 3]]).length());
    }
  const CellGrid cells(boxes, longest);
  int crossings = 0;
  std::vector<int> seen(triangles.size(), -1);
  for (int e = 0; e < int(edges.size()); ++e) {
    const Vec3d p = x[edges[e][0]], q = x[edges[e][1]];
    Box box;
    box.add(p), box.add(q);
    cells.each_cell(box, [&](int c) {
      for (const int* i = cells.begin(c); i != cells.end(c); ++i) {
        const auto& t = triangles[*i];
        if (seen[*i] == e || !overlap(box, boxes[*i])) continue;
        seen[*i] = e;
        bool shared = false;
        for (const int v : t) shared |= v == edges[e][0] || v == edges[e][1];
        if (shared) continue;
        const auto volume = [](const Vec3d& o, const Vec3d& a, const Vec3d& b, const Vec3d& d) {
          return (a - o).dot((b - o).cross(d - o));
        };
        const Vec3d &a = x[t[0]], &b = x[t[1]], &d = x[t[2]];
        if ((volume(p, a, b, d) > 0) == (volume(q, a, b, d) > 0)) continue;
        const bool s0 = volume(p, q, a, b) > 0, s1 = volume(p, q, b, d) > 0, s2 = volume(p, q, d, a) > 0;
        crossings += s0 == s1 && s1 == s2;
      }
    });
  }
  return crossings;
}

}  // namespace sateen
