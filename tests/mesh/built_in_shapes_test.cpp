#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "mesh/mesh_checks.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"

// The two simulated cages, checked as what they claim to be: inextensible cloth that nowhere passes through itself.

namespace sateen {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> triangles_of(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (const auto& q : mesh.quads) {
    triangles.push_back({q[0], q[1], q[2]});
    if (q[3] != q[2]) triangles.push_back({q[0], q[2], q[3]});
  }
  return triangles;
}

double volume(const Vec3d& o, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  return (a - o).dot((b - o).cross(c - o));
}

bool pierces(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
  if ((volume(p, a, b, c) > 0) == (volume(q, a, b, c) > 0)) return false;
  const bool s0 = volume(p, q, a, b) > 0, s1 = volume(p, q, b, c) > 0, s2 = volume(p, q, c, a) > 0;
  return s0 == s1 && s1 == s2;
}

/// Pairs of an edge and a triangle that pierce each other and share no vertex.
int crossings(const Mesh& mesh) {
  const std::vector<Triangle> triangles = triangles_of(mesh);
  std::vector<Vec3d> x;
  for (const Vec3& p : mesh.positions) x.push_back(Vec3d(p));
  double cell = 0;
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      edges.insert({std::min(a, b), std::max(a, b)});
      cell = std::max(cell, (x[a] - x[b]).length());
    }
  using Cell = std::array<int, 3>;
  const auto range = [&](std::initializer_list<std::uint32_t> vertices) {
    std::array<Cell, 2> r{Cell{1 << 30, 1 << 30, 1 << 30}, Cell{-(1 << 30), -(1 << 30), -(1 << 30)}};
    for (const std::uint32_t v : vertices)
      for (int k = 0; k < 3; ++k) {
        r[0][k] = std::min(r[0][k], int(std::floor(x[v][k] / cell)));
        r[1][k] = std::max(r[1][k], int(std::floor(x[v][k] / cell)));
      }
    return r;
  };
  const auto visit = [](const std::array<Cell, 2>& r, const auto& body) {
    for (int i = r[0][0]; i <= r[1][0]; ++i)
      for (int j = r[0][1]; j <= r[1][1]; ++j)
        for (int k = r[0][2]; k <= r[1][2]; ++k) body((std::int64_t(i) * 4096 + j) * 4096 + k);
  };
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    visit(range({triangles[i][0], triangles[i][1], triangles[i][2]}), [&](std::int64_t c) { cells[c].push_back(i); });
  int count = 0;
  std::set<std::uint32_t> hit;
  for (const auto& e : edges) {
    hit.clear();
    visit(range({e[0], e[1]}), [&](std::int64_t c) {
      const auto found = cells.find(c);
      if (found == cells.end()) return;
      for (const std::uint32_t i : found->second) {
        const Triangle& t = triangles[i];
        bool shared = false;
        for (const std::uint32_t v : t) shared |= v == e[0] || v == e[1];
        if (!shared && pierces(x[e[0]], x[e[1]], x[t[0]], x[t[1]], x[t[2]])) hit.insert(i);
      }
    });
    count += int(hit.size());
  }
  return count;
}

/// Edges of the cage with the number of faces at each.
std::map<std::array<int, 2>, int> edges_of(const ControlMesh& cage) {
  std::map<std::array<int, 2>, int> edges;
  for (std::size_t f = 0; f < cage.face_sizes.size(); ++f)
    for (int k = 0; k < 4; ++k) {
      const int a = cage.position_indices[4 * f + k], b = cage.position_indices[4 * f + (k + 1) % 4];
      ++edges[{std::min(a, b), std::max(a, b)}];
    }
  return edges;
}

class SimulatedShape : public ::testing::TestWithParam<const char*> {
 protected:
  ControlMesh cage = built_in_shape(GetParam());
};

