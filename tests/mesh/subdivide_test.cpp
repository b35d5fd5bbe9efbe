#include "mesh/subdivide.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "base/error.h"
#include "mesh/mesh_checks.h"
#include "mesh/obj.h"

namespace sateen {
namespace {

Vec2 plain(float x, float y) {
  return Vec2(x, y);
}
Vec3 flat(float x, float y) {
  return Vec3(x, y, 0);
}

TEST(Subdivide, APlaneStaysAPlaneWithExactDerivativesInEveryChart) {
  // A plane that lies askew, UVs affine in it but sheared and scaled: dP/du and dP/dv are known.
  const Vec3 a(2, 0.5f, -1), b(-0.25f, 1.5f, 0.75f);
  const auto plane = [&](float x, float y) { return Vec3(7, -3, 11) + a * x + b * y; };
  const auto chart = [](float x, float y) { return Vec2(0.4f * x + 0.1f * y + 5, -0.2f * x + 0.3f * y - 2); };
  // x = (0.3 u' - 0.1 v') / 0.14, y = (0.2 u' + 0.4 v') / 0.14
  const Vec3 dpdu = (a * 0.3f + b * 0.2f) / 0.14f, dpdv = (b * 0.4f - a * 0.1f) / 0.14f;
  for (const ControlMesh::FvarBoundary rule :
       {ControlMesh::FvarBoundary::corners_plus1, ControlMesh::FvarBoundary::all}) {
    for (int level = 0; level <= 3; ++level) {
      ControlMesh cage = grid_cage(6, 5, plane, chart);
      cage.fvar_boundary = rule;
      const Mesh mesh = subdivide(cage, level);
      expect_sound(mesh);
      EXPECT_EQ(mesh.quads.size(), 30u << (2 * level));
      EXPECT_EQ(mesh.positions.size(), size_t((6 << level) + 1) * size_t((5 << level) + 1));
      EXPECT_EQ(mesh.fallback_warps, 0);
      const Vec3 normal = cross(a, b).normalized();
      for (size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(dot(mesh.positions[i] - plane(0, 0), normal), 0, 1e-5);
        EXPECT_NEAR((mesh.normals[i] - normal).length(), 0, 1e-6);
        EXPECT_NEAR((mesh.dpdu[i] - dpdu).length(), 0, 2e-4 * dpdu.length());
        EXPECT_NEAR((mesh.dpdv[i] - dpdv).length(), 0, 2e-4 * dpdv.length());
      }
    }
  }
}

TEST(Subdivide, PositionsOfABicubicCageAreThoseOfItsSpline) {
  // Control points of a uniform cubic B-spline at x^2: the limit is x^2 + 1/3, its slope 2x.
  const auto bowl = [](float x, float y) { return Vec3(x, y, x * x - 0.5f * y * y); };
  const Mesh mesh = subdivide(grid_cage(8, 8, bowl, plain), 3);
  int inner = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    if (p.x < 0.999f || p.x > 7.001f || p.y < 0.999f || p.y > 7.001f)
      continue;  // the border cells end in other rules
    ++inner;
    EXPECT_NEAR(p.z, p.x * p.x - 0.5f * p.y * p.y + 1.0f / 6, 3e-5);
    EXPECT_NEAR((mesh.dpdu[i] - Vec3(1, 0, 2 * p.x)).length(), 0, 2e-4);
    EXPECT_NEAR((mesh.dpdv[i] - Vec3(0, 1, -p.y)).length(), 0, 2e-4);
    EXPECT_NEAR((mesh.normals[i] - Vec3(-2 * p.x, p.y, 1).normalized()).length(), 0, 2e-5);
    EXPECT_NEAR((mesh.uvs[i] - Vec2(p.x, p.y)).length(), 0, 1e-5);
  }
  EXPECT_EQ(inner, 49 * 49);
}

TEST(Subdivide, DerivativesAgreeWithFiniteDifferencesAcrossQuads) {
  const auto wave = [](float x, float y) { return Vec3(x, y, 0.7f * std::sin(x) * std::cos(0.8f * y)); };
  const auto chart = [](float x, float y) { return Vec2(x + 0.15f * std::sin(y), y + 0.1f * std::cos(x)); };
  const Mesh mesh = subdivide(grid_cage(10, 10, wave, chart), 4);
  // A central difference through each quad, against the mean of its corners' derivatives.
  double worst = 0;
  for (const auto& q : mesh.quads) {
    const Vec3 du = mesh.dpdu[q[0]] + mesh.dpdu[q[1]] + mesh.dpdu[q[2]] + mesh.dpdu[q[3]];
    const Vec3 dv = mesh.dpdv[q[0]] + mesh.dpdv[q[1]] + mesh.dpdv[q[2]] + mesh.dpdv[q[3]];
    const Vec2 w = mesh.uvs[q[1]] + mesh.uvs[q[2]] - mesh.uvs[q[0]] - mesh.uvs[q[3]];
    const Vec3 step = mesh.positions[q[1]] + mesh.positions[q[2]] - mesh.positions[q[0]] - mesh.positions[q[3]];
    worst = std::max(worst, double((step - (du * w.x + dv * w.y) * 0.25f).length() / step.length()));
  }
  EXPECT_LT(worst, 2e-3);
}

TEST(Subdivide, ACubeBecomesTheKnownRoundShape) {
  // Limit of a cube's corner (valence 3) is (9 C + 4 sum E + sum F) / 24: for the corner (1,1,1), 5/12 ... per axis.
  const ControlMesh cage = parse_obj(
      "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
      "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n",
      "cube");
  for (int level = 0; level <= 4; ++level) {
    const Mesh mesh = subdivide(cage, level);
    expect_sound(mesh);
    int corners = 0;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vec3& p = mesh.positions[i];
      EXPECT_GT(dot(p, mesh.normals[i]), 0);
      if (std::abs(std::abs(p.x) - std::abs(p.y)) > 1e-4 || std::abs(std::abs(p.x) - std::abs(p.z)) > 1e-4) continue;
      ++corners;
      // 9 + 4 * (1 + 1 - 1) + (1 - 1 - 1) = 12 of 24
      EXPECT_NEAR(std::abs(p.x), 0.5f, 1e-5);
      EXPECT_NEAR(std::abs(dot(mesh.normals[i], p.normalized())), 1, 1e-5);
    }
    EXPECT_EQ(corners, 8);
    EXPECT_EQ(mesh.fallback_warps, std::int64_t(mesh.positions.size())) << "the cube has no UVs";
  }
}

