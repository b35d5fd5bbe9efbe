#include "mesh/cut_polygon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sateen {

namespace {

using Polygon = std::vector<PolygonCorner>;
constexpr size_t most_corners = 1000;  // the search for diagonals takes the cube of it

struct Point {
  double x, y;
};
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Corners that lie on the one before, and the tips of spikes: out to a vertex and back the same way.
void drop_spikes(Polygon& p) {
  for (size_t i = 0; p.size() >= 3 && i < p.size();) {
    const size_t next = (i + 1) % p.size(), last = (i + p.size() - 1) % p.size();
    if (p[i].vertex == p[next].vertex || p[last].vertex == p[next].vertex) {
      p.erase(p.begin() + long(i));
      i = i >= 2 ? i - 2 : 0;  // its neighbours may have become one
    } else {
      ++i;
    }
  }
}

class Plane {
 public:
  Plane(const Polygon& polygon, const std::vector<Vec3>& positions) {
    const Vec3d o(positions[size_t(polygon[0].vertex)]);
    std::vector<Vec3d> points;
    double size = 0;
    for (const PolygonCorner& c : polygon) {
      points.push_back(Vec3d(positions[size_t(c.vertex)]) - o);
      size = std::max({size, std::abs(points.back().x), std::abs(points.back().y), std::abs(points.back().z)});
    }
    Vec3d normal(0);
    for (size_t i = 0; size > 0 && i < points.size(); ++i)
      normal += (points[i] / size) % (points[(i + 1) % points.size()] / size);
    good = normal.length() > 1e-12;
    if (!good) return;
    normal.normalize();
    const Vec3d axis = std::abs(normal.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d x = (axis - normal * (axis ^ normal)).normalized(), y = normal % x;
    for (const Vec3d& p : points) flat.push_back({(p ^ x) / size, (p ^ y) / size});
  }
  bool good = false;
  std::vector<Point> flat;  ///< one a corner, about one in size, counter-clockwise on the whole
};

class Cutter {
 public:
  Cutter(const Polygon& polygon, std::vector<Point> flat) : polygon_(polygon), flat_(std::move(flat)) {
    for (size_t i = 0; i < polygon.size(); ++i) ring_.push_back(i);
  }
  std::vector<std::vector<size_t>> cut();

 private:
  bool is_ear(size_t at) const;
  bool is_inside(size_t at, const Point& target) const;
  bool is_free(size_t a, size_t b) const;
  bool is_empty(size_t a, size_t b, size_t c) const;
  size_t corner(size_t at) const { return ring_[at % ring_.size()]; }
  int vertex(size_t i) const { return polygon_[i].vertex; }
  void merge(std::vector<std::vector<size_t>>& faces) const;
  bool try_merge(const std::vector<size_t>& a, const std::vector<size_t>& b, std::vector<size_t>& both) const;