TEST_P(SimulatedShape, HasOneTextureCoordinateAVertexAndEdgesThatKeepTheirLength) {
  ASSERT_EQ(cage.uv_indices, cage.position_indices);
  double squares = 0;
  const auto edges = edges_of(cage);
  for (const auto& [edge, faces] : edges) {
    const double rest = double((cage.uvs[edge[0]] - cage.uvs[edge[1]]).length());
    const double ratio = double((cage.positions[edge[0]] - cage.positions[edge[1]]).length()) / rest;
    ASSERT_GT(rest, 0.002);
    EXPECT_NEAR(ratio, 1, 0.03) << edge[0] << " " << edge[1];
    squares += (ratio - 1) * (ratio - 1);
    EXPECT_LE(faces, 2);
  }
  EXPECT_LT(std::sqrt(squares / double(edges.size())), 0.005);
}

TEST_P(SimulatedShape, HasNoCornerThatIsCollapsedOrReflex) {
  for (std::size_t f = 0; f < cage.face_sizes.size(); ++f) {
    ASSERT_EQ(cage.face_sizes[f], 4);
    const int* v = &cage.position_indices[4 * f];
    const auto& p = cage.positions;
    const Vec3 normal = cross(p[v[2]] - p[v[0]], p[v[3]] - p[v[1]]);
    for (int k = 0; k < 4; ++k) {
      const Vec3 a = p[v[(k + 1) % 4]] - p[v[k]], b = p[v[(k + 3) % 4]] - p[v[k]];
      const float angle = degrees(std::acos(dot(a.normalized(), b.normalized())));
      EXPECT_GT(angle, 40) << "face " << f;
      EXPECT_LT(angle, 140) << "face " << f;
      EXPECT_GT(dot(cross(a, b), normal), 0) << "face " << f;
    }
  }
}

TEST_P(SimulatedShape, NowherePassesThroughItself) {
  for (int level = 0; level <= 1; ++level) EXPECT_EQ(crossings(subdivide(cage, level)), 0) << "level " << level;
}

TEST_P(SimulatedShape, BendsSmoothly) {
  // Angle between the normals at the ends of an edge of the once refined surface, some 5 mm apart.
  const Mesh mesh = subdivide(cage, 1);
  double sum = 0, worst = 0;
  int count = 0;
  for (const auto& q : mesh.quads)
    for (int k = 0; k < 4; ++k) {
      const double cosine = double(dot(mesh.normals[q[k]], mesh.normals[q[(k + 1) % 4]]));
      const double turn = std::acos(std::min(1.0, cosine)) * 180 / 3.14159265358979;
      sum += turn;
      worst = std::max(worst, turn);
      ++count;
    }
  EXPECT_LT(sum / count, 8);
  EXPECT_LT(worst, 75);
}

TEST_P(SimulatedShape, ShowsItsFaceSideOutwards) {
  const Mesh mesh = subdivide(cage, 0);
  std::set<int> border;
  for (const auto& [edge, faces] : edges_of(cage))
    if (faces == 1) border.insert({edge[0], edge[1]});
  ASSERT_EQ(mesh.positions.size(), cage.positions.size());
  int tried = 0;
  for (int i = 0; i < 200; ++i) {
    // The point that lies farthest in a direction has its outer normal there.
    const float y = 0.7f * float(i) / 200, turn = 2.39996323f * float(i), r = std::sqrt(1 - y * y);
    const Vec3 direction(r * std::cos(turn), y, r * std::sin(turn));
    std::size_t farthest = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      if (dot(mesh.positions[v], direction) > dot(mesh.positions[farthest], direction)) farthest = v;
    bool inside = true;
    for (const int b : border) inside &= cage.positions[b] != mesh.positions[farthest];
    for (const int b : border) inside &= (cage.positions[b] - mesh.positions[farthest]).length() > 0.002f;
    if (!inside) continue;
    ++tried;
    EXPECT_GT(dot(mesh.normals[farthest], direction), 0.5f);
  }
  EXPECT_GT(tried, 20);
}