TEST(Subdivide, PointsAroundAnExtraordinaryVertexDoNotDependOnTheLevel) {
  ControlMesh cage = parse_obj(
      "v 0 0 0.5\nv 1 0 0\nv 1 1 0.2\nv 0 1 0\nv -1 0.7 0.1\nv -1 0 0\nv -0.5 -1 0\nv 0.6 -1 0.3\n"
      "f 1 2 3 4\nf 1 4 5 6\nf 1 6 7 8\nf 1 8 2\n",
      "fan");
  // Every point of a coarse level is one of each finer level, in the same place: they are all limit points.
  const Mesh fine = subdivide(cage, 5);
  for (int level = 1; level <= 4; ++level) {
    const Mesh coarse = subdivide(cage, level);
    for (const Vec3& p : coarse.positions) {
      float nearest = 1e9f;
      for (const Vec3& q : fine.positions) nearest = std::min(nearest, (p - q).length());
      EXPECT_LT(nearest, 2e-6f) << "level " << level;
    }
  }
}

TEST(Subdivide, UniformRefinementAgreesWithTheFaceByFaceEvaluation) {
  // A vertex of two faces sends the whole cage through Far's uniform refinement: a closed pillow beside the sheet.
  const auto wave = [](float x, float y) { return Vec3(x, y, std::sin(x) + 0.4f * std::cos(1.3f * y)); };
  ControlMesh cage = grid_cage(7, 6, wave, [](float x, float y) { return Vec2(x + 0.2f * y, y); });
  // The last quad becomes two triangles, and one before it a hole.
  cage.face_sizes.back() = 3;
  cage.face_sizes.push_back(3);
  for (const int k : {0, 2}) {
    cage.position_indices.push_back(cage.position_indices[41 * 4 + size_t(k)]);
    cage.uv_indices.push_back(cage.position_indices.back());
  }
  std::swap(cage.position_indices[41 * 4 + 3], cage.position_indices[41 * 4 + 5]);
  std::swap(cage.uv_indices[41 * 4 + 3], cage.uv_indices[41 * 4 + 5]);
  std::swap(cage.position_indices[41 * 4 + 3], cage.position_indices[41 * 4 + 4]);
  std::swap(cage.uv_indices[41 * 4 + 3], cage.uv_indices[41 * 4 + 4]);
  cage.holes = {17};
  ControlMesh with_pillow = cage;
  for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
    with_pillow.positions.push_back(Vec3(p.x, p.y, 1));
  with_pillow.face_sizes.insert(with_pillow.face_sizes.end(), {4, 4});
  for (const int k : {56, 57, 58, 59, 59, 58, 57, 56}) {
    with_pillow.position_indices.push_back(k);
    with_pillow.uv_indices.push_back(k - 56);
  }
  for (int level = 0; level <= 4; ++level) {
    const Mesh one = subdivide(cage, level), other = subdivide(with_pillow, level);
    EXPECT_NE(one.positions.size(), other.positions.size());
    double position = 0, normal = 0, uv = 0, warp = 0;
    for (size_t i = 0; i < one.positions.size(); ++i) {
      size_t nearest = 0;
      for (size_t k = 0; k < other.positions.size(); ++k)
        if ((other.positions[k] - one.positions[i]).length2() <
            (other.positions[nearest] - one.positions[i]).length2())
          nearest = k;
      position = std::max(position, double((other.positions[nearest] - one.positions[i]).length()));
      normal = std::max(normal, double((other.normals[nearest] - one.normals[i]).length()));
      uv = std::max(uv, double((other.uvs[nearest] - one.uvs[i]).length()));
      warp = std::max(warp, double((other.dpdu[nearest] - one.dpdu[i]).length()));
    }
    EXPECT_LT(uv, 1e-5) << level;
    if (level == 0) continue;  // polygons have a point in their middle in one of the ways
    EXPECT_LT(position, 5e-6) << level;
    if (level >= 3) {
      EXPECT_LT(warp, 0.2) << level << ": differences of first order on borders";
    }
    EXPECT_LT(normal, 2e-3) << level << ": Bfr's tangent plane in the middle of a triangle is off by 0.06 degrees";
  }
}