  static constexpr double flat_turn = 1e-12;  // of the polygon's size squared
  const Polygon& polygon_;
  std::vector<Point> flat_;
  std::vector<size_t> ring_;  // corners that are left
};

/// Whether the way from a corner of the ring to a point starts inside, between its two edges.
bool Cutter::is_inside(size_t at, const Point& target) const {
  const Point &last = flat_[corner(at + ring_.size() - 1)], &here = flat_[corner(at)], &next = flat_[corner(at + 1)];
  if (turn(last, here, next) >= 0) return turn(here, target, last) > 0 && turn(here, next, target) > 0;
  return !(turn(here, target, next) >= 0 && turn(here, last, target) >= 0);
}

/// Whether the diagonal touches no edge but at its own ends.
bool Cutter::is_free(size_t a, size_t b) const {
  const Point &p = flat_[a], &q = flat_[b];
  for (size_t i = 0; i < ring_.size(); ++i) {
    const size_t c = corner(i), d = corner(i + 1);
    const Point &r = flat_[c], &s = flat_[d];
    const bool c_is_end = vertex(c) == vertex(a) || vertex(c) == vertex(b);
    const bool d_is_end = vertex(d) == vertex(a) || vertex(d) == vertex(b);
    if (!c_is_end) {
      // A corner on the diagonal itself.
      const double along = (r.x - p.x) * (q.x - p.x) + (r.y - p.y) * (q.y - p.y);
      const double square = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
      if (std::abs(turn(p, q, r)) <= flat_turn && along > 0 && along < square) return false;
    }
    if (c_is_end || d_is_end) continue;
    if ((turn(p, q, r) > 0) != (turn(p, q, s) > 0) && (turn(r, s, p) > 0) != (turn(r, s, q) > 0)) return false;
  }
  return true;
}

bool Cutter::is_empty(size_t a, size_t b, size_t c) const {
  return std::none_of(ring_.begin(), ring_.end(), [&](size_t i) {
    const Point& p = flat_[i];
    return turn(flat_[a], flat_[b], p) > 0 && turn(flat_[b], flat_[c], p) > 0 && turn(flat_[c], flat_[a], p) > 0;
  });
}

bool Cutter::is_ear(size_t at) const {
  const size_t last = corner(at + ring_.size() - 1), here = corner(at), next = corner(at + 1);
  if (vertex(last) == vertex(next)) return false;
  if (!(turn(flat_[last], flat_[here], flat_[next]) > flat_turn)) return false;
  if (ring_.size() == 3) return true;
  // A triangle that hangs on by one vertex has no diagonal.
  if (vertex(corner(at + 2)) == vertex(last) || vertex(corner(at + ring_.size() - 2)) == vertex(next))
    return is_empty(last, here, next);
  return is_inside(at + ring_.size() - 1, flat_[next]) && is_inside(at + 1, flat_[last]) && is_free(last, next);
}

std::vector<std::vector<size_t>> Cutter::cut() {
  std::vector<std::vector<size_t>> faces;
  while (ring_.size() >= 3) {
    // What a cut left of a spike or of corners on a line has no area.
    bool changed = false;
    for (size_t i = 0; i < ring_.size() && ring_.size() > 2 && !changed; ++i) {
      const size_t last = corner(i + ring_.size() - 1), next = corner(i + 1);
      if (vertex(last) != vertex(next) && vertex(ring_[i]) != vertex(next)) continue;
      ring_.erase(ring_.begin() + long(i));
      changed = true;
    }
    if (changed) continue;
    // The best shaped ear of all, so that no sliver is left over.
    size_t best = ring_.size();
    double best_shape = 0;
    for (size_t i = 0; i < ring_.size(); ++i) {
      const Point &a = flat_[corner(i + ring_.size() - 1)], &b = flat_[corner(i)], &c = flat_[corner(i + 1)];
      const double longest = std::max(
          {std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y), std::hypot(a.x - c.x, a.y - c.y)});
      const double shape = longest > 0 ? turn(a, b, c) / (longest * longest) : 0;
      if (shape > best_shape && is_ear(i)) {
        best = i;
        best_shape = shape;
      }
    }
    if (best == ring_.size()) {
      // Corners on a line are left.
      double area = 0;
      for (size_t i = 0; i < ring_.size(); ++i) {
        const Point &a = flat_[corner(i)], &b = flat_[corner(i + 1)];
        area += a.x * b.y - a.y * b.x;
      }
      if (std::abs(area) <= 1e-9) break;
      return {};
    }
    faces.push_back({corner(best + ring_.size() - 1), corner(best), corner(best + 1)});
    ring_.erase(ring_.begin() + long(best));
  }
  merge(faces);
  return faces;
}

/// Both faces along the one edge that they share, where that is convex and meets no vertex twice.
bool Cutter::try_merge(const std::vector<size_t>& a, const std::vector<size_t>& b, std::vector<size_t>& both) const {
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) {
      if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j]) continue;
      both.clear();
      for (size_t k = 1; k <= a.size(); ++k) both.push_back(a[(i + k) % a.size()]);
      for (size_t k = 2; k < b.size(); ++k) both.push_back(b[(j + k) % b.size()]);
      const size_t n = both.size();
      std::vector<int> vertices;
      for (const size_t corner : both) vertices.push_back(vertex(corner));
      std::sort(vertices.begin(), vertices.end());
      if (std::adjacent_find(vertices.begin(), vertices.end()) != vertices.end()) return false;
      for (size_t k = 0; k < n; ++k)
        if (turn(flat_[both[k]], flat_[both[(k + 1) % n]], flat_[both[(k + 2) % n]]) < -flat_turn) return false;
      return true;
    }
  return false;
}

void Cutter::merge(std::vector<std::vector<size_t>>& faces) const {
  std::vector<size_t> both;
  for (size_t i = 0; i < faces.size(); ++i)
    for (size_t j = i + 1; j < faces.size();) {
      // Quads are what a limit surface likes best.
      if (faces[i].size() + faces[j].size() <= 6 && try_merge(faces[i], faces[j], both)) {
        faces[i] = both;
        faces.erase(faces.begin() + long(j));
        j = i + 1;
      } else {
        ++j;
      }
    }
}

}  // namespace

std::vector<std::vector<PolygonCorner>> cut_polygon(std::vector<PolygonCorner> polygon,
                                                    const std::vector<Vec3>& positions) {
  drop_spikes(polygon);
  if (polygon.size() < 3 || polygon.size() > most_corners) return {};
  const Plane plane(polygon, positions);
  if (!plane.good) return {};
  std::vector<Polygon> out;
  for (const std::vector<size_t>& face : Cutter(polygon, plane.flat).cut()) {
    Polygon& corners = out.emplace_back();
    for (const size_t i : face) corners.push_back(polygon[i]);
  }
  return out;
}

}  // namespace sateen