INSTANTIATE_TEST_SUITE_P(All, SimulatedShape, ::testing::Values("drape", "skirt"),
                         [](const auto& each) { return std::string(each.param); });

TEST(SimulatedShapes, TheCountOfCrossingsSeesASheetThatPassesThroughAnother) {
  const auto flat = [](float i, float j) { return Vec3(i, 0, -j); };
  const auto chart = [](float i, float j) { return Vec2(i, j); };
  ControlMesh cage = grid_cage(4, 4, flat, chart);
  EXPECT_EQ(crossings(subdivide(cage, 0)), 0);
  const ControlMesh other = grid_cage(
      4, 4, [](float i, float j) { return Vec3(i + 0.1f, j - 1.7f, -i - 0.3f); }, chart);
  const int shift = int(cage.positions.size());
  cage.positions.insert(cage.positions.end(), other.positions.begin(), other.positions.end());
  cage.uvs.insert(cage.uvs.end(), other.uvs.begin(), other.uvs.end());
  for (const int v : other.position_indices) cage.position_indices.push_back(v + shift);
  for (const int v : other.uv_indices) cage.uv_indices.push_back(v + shift);
  cage.face_sizes.insert(cage.face_sizes.end(), other.face_sizes.begin(), other.face_sizes.end());
  EXPECT_GT(crossings(subdivide(cage, 0)), 4);
}

TEST(Drape, StandsOnTheFloorAndIsAsHighAsItsForm) {
  const Mesh mesh = subdivide(built_in_shape("drape"), 1);
  EXPECT_GT(mesh.bounds_min.y, 0);
  EXPECT_LT(mesh.bounds_min.y, 0.01f);
  EXPECT_GT(mesh.bounds_max.y, 0.35f);
  EXPECT_LT(mesh.bounds_max.y, 0.55f);
}

TEST(Drape, TheThreadsOfItsLimitSurfaceKeepTheirLength) {
  const Mesh mesh = subdivide(built_in_shape("drape"), 2);
  double sum = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    sum += std::abs(double(mesh.dpdu[i].length()) - 1) + std::abs(double(mesh.dpdv[i].length()) - 1);
  // The limit surface cuts the corners of the cage's folds and is shorter by some 1.9 % in the mean.
  EXPECT_LT(sum / double(2 * mesh.positions.size()), 0.025);
}

TEST(Skirt, HangsFromItsWaistWithFoldsThatOpenTowardsTheHem) {
  const ControlMesh cage = built_in_shape("skirt");
  const Mesh mesh = subdivide(cage, 1);
  EXPECT_NEAR(mesh.bounds_max.y, 0.75f, 0.002f);
  EXPECT_GT(mesh.bounds_min.y, 0.1f);
  // Distance from the axis around the hem swings out and in, many times, while the waist is a plain ellipse.
  std::vector<std::pair<double, double>> hem, waist;
  for (std::size_t v = 0; v < cage.positions.size(); ++v) {
    const double along = double(cage.uvs[v].length());
    const std::pair<double, double> point(std::atan2(double(cage.uvs[v].y), double(cage.uvs[v].x)),
                                          std::hypot(double(cage.positions[v].x), double(cage.positions[v].z)));
    if (along > 0.717) hem.push_back(point);
    if (along < 0.119) waist.push_back(point);
  }
  const auto swings = [](std::vector<std::pair<double, double>>& ring, double least) {
    std::sort(ring.begin(), ring.end());
    int count = 0;
    double low = 1e30, high = -1e30;
    bool outwards = true;
    for (int turn = 0; turn < 2; ++turn)
      for (const auto& [angle, radius] : ring) {
        low = std::min(low, radius), high = std::max(high, radius);
        if (outwards ? radius < high - least : radius > low + least) {
          count += turn;
          outwards = !outwards;
          low = high = radius;
        }
      }
    return count / 2;
  };
  EXPECT_GE(swings(hem, 0.03), 7);
  EXPECT_LE(swings(waist, 0.03), 1);
}

}  // namespace
}  // namespace sateen