TEST(Subdivide, UvSeamsAreWatertightAndSplit) {
  // A tube of 12 by 3 quads, closed, whose UVs run from 0 to 12 around.
  ControlMesh cage;
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i < 12; ++i) {
      const float a = 2 * pi * float(i) / 12;
      cage.positions.push_back(Vec3(std::cos(a) + 0.1f * float(j), std::sin(a), float(j)));
    }
  for (int j = 0; j <= 3; ++j)
    for (int i = 0; i <= 12; ++i) cage.uvs.push_back(Vec2(float(i), float(j)));
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 12; ++i) {
      cage.face_sizes.push_back(4);
      const auto p = [&](int x, int y) {
        cage.position_indices.push_back(y * 12 + x % 12);
        cage.uv_indices.push_back(y * 13 + x);
      };
      p(i, j);
      p(i + 1, j);
      p(i + 1, j + 1);
      p(i, j + 1);
    }
  const Mesh mesh = subdivide(cage, 3);
  expect_sound(mesh);
  using Bits = std::array<std::uint32_t, 3>;
  std::map<Bits, std::vector<size_t>> at;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    Bits bits;
    std::memcpy(bits.data(), &mesh.positions[i], 12);
    at[bits].push_back(i);
  }
  int split = 0;
  for (const auto& [bits, vertices] : at) {
    ASSERT_LE(vertices.size(), 2u);
    if (vertices.size() != 2) continue;
    ++split;
    EXPECT_NEAR(std::abs(mesh.uvs[vertices[0]].x - mesh.uvs[vertices[1]].x), 12, 1e-4);
    EXPECT_NEAR((mesh.normals[vertices[0]] - mesh.normals[vertices[1]]).length(), 0, 1e-5);
  }
  EXPECT_EQ(split, 3 * 8 + 1);
  EXPECT_EQ(at.size(), size_t(96 * 25));
}

