#include "mesh/face_points.h"

#include <opensubdiv/bfr/parameterization.h>

namespace sateen {

namespace {
Vec2 corner_coordinates(int corners, int corner) {
  const OpenSubdiv::Bfr::Parameterization p(OpenSubdiv::Sdc::SCHEME_CATMARK, corners);
  Vec2 st;
  p.GetVertexCoord(corner, &st.x);
  return st;
}
}  // namespace

void FacePoints::set_face(const Numbering& numbering, size_t face) {
  points.clear();
  quads.clear();
  const int size = numbering.size(face);
  if (numbering.triangles)
    set_triangle(numbering, face);
  else if (size == 4)
    set_quad(numbering, face);
  else if (numbering.segments == 1)
    set_coarse_polygon(numbering, face);
  else
    set_polygon(numbering, face);
}

void FacePoints::set_quad(const Numbering& numbering, size_t face) {
  const int n = numbering.segments;
  const float step = 1.0f / float(n);
  const Vec2 middle(0.5f, 0.5f);
  const std::uint32_t c = numbering.face_corner[face];
  grid_.resize(size_t(n + 1) * size_t(n + 1));
  const auto put = [&](int i, int j, std::uint32_t vertex) {
    grid_[size_t(j * (n + 1) + i)] = vertex;
    add(vertex, float(i) * step, float(j) * step, middle);
  };
  put(0, 0, numbering.corner_vertex[c]);
  put(n, 0, numbering.corner_vertex[c + 1]);
  put(n, n, numbering.corner_vertex[c + 2]);
  put(0, n, numbering.corner_vertex[c + 3]);
  for (int k = 1; k < n; ++k) {
    put(k, 0, numbering.edge_point(c, k));
    put(n, k, numbering.edge_point(c + 1, k));
    put(n - k, n, numbering.edge_point(c + 2, k));
    put(0, n - k, numbering.edge_point(c + 3, k));
  }
  border = points.size();
  std::uint32_t vertex = numbering.face_start[face];
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i) put(i, j, vertex++);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::uint32_t* g = &grid_[size_t(j * (n + 1) + i)];
      quads.push_back({g[0], g[1], g[n + 2], g[n + 1]});
    }
}

void FacePoints::set_triangle(const Numbering& numbering, size_t face) {
  const int n = numbering.segments;
  const float step = 1.0f / float(n);
  const Vec2 middle(1.0f / 3, 1.0f / 3);
  const std::uint32_t c = numbering.face_corner[face];
  grid_.resize(size_t(n + 1) * size_t(n + 1));
  const auto put = [&](int i, int j, std::uint32_t vertex) {
    grid_[size_t(j * (n + 1) + i)] = vertex;
    add(vertex, float(i) * step, float(j) * step, middle);
  };
  put(0, 0, numbering.corner_vertex[c]);
  put(n, 0, numbering.corner_vertex[c + 1]);
  put(0, n, numbering.corner_vertex[c + 2]);
  for (int k = 1; k < n; ++k) {
    put(k, 0, numbering.edge_point(c, k));
    put(n - k, k, numbering.edge_point(c + 1, k));
    put(0, n - k, numbering.edge_point(c + 2, k));
  }
  border = points.size();
  std::uint32_t vertex = numbering.face_start[face];
  for (int j = 1; j < n; ++j)
    for (int i = 1; i + j < n; ++i) put(i, j, vertex++);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i + j < n; ++i) {
      const std::uint32_t* g = &grid_[size_t(j * (n + 1) + i)];
      quads.push_back({g[0], g[1], g[n + 1], g[n + 1]});
      if (i + j + 1 < n) quads.push_back({g[1], g[n + 2], g[n + 1], g[n + 1]});
    }
}

void FacePoints::set_coarse_polygon(const Numbering& numbering, size_t face) {
  const int size = numbering.size(face);
  const std::uint32_t c = numbering.face_corner[face];
  for (int k = 0; k < size; ++k) {
    const Vec2 st = corner_coordinates(size, k);
    add(numbering.corner_vertex[c + std::uint32_t(k)], st.x, st.y, st + Vec2(0.25f, 0.25f));
  }
  border = points.size();
  if (size == 3) {
    quads.push_back({points[0].vertex, points[1].vertex, points[2].vertex, points[2].vertex});
    return;
  }
  const std::uint32_t centre = numbering.face_start[face];
  add(centre, 0.5f, 0.5f, Vec2(0.25f, 0.25f));
  for (int k = 0; k < size; ++k) {
    const std::uint32_t a = points[size_t(k)].vertex, b = points[size_t((k + 1) % size)].vertex;
    quads.push_back({a, b, centre, centre});
  }
}

// An n-gon is n quads around its centre. Piece k has corner k at its origin, edge k along its first axis, edge k - 1
// (backwards) along its second; its far sides are the spokes from the middles of those edges to the centre.
void FacePoints::set_polygon(const Numbering& numbering, size_t face) {
  const int size = numbering.size(face), n = numbering.segments, m = n / 2;
  const float step = 0.5f / float(m);
  const std::uint32_t c = numbering.face_corner[face], centre = numbering.face_start[face];
  const auto spoke = [&](int k, int b) { return centre + 1 + std::uint32_t(k * (m - 1) + b - 1); };
  const auto inside = [&](int k, int a, int b) {
    return centre + 1 + std::uint32_t(size * (m - 1) + k * (m - 1) * (m - 1) + (b - 1) * (m - 1) + a - 1);
  };
  for (int k = 0; k < size; ++k) {
    const Vec2 o = corner_coordinates(size, k), middle = o + Vec2(0.25f, 0.25f);
    const std::uint32_t before = c + std::uint32_t((k + size - 1) % size);
    add(numbering.corner_vertex[c + std::uint32_t(k)], o.x, o.y, middle);
    for (int a = 1; a <= m; ++a)
      add(numbering.edge_point(c + std::uint32_t(k), a), o.x + float(a) * step, o.y, middle);
    for (int b = 1; b < m; ++b) add(numbering.edge_point(before, n - b), o.x, o.y + float(b) * step, middle);
  }
  border = points.size();
  const Vec2 first = corner_coordinates(size, 0);
  add(centre, first.x + 0.5f, first.y + 0.5f, first + Vec2(0.25f, 0.25f));
  grid_.resize(size_t(m + 1) * size_t(m + 1));
  for (int k = 0; k < size; ++k) {
    const Vec2 o = corner_coordinates(size, k), middle = o + Vec2(0.25f, 0.25f);
    const int previous = (k + size - 1) % size;
    const std::uint32_t edge = c + std::uint32_t(k), before = c + std::uint32_t(previous);
    const auto g = [&](int a, int b) -> std::uint32_t& { return grid_[size_t(b * (m + 1) + a)]; };
    g(0, 0) = numbering.corner_vertex[edge];
    g(m, m) = centre;
    for (int a = 1; a <= m; ++a) {
      g(a, 0) = numbering.edge_point(edge, a);
      g(0, a) = numbering.edge_point(before, n - a);
    }
    for (int b = 1; b < m; ++b) {
      g(m, b) = spoke(k, b);
      g(b, m) = spoke(previous, b);
      add(g(m, b), o.x + 0.5f, o.y + float(b) * step, middle);
      for (int a = 1; a < m; ++a)
        add(g(a, b) = inside(k, a, b), o.x + float(a) * step, o.y + float(b) * step, middle);
    }
    for (int b = 0; b < m; ++b)
      for (int a = 0; a < m; ++a) quads.push_back({g(a, b), g(a + 1, b), g(a + 1, b + 1), g(a, b + 1)});
  }
}

}  // namespace sateen
