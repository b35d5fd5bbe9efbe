#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <filesystem>

#include "mesh/mesh_checks.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"
#include "mesh/torture_meshes.h"

namespace sateen {
namespace {

/// Two panels of 1 by 3 quads side by side, the right one moved by `gap`; in all parts `scale` times as large.
ControlMesh panels(double gap, double scale = 1) {
  std::string text;
  for (int panel = 0; panel < 2; ++panel)
    for (int j = 0; j <= 3; ++j)
      for (int i = 0; i <= 1; ++i)
        text += fmt::format("v {} {} {}\nvt {} {}\n", scale * (panel + i + panel * gap), scale * j, scale * i * panel,
                            i, j / 3.0);
  for (int panel = 0; panel < 2; ++panel)
    for (int j = 0; j < 3; ++j) {
      const int v = 8 * panel + 2 * j + 1;
      text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", v, v + 1, v + 3, v + 2);
    }
  return parse_obj(text, "panels.obj");
}

TEST(Weld, SewnPiecesAreFoundAndJoinedAtAnySize) {
  for (const double scale : {1e-14, 1.0, 1e12}) {
    ControlMesh cage = panels(0, scale);
    EXPECT_EQ(touching_text(touching_borders(cage)).rfind("its 2 pieces touch along 3 edges but are not joined: ", 0),
              0u);
    const Touching welded = weld_borders(cage);
    EXPECT_EQ(welded.edges, 3);
    EXPECT_EQ(welded.vertices, 4);
    EXPECT_EQ(cage.positions.size(), 12u);
    EXPECT_EQ(touching_borders(cage).edges, 0);
    expect_sound(subdivide(cage, 2));
  }
}

TEST(Weld, AGapOfAThousandthOfAnEdgeIsClosedAndAWiderOneIsNot) {
  EXPECT_EQ(touching_borders(panels(0.0009)).edges, 3);
  EXPECT_EQ(touching_borders(panels(0.0011)).edges, 0);
  EXPECT_EQ(touching_text(touching_borders(panels(0.0011))), "");
}

TEST(Weld, ASeamOfTextureCoordinatesRemains) {
  ControlMesh cage = panels(0);
  const std::vector<int> uvs = cage.uv_indices;
  weld_borders(cage);
  EXPECT_EQ(cage.uv_indices, uvs);
  const Mesh mesh = subdivide(cage, 1);
  EXPECT_EQ(mesh.fallback_warps, 0);
  // The surface is smooth over the seam: the normals on both sides of it are the same.
  int seam = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    for (size_t j = i + 1; j < mesh.positions.size(); ++j)
      if (mesh.positions[i] == mesh.positions[j]) {
        ++seam;
        EXPECT_NEAR((mesh.normals[i] - mesh.normals[j]).length(), 0, 1e-5);
      }
  EXPECT_EQ(seam, 7);
}

TEST(Weld, ATubeThatTouchesItselfIsOnePiece) {
  std::string text;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i <= 6; ++i) {
      const double a = 2 * std::numbers::pi * (i % 6) / 6;
      text += fmt::format("v {} {} {}\n", std::cos(a), j, std::sin(a));
    }
  for (int i = 0; i < 6; ++i) text += fmt::format("f {} {} {} {}\n", i + 1, i + 2, i + 9, i + 8);
  EXPECT_EQ(touching_text(touching_borders(parse_obj(text, "tube")))
                .rfind("its borders touch along 1 edge but are not joined", 0),
            0u);
}

TEST(Weld, LayersThatLieOnOneAnotherStayApart) {
  // Shell and lining of two panels: four borders in one place belong together in more than one way.
  ControlMesh cage = panels(0);
  const ControlMesh other = panels(0);
  const int vertices = int(cage.positions.size()), uvs = int(cage.uvs.size());
  cage.positions.insert(cage.positions.end(), other.positions.begin(), other.positions.end());
  cage.uvs.insert(cage.uvs.end(), other.uvs.begin(), other.uvs.end());
  cage.face_sizes.insert(cage.face_sizes.end(), other.face_sizes.begin(), other.face_sizes.end());
  for (size_t i = 0; i < other.position_indices.size(); ++i) {
    cage.position_indices.push_back(other.position_indices[i] + vertices);
    cage.uv_indices.push_back(other.uv_indices[i] + uvs);
  }
  EXPECT_EQ(touching_borders(cage).edges, 0);
}

TEST(Weld, NoFaceCollapsesWhateverIsWelded) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    ControlMesh cage = parse_obj(torture::random_mesh(i), "random");
    // Vertices that lie on one another by the dozen.
    for (Vec3& p : cage.positions)
      for (int k = 0; k < 3; ++k) p[k] = std::floor(p[k] * 3);
    weld_borders(cage);
    SCOPED_TRACE(i);
    expect_sound(subdivide(cage, 1));
  }
}

TEST(Weld, TheSharedSeamBecomesTheMeshThatWasWeldedOnExport) {
  const std::filesystem::path folder = SATEEN_SOURCE_DIR "/../shared/cases/12-unwelded";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "../shared/cases is not there";
  ControlMesh cage = read_obj(folder / "unwelded.obj");
  weld_borders(cage);
  const Mesh mesh = subdivide(cage, 2), expected = subdivide(read_obj(folder / "welded.obj"), 2);
  EXPECT_EQ(mesh.positions, expected.positions);
  EXPECT_EQ(mesh.normals, expected.normals);
  EXPECT_EQ(mesh.dpdu, expected.dpdu);
  EXPECT_EQ(mesh.quads, expected.quads);
}

}  // namespace
}  // namespace sateen
