#include "mesh/cut_polygon.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <set>

#include "mesh/control_mesh.h"
#include "mesh/mesh_checks.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

/// Area of the faces' vectors: of flat faces that overlap nowhere, their area.
double area_of(const ControlMesh& cage, bool in_uv = false) {
  double area = 0;
  size_t at = 0;
  for (const int size : cage.face_sizes) {
    const auto point = [&](int k) {
      const size_t corner = at + size_t(k);
      if (!in_uv) return Vec3d(cage.positions[size_t(cage.position_indices[corner])]);
      const Vec2 uv = cage.uvs[size_t(cage.uv_indices[corner])];
      return Vec3d(double(uv.x), double(uv.y), 0);
    };
    Vec3d sum(0);
    for (int k = 1; k + 1 < size; ++k) sum += (point(k) - point(0)) % (point(k + 1) - point(0));
    area += sum.length() / 2;
    at += size_t(size);
  }
  return area;
}

/// A face over points in the plane z = x / 2, with a texture coordinate of its own at every corner.
ControlMesh face_of(const std::vector<Vec2>& points, const std::vector<int>& corners) {
  std::string text, face = "f";
  for (const Vec2& p : points) text += fmt::format("v {} {} {}\n", p.x, p.y, p.x / 2);
  for (size_t i = 0; i < corners.size(); ++i) {
    text += fmt::format("vt {} {}\n", points[size_t(corners[i]) - 1].x, points[size_t(corners[i]) - 1].y);
    face += fmt::format(" {}/{}", corners[i], i + 1);
  }
  return parse_obj(text + face + "\n", "face.obj");
}

void expect_cut(const ControlMesh& cage, double flat_area) {
  EXPECT_GT(cage.face_sizes.size(), 1u);
  EXPECT_NEAR(area_of(cage), flat_area * std::sqrt(1.25), 1e-5);
  EXPECT_NEAR(area_of(cage, true), flat_area, 1e-5);
  size_t at = 0;
  for (const int size : cage.face_sizes) {
    std::set<int> met(cage.position_indices.begin() + long(at), cage.position_indices.begin() + long(at) + size);
    EXPECT_EQ(met.size(), size_t(size));
    // Texture coordinates are those of the vertices here.
    for (size_t k = at; k < at + size_t(size); ++k) {
      const Vec3& p = cage.positions[size_t(cage.position_indices[k])];
      EXPECT_EQ(cage.uvs[size_t(cage.uv_indices[k])], Vec2(p.x, p.y));
    }
    at += size_t(size);
  }
  ASSERT_EQ(cage.warnings.size(), 1u);
  EXPECT_EQ(cage.warnings[0].substr(cage.warnings[0].find(": ") + 2),
            "1 face meets a vertex twice, as around a hole: it was cut into simple ones");
  for (int level = 0; level < 3; ++level) {
    const Mesh mesh = subdivide(cage, level);
    expect_sound(mesh);
    // Its corners stay sharp, and so the surface has the polygon's area too. Around a corner that is bent inwards
    // Catmull-Clark folds over a little, in the plane.
    Vec3d area(0);
    double folded = 0;
    for (const auto& q : mesh.quads) {
      const Vec3d a(mesh.positions[q[0]]), b(mesh.positions[q[1]]), c(mesh.positions[q[2]]), d(mesh.positions[q[3]]);
      for (const Vec3d& half : {(b - a) % (c - a) * 0.5, (c - a) % (d - a) * 0.5}) {
        area += half;
        folded += half.length();
      }
    }
    EXPECT_NEAR(area.length(), flat_area * std::sqrt(1.25), 1e-4) << level;
    EXPECT_LT(folded, 1.06 * flat_area * std::sqrt(1.25)) << level;
  }
}

const std::vector<Vec2> frame{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};

TEST(CutPolygon, APanelWithAHoleKeepsItsAreaAndTextureCoordinates) {
  expect_cut(face_of(frame, {1, 2, 3, 4, 1, 5, 6, 7, 8, 5}), 12);
  // Written from another corner, and the other way round.
  expect_cut(face_of(frame, {6, 7, 8, 5, 1, 2, 3, 4, 1, 5}), 12);
  expect_cut(face_of(frame, {5, 8, 7, 6, 5, 1, 4, 3, 2, 1}), 12);
  // A bridge from the middle of nowhere near.
  expect_cut(face_of(frame, {1, 2, 3, 7, 8, 5, 6, 7, 3, 4}), 12);
}