TEST(Subdivide, SharpCreasesStaySharpAndSoftOnesDoNot) {
  const auto roof = [](float x, float y) { return Vec3(x, y, -std::abs(x - 3)); };
  const auto bent = [&](float sharpness) {
    ControlMesh cage = grid_cage(6, 4, roof, plain);
    for (int j = 0; j < 4; ++j) cage.creases.push_back({{j * 7 + 3, (j + 1) * 7 + 3}, sharpness});
    return subdivide(cage, 3);
  };
  const Mesh sharp = bent(10), soft = bent(2), none = bent(0);
  const auto ridge = [](const Mesh& mesh) {
    int up = 0, sloped = 0;
    float top = -10;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      if (std::abs(mesh.positions[i].x - 3) > 1e-4f) continue;
      (std::abs(mesh.normals[i].z - 1) < 1e-3f ? up : sloped) += 1;
      top = std::max(top, mesh.positions[i].z);
    }
    top = std::round(top * 1e5f) / 1e5f;
    return std::tuple(up, sloped, top);
  };
  EXPECT_EQ(ridge(sharp), std::tuple(0, 66, 0.0f)) << "a vertex for each slope, at the height of the cage";
  EXPECT_EQ(std::get<0>(ridge(soft)), 33);
  EXPECT_EQ(std::get<1>(ridge(none)), 0);
  EXPECT_GT(std::get<2>(ridge(soft)), std::get<2>(ridge(none)) + 0.1f);
  EXPECT_LT(std::get<2>(ridge(soft)), 0);
  expect_sound(sharp);
}

TEST(Subdivide, HolesAreCut) {
  ControlMesh cage = grid_cage(5, 5, flat, plain);
  cage.holes = {12};
  const Mesh mesh = subdivide(cage, 2);
  expect_sound(mesh);
  EXPECT_EQ(mesh.quads.size(), 24u * 16);
  for (const Vec3& p : mesh.positions) EXPECT_FALSE(p.x > 2.01f && p.x < 2.99f && p.y > 2.01f && p.y < 2.99f);
}

TEST(Subdivide, BoundaryRulesDecideAboutCornersAndBorders) {
  ControlMesh cage = grid_cage(4, 4, flat, plain);
  const auto corner_distance = [&](ControlMesh::Boundary rule) {
    cage.boundary = rule;
    const Mesh mesh = subdivide(cage, 2);
    expect_sound(mesh);
    float nearest = 10;
    for (const Vec3& p : mesh.positions) nearest = std::min(nearest, p.length());
    return nearest;
  };
  EXPECT_NEAR(corner_distance(ControlMesh::Boundary::edge_and_corner), 0, 1e-6);
  EXPECT_NEAR(corner_distance(ControlMesh::Boundary::edge_only), std::sqrt(2.0f) / 6, 1e-5);
  EXPECT_NEAR(corner_distance(ControlMesh::Boundary::none), std::sqrt(2.0f), 1e-5)
      << "the border faces have no limit";
}

TEST(Subdivide, TrianglesUnderLoopGiveTrianglesOfTheBoxSpline) {
  ControlMesh cage;
  cage.scheme = ControlMesh::Scheme::loop;
  const int n = 8;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      // A lattice of equilateral triangles.
      const float x = float(i) + 0.5f * float(j), y = 0.8660254f * float(j);
      cage.positions.push_back(Vec3(x, y, x * x + y * y));
      cage.uvs.push_back(Vec2(x, y));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = j * (n + 1) + i;
      for (const int k : {v, v + 1, v + n + 1, v + 1, v + n + 2, v + n + 1}) {
        cage.position_indices.push_back(k);
        cage.uv_indices.push_back(k);
      }
      cage.face_sizes.insert(cage.face_sizes.end(), {3, 3});
    }
  const Mesh mesh = subdivide(cage, 3);
  expect_sound(mesh);
  EXPECT_EQ(mesh.triangles(), 2 * n * n * 64);
  int inner = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = mesh.positions[i];
    const float j = p.y / 0.8660254f, k = p.x - 0.5f * j;
    if (j < 2 || k < 2 || j + k > 2 * n - 4 || j > n - 2 || k > n - 2) continue;
    ++inner;
    // The limit mask (1/2, 6 x 1/12) adds 1/2 to r^2 at the lattice; the box spline reproduces quadratics in between.
    EXPECT_NEAR(p.z, p.x * p.x + p.y * p.y + 0.5f, 1e-3);
    EXPECT_NEAR((mesh.dpdu[i] - Vec3(1, 0, 2 * p.x)).length(), 0, 5e-3);
  }
  EXPECT_GT(inner, 300);
}

