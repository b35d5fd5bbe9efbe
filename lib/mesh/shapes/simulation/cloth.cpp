#include "mesh/shapes/simulation/cloth.h"

#include <cmath>

namespace sateen {
namespace {

/// Inverse of a symmetric positive definite 6x6 matrix by Gauss-Jordan; no pivoting needed.
using Matrix6 = std::array<std::array<double, 6>, 6>;
Matrix6 inverse(Matrix6 a) {
  Matrix6 r{};
  for (int i = 0; i < 6; ++i) r[i][i] = 1;
  for (int i = 0; i < 6; ++i) {
    const double d = 1 / a[i][i];
    for (int k = 0; k < 6; ++k) a[i][k] *= d, r[i][k] *= d;
    for (int j = 0; j < 6; ++j) {
      if (j == i) continue;
      const double f = a[j][i];
      for (int k = 0; k < 6; ++k) a[j][k] -= f * a[i][k], r[j][k] -= f * r[i][k];
    }
  }
  return r;
}

double cross(const Vec2d& a, const Vec2d& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

std::vector<std::array<int, 3>> cloth_triangles(const Cloth& cloth) {
  std::vector<std::array<int, 3>> triangles;
  for (int j = 0; j + 1 < cloth.rows; ++j)
    for (int i = 0; i < cloth.quad_columns(); ++i) {
      const int a = cloth.at(i, j), b = cloth.at(i + 1, j), c = cloth.at(i + 1, j + 1), d = cloth.at(i, j + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  return triangles;
}

std::vector<double> vertex_areas(const Cloth& cloth) {
  std::vector<double> areas(cloth.pattern.size(), 0.0);
  for (const auto& t : cloth_triangles(cloth)) {
    const Vec2d &a = cloth.pattern[t[0]], &b = cloth.pattern[t[1]], &c = cloth.pattern[t[2]];
    for (const int v : t) areas[v] += std::abs(cross(b - a, c - a)) / 6;
  }
  return areas;
}

std::vector<Stencil> bending_stencils(const Cloth& cloth) {
  const std::vector<double> areas = vertex_areas(cloth);
  std::vector<Stencil> stencils;
  const int first = cloth.closed ? 0 : 1, last = cloth.closed ? cloth.columns : cloth.columns - 1;
  for (int j = 1; j + 1 < cloth.rows; ++j)
    for (int i = first; i < last; ++i) {
      const int centre = cloth.at(i, j);
      const double scale = 1 / std::sqrt(areas[centre]);
      Stencil s{};
      s.area = areas[centre];
      std::array<std::array<double, 6>, 9> basis;
      std::array<double, 9> importance;
      Matrix6 normal{};
      for (int k = 0; k < 9; ++k) {
        const int di = k % 3 - 1, dj = k / 3 - 1;
        s.vertices[k] = cloth.at(i + di, j + dj);
        const Vec2d d = (cloth.pattern[s.vertices[k]] - cloth.pattern[centre]) * scale;
        basis[k] = {1, d.x, d.y, 0.5 * d.x * d.x, d.x * d.y, 0.5 * d.y * d.y};
        importance[k] = std::exp(-1.5 * (di * di + dj * dj));  // compact, but all nine take part
        for (int m = 0; m < 6; ++m)
          for (int n = 0; n < 6; ++n) normal[m][n] += importance[k] * basis[k][m] * basis[k][n];
      }
      const Matrix6 fit = inverse(normal);
      for (int second = 3; second < 6; ++second) {
        const double factor = scale * scale * std::sqrt(areas[centre]) * (second == 4 ? std::sqrt(2.0) : 1.0);
        for (int k = 0; k < 9; ++k) {
          double w = 0;
          for (int m = 0; m < 6; ++m) w += fit[second][m] * basis[k][m];
          s.weights[k] = w * importance[k] * factor;
        }
        stencils.push_back(s);
      }
    }
  return stencils;
}

Cloth refine(const Cloth& coarse, const std::function<Vec2d(double, double)>& pattern_at) {
  // Doubles one row of values; ends by the parabola through the last three.
  const auto doubled = [](const std::vector<Vec3d>& p, bool closed) {
    const int n = int(p.size()), cells = closed ? n : n - 1;
    std::vector<Vec3d> r;
    for (int i = 0; i < cells; ++i) {
      const auto get = [&](int k) { return p[(k + n) % n]; };
      r.push_back(p[i]);
      if (closed || (i > 0 && i + 2 < n))
        r.push_back((get(i) + get(i + 1)) * 0.5625 - (get(i - 1) + get(i + 2)) * 0.0625);
      else if (i == 0)
        r.push_back(p[0] * 0.375 + p[1] * 0.75 - p[2] * 0.125);
      else
        r.push_back(p[n - 1] * 0.375 + p[n - 2] * 0.75 - p[n - 3] * 0.125);
    }
    if (!closed) r.push_back(p[n - 1]);
    return r;
  };
  Cloth fine;
  fine.closed = coarse.closed;
  fine.columns = coarse.closed ? 2 * coarse.columns : 2 * coarse.columns - 1;
  fine.rows = 2 * coarse.rows - 1;
  const std::size_t count = std::size_t(fine.columns) * fine.rows;
  const auto both = [&](const std::vector<Vec3d>& from) {
    std::vector<std::vector<Vec3d>> rows;
    for (int j = 0; j < coarse.rows; ++j)
      rows.push_back(
          doubled({from.begin() + j * coarse.columns, from.begin() + (j + 1) * coarse.columns}, coarse.closed));
    std::vector<Vec3d> to(count), column(coarse.rows);
    for (int i = 0; i < fine.columns; ++i) {
      for (int j = 0; j < coarse.rows; ++j) column[j] = rows[j][i];
      const std::vector<Vec3d> d = doubled(column, false);
      for (int j = 0; j < fine.rows; ++j) to[j * fine.columns + i] = d[j];
    }
    return to;
  };
  fine.positions = both(coarse.positions);
  fine.velocities = both(coarse.velocities);
  fine.inverse_mass.assign(count, 1.0);
  for (int j = 0; j < fine.rows; ++j)
    for (int i = 0; i < fine.columns; ++i)
      fine.pattern.push_back(pattern_at(double(i) / fine.quad_columns(), double(j) / (fine.rows - 1)));
  return fine;
}

}  // namespace sateen