TEST(CutPolygon, TwoHolesAndAConcavePanelWork) {
  expect_cut(face_of({{0, 0}, {8, 0}, {8, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {5, 1}, {5, 3}, {7, 3}, {7, 1}},
                     {1, 2, 12, 9, 10, 11, 12, 2, 3, 4, 1, 5, 6, 7, 8, 5}),
             24);
  // One hole bridged to the other.
  expect_cut(face_of({{0, 0}, {8, 0}, {8, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {5, 1}, {5, 3}, {7, 3}, {7, 1}},
                     {1, 2, 3, 4, 1, 5, 6, 7, 8, 9, 10, 11, 12, 9, 8, 5}),
             24);
  // An L with a hole in its foot.
  expect_cut(face_of({{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}, {3, 0.5f}, {3, 1.5f}, {5, 1.5f}, {5, 0.5f}},
                     {1, 2, 3, 4, 5, 6, 1, 7, 8, 9, 10, 7}),
             18);
}

// Where two faces meet in a sharp corner of more than half a turn, as at a hole that was cut, the limit's tangents
// run along the two borders and their cross product points backwards.
TEST(CutPolygon, NormalsOfAFlatPanelAllPointOneWay) {
  const std::string corner = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4\nf 1 4 5 6\n";
  const std::string hole =
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nf 1 2 3 4 1 5 6 7 8 5\n";
  const auto expect = [](const std::string& text, int level) {
    const Mesh mesh = subdivide(parse_obj(text, "panel.obj"), level, 1);
    for (const Vec3& n : mesh.normals) ASSERT_GT(n.z, 0.999f) << level << "\n" << text;
  };
  for (const std::string& text : {hole, corner, corner + "t corner 1/1/0 3 10.0\n"})
    for (const int level : {0, 1, 2, 3}) expect(text, level);
}

TEST(CutPolygon, RoundHolesInARowWork) {
  std::vector<Vec2> points{{0, 0}, {20, 0}, {20, 2}, {0, 2}};
  std::vector<int> corners{1};
  double area = 40;
  for (int hole = 0; hole < 9; ++hole) {  // each bridged from the corner before
    const int first = int(points.size()) + 1, n = 16;
    for (int i = 0; i < n; ++i) {
      const float a = -2 * pi * float(i) / n + pi;
      points.push_back({2.0f * float(hole + 1) + 0.5f * std::cos(a), 1 + 0.5f * std::sin(a)});
    }
    area -= 0.5 * n * 0.25 * std::sin(2 * std::numbers::pi / n);
    const long place =
        hole == 0 ? 1 : long(std::find(corners.begin(), corners.end(), first - n / 2) - corners.begin()) + 1;
    std::vector<int> loop;
    for (int i = 0; i <= n; ++i) loop.push_back(first + i % n);
    loop.push_back(corners[size_t(place) - 1]);
    corners.insert(corners.begin() + place, loop.begin(), loop.end());
  }
  corners.insert(corners.end(), {2, 3, 4});
  expect_cut(face_of(points, corners), area);
}

TEST(CutPolygon, ABowTieInOneVertexIsTwoTriangles) {
  const ControlMesh cage = face_of({{0, 0}, {2, 0}, {2, 1}, {-2, 0}, {-2, -1}}, {1, 2, 3, 1, 4, 5});
  expect_cut(cage, 2);
  EXPECT_EQ(cage.face_sizes, (std::vector<int>{3, 3}));
}

TEST(CutPolygon, AHoleThatTouchesItsPanelInOneVertexStaysAHole) {
  expect_cut(face_of({{0, 0}, {6, 0}, {0, 6}, {1, 2}, {2, 1}}, {1, 2, 3, 1, 4, 5}), 18 - 1.5);
}

TEST(CutPolygon, SpikesAreDroppedAndWhatCrossesItselfToo) {
  const ControlMesh spike = face_of(frame, {1, 2, 3, 7, 3, 4});
  EXPECT_EQ(spike.face_sizes, (std::vector<int>{4}));
  EXPECT_EQ(spike.position_indices, (std::vector<int>{3, 0, 1, 2}));
  const ControlMesh crossing =
      parse_obj("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 9 1 0\nv -3 3 0\nf 1 2 3 4\nf 1 3 5 6 1 2 4 5\n", "x");
  ASSERT_EQ(crossing.warnings.size(), 1u);
  EXPECT_EQ(
      crossing.warnings[0],
      "x:8: 1 face meets a vertex twice and crosses itself, has no area or is too large to cut: it was dropped");
}

TEST(CutPolygon, HolesOfOpenSubdivFollowTheFacesOfTheFile) {
  const std::string text =
      "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 1 3 0\nv 3 3 0\nv 3 1 0\nv 8 0 0\nv 8 4 0\n"
      "f 1 2 3 4 1 5 6 7 8 5\nf 2 9 10 3\n";
  const ControlMesh panel = parse_obj(text + "t hole 1/0/0 0\n", "x"),
                    strip = parse_obj(text + "t hole 1/0/0 1\n", "x");
  const int pieces = int(panel.face_sizes.size()) - 1;
  EXPECT_EQ(int(panel.holes.size()), pieces);
  EXPECT_EQ(strip.holes, (std::vector<int>{pieces}));
}

}  // namespace
}  // namespace sateen