TEST(Subdivide, MirroredUvsMeetAtASplitAndKeepTheirWarp) {
  // Both halves share the UVs of the mirror line, and u runs outwards from it.
  ControlMesh cage = grid_cage(6, 3, flat, [](float x, float y) { return Vec2(std::abs(x - 3), y); });
  const Mesh mesh = subdivide(cage, 2);
  expect_sound(mesh);
  EXPECT_EQ(mesh.fallback_warps, 0);
  int right = 0, left = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (std::abs(mesh.positions[i].x - 3) > 1e-5f) continue;
    (mesh.dpdu[i].x > 0 ? right : left) += 1;
  }
  EXPECT_EQ(right, 13);
  EXPECT_EQ(left, 13);
}

TEST(Subdivide, TheSameBitsComeFromAnyNumberOfThreads) {
  const auto wave = [](float x, float y) { return Vec3(x, y, std::sin(x * y)); };
  ControlMesh cage = grid_cage(60, 70, wave, [](float x, float y) { return Vec2(x * 0.1f, y * 0.1f); });
  cage.face_sizes.push_back(3);
  for (const int k : {0, 61, 122}) {
    cage.position_indices.push_back(k);
    cage.uv_indices.push_back(k);
  }
  const Mesh one = subdivide(cage, 2, 1);
  for (const int threads : {2, 3, 8}) {
    const Mesh other = subdivide(cage, 2, threads);
    EXPECT_EQ(one.quads, other.quads);
    EXPECT_EQ(0, std::memcmp(one.positions.data(), other.positions.data(), one.positions.size() * 12));
    EXPECT_EQ(0, std::memcmp(one.normals.data(), other.normals.data(), one.normals.size() * 12));
    EXPECT_EQ(0, std::memcmp(one.dpdu.data(), other.dpdu.data(), one.dpdu.size() * 12));
    EXPECT_EQ(0, std::memcmp(one.uvs.data(), other.uvs.data(), one.uvs.size() * 8));
  }
}

TEST(Subdivide, LevelZeroKeepsQuadsAndFansOtherPolygonsAroundTheirCentre) {
  const ControlMesh cage = parse_obj(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 1.5 2 0\n"
      "f 1 2 3 4\nf 2 5 6 7 3\nf 4 3 7\n",
      "mixed");
  const Mesh mesh = subdivide(cage, 0);
  expect_sound(mesh);
  EXPECT_EQ(mesh.quads.size(), 1u + 5 + 1);
  EXPECT_EQ(mesh.triangles(), 2 + 5 + 1);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_EQ(quads_at_level(cage, 0), 7);
  EXPECT_EQ(quads_at_level(cage, 3), 64 + 5 * 16 + 3 * 16);
  EXPECT_EQ(std::int64_t(subdivide(cage, 3).quads.size()), quads_at_level(cage, 3));
}

TEST(Subdivide, MissingUvsGiveTheObjectsXOrZAxisAsWarp) {
  ControlMesh cage = grid_cage(
      3, 3, [](float x, float y) { return Vec3(x, 0, -y); }, plain);
  cage.uvs.clear();
  cage.uv_indices.clear();
  const Mesh floor = subdivide(cage, 1);
  EXPECT_EQ(floor.fallback_warps, std::int64_t(floor.positions.size()));
  for (size_t i = 0; i < floor.positions.size(); ++i) {
    EXPECT_EQ(floor.dpdu[i], Vec3(1, 0, 0));
    EXPECT_EQ(floor.dpdv[i], Vec3(0, 0, -1));
    EXPECT_EQ(floor.uvs[i], Vec2(0, 0));
  }
  for (Vec3& p : cage.positions) p = Vec3(0, p.x, p.z);
  const Mesh wall = subdivide(cage, 1);
  for (const Vec3& u : wall.dpdu) EXPECT_NEAR(std::abs(u.z), 1, 1e-6);
}

TEST(Subdivide, RefusesLevelsOutOfRange) {
  const ControlMesh cage = grid_cage(1, 1, flat, plain);
  for (const int level : {-1, 7}) {
    try {
      subdivide(cage, level);
      FAIL();
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()), "error: subdivision level is " + std::to_string(level) + ", expected 0 to 6");
    }
  }
}

}  // namespace
}  // namespace sateen
