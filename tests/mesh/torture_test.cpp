// The list of hard-cases.md, "Meshes": each must come out as a sound mesh or as an error with a text, at every level.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <random>

#include "base/error.h"
#include "mesh/mesh_checks.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

std::string polygon(int corners, float radius, float z) {
  std::string text;
  for (int i = 0; i < corners; ++i) {
    const float a = 2 * pi * float(i) / float(corners);
    text += fmt::format("v {} {} {}\n", radius * std::cos(a), radius * std::sin(a), z);
  }
  return text;
}

std::string numbered_face(int first, int count) {
  std::string text = "f";
  for (int i = 0; i < count; ++i) text += fmt::format(" {}", first + i);
  return text + "\n";
}

std::string pole(int valence) {
  std::string text = "v 0 0 0.3\n" + polygon(valence, 1, 0);
  for (int i = 0; i < valence; ++i) text += fmt::format("f 1 {} {}\n", i + 2, (i + 1) % valence + 2);
  return text;
}

std::string moebius(int pieces) {
  std::string text;
  for (int i = 0; i < pieces; ++i) {
    const float a = 2 * pi * float(i) / float(pieces);
    for (const float side : {-0.3f, 0.3f}) {
      const float r = 1 + side * std::cos(a / 2);
      text += fmt::format("v {} {} {}\n", r * std::cos(a), r * std::sin(a), side * std::sin(a / 2));
    }
  }
  for (int i = 0; i + 1 < pieces; ++i)
    text += fmt::format("f {} {} {} {}\n", 2 * i + 1, 2 * i + 3, 2 * i + 4, 2 * i + 2);
  return text + fmt::format("f {} 2 1 {}\n", 2 * pieces - 1, 2 * pieces);
}

/// A bent sheet of 4 by 4 quads with UVs: v -> v * scale + offset, uv by `chart`.
template <class Chart>
std::string sheet(double scale, double offset, const Chart& chart) {
  std::string text;
  for (int i = 0; i < 25; ++i) {
    const double x = i % 5, y = i / 5;
    text += fmt::format("v {} {} {}\n", x * scale + offset, y * scale + offset, std::sin(x) * scale + offset);
    text += fmt::format("vt {}\n", chart(x, y));
  }
  for (int i = 0; i < 16; ++i) {
    const int v = i / 4 * 5 + i % 4 + 1;
    text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", v, v + 1, v + 6, v + 5);
  }
  return text;
}
std::string plain(double x, double y) {
  return fmt::format("{} {}", x / 4, y / 4);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string cube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

struct Case {
  std::string name, text;
  bool refused_by_opensubdiv = false;
};

std::vector<Case> cases() {
  std::string random_soup;
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i)
    random_soup +=
        fmt::format("v {} {} {}\n", double(random()) / 4e9, double(random()) / 4e9, double(random()) / 4e9);
  for (int i = 0; i < 200; ++i)
    random_soup +=
        fmt::format("f {} {} {} {}\n", random() % 60 + 1, random() % 60 + 1, random() % 60 + 1, random() % 60 + 1);
  return {
      {"one triangle", square + "f 1 2 3\n"},
      {"one quad", square + "f 1 2 3 4\n"},
      {"zero area, all in one point", "v 1 1 1\nv 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3 4\n"},
      {"zero area, all on a line", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\nf 1 2 3\n"},
      {"sliver of 1e-20", "v 0 0 0\nv 1 0 0\nv 0.5 1e-20 0\nf 1 2 3\n"},
      {"tiny triangle of 1e-20", "v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nf 1 2 3\n"},
      {"tiny triangle beside a large one", "v 0 0 0\nv 1e-20 0 0\nv 0 1e-20 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\nf 1 4 5\n"},
      {"duplicate faces", square + "f 1 2 3 4\nf 1 2 3 4\nf 2 3 4 1\n"},
      {"coplanar overlapping faces", square + "v 0.5 0.5 0\nv 2 0.5 0\nv 2 2 0\nf 1 2 3 4\nf 5 6 7\n"},
      {"equal UVs", sheet(1, 0, [](double, double) { return "0.5 0.5"; })},
      {"zero UVs", sheet(1, 0, [](double, double) { return "0 0"; })},
      {"UVs on a line", sheet(1, 0, [](double x, double) { return fmt::format("{} 0", x); })},
      {"UVs that are not numbers", sheet(1, 0, [](double x, double y) { return x == 2 ? "nan inf" : plain(x, y); })},
      {"huge UVs", sheet(1, 0, [](double x, double y) { return fmt::format("{} {}", x * 1e14, y * 1e14); })},
      {"UVs far from the origin", sheet(1, 0, [](double x, double y) { return fmt::format("{} {}", x + 1e5, y); })},
      {"no UVs", cube},
      {"mirrored UVs", sheet(1, 0, [](double x, double y) { return fmt::format("{} {}", std::abs(x - 2), y); })},
      {"flipped faces", square + "v 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 3 6 5\n"},
      {"non-manifold fan", "v 0 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv -1 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n"},
      {"bow-tie vertex", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3\nf 1 4 5\n"},
      {"bow-tie quad", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n"},
      {"T-junction", square + "v 1 0.5 0\nv 2 0 0\nv 2 0.5 0\nv 2 1 0\nf 1 2 3 4\nf 2 6 7 5\nf 5 7 8 3\n"},
      {"unwelded seam", square + "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4\nf 5 6 7 8\n"},
      {"edge of zero length", "v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n"},
      {"n-gon of 1,000", polygon(1000, 1, 0) + numbered_face(1, 1000)},
      {"n-gon of 5,000", polygon(5000, 1, 0) + numbered_face(1, 5000)},
      {"concave", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n"},
      {"pole of valence 360", pole(360)},
      {"pole of valence 3,000", pole(3000)},
      {"n-gon of 70,000", polygon(70000, 1, 0) + numbered_face(1, 70000), true},
      {"two faces around a vertex", square + "v 2 0 1\nv 2 1 1\nf 1 2 3 4\nf 2 1 5 6 3\nt crease 2/1/0 1 2 3.5\n"},
      {"two faces around a vertex with a dart",
       square + "v 2 0 1\nv 2 1 1\nf 1 2 3 4\nf 2 1 5 6 3\nt crease 2/1/0 1 2 10\n"},
      {"pillow", square + "f 1 2 3 4\nf 4 3 2 1\n"},
      {"isolated vertices", square + "v 5e14 0 0\nv 7 7 7\nf 1 2 3 4\n"},
      {"Moebius strip", moebius(12)},
      {"1e-6 in size", sheet(1e-6, 0, plain)},
      {"1e6 in size", sheet(1e6, 0, plain)},
      {"1e-30 in size", sheet(1e-30, 0, plain)},
      {"2e14 in size", sheet(2e14, 0, plain)},
      {"1e6 from the origin", sheet(1, 1e6, plain)},
      {"1e9 from the origin, collapsed by rounding", sheet(1, 1e9, plain)},
      {"all kinds of creases", cube + "t crease 4/2/0 0 1 1 2 10 0.5\nt corner 2/2/0 0 6 10 1.5\n"},
      {"every edge sharp", cube + "t crease 24/1/0 0 1 1 2 2 3 3 0 4 5 5 6 6 7 7 4 0 4 1 5 2 6 3 7 10\n"},
      {"a crease where no edge is", cube + "t crease 2/1/0 0 6 10\n"},
      {"holes", cube + "t hole 2/0/0 0 1\n"},
      {"nothing but holes", square + "f 1 2 3 4\nt hole 1/0/0 0\n"},
      {"no boundary interpolation, nothing left", square + "f 1 2 3 4\nt interpolateboundary 1/0/0 0\n"},
      {"soup", random_soup},
  };
}

TEST(TortureMeshes, ComeOutSoundAtEveryLevel) {
  for (const Case& c : cases()) {
    const ControlMesh cage = parse_obj(c.text, "torture.obj");
    for (int level = 0; level <= 3; ++level) {
      if (level > 0 && cage.position_indices.size() > 500 && level != 2) continue;
      SCOPED_TRACE(fmt::format("{}, level {}", c.name, level));
      const Mesh mesh = subdivide(cage, level);
      expect_sound(mesh);
      const bool unrefined = !mesh.warnings.empty() && mesh.warnings.back().find("unrefined") != std::string::npos;
      if (c.refused_by_opensubdiv) {
        EXPECT_TRUE(unrefined);
      }
    }
  }
}

TEST(TortureMeshes, LoopOfAnythingButTrianglesIsRenderedFromItsCageWithAWarning) {
  ControlMesh cage = parse_obj(cube, "cube");
  cage.scheme = ControlMesh::Scheme::loop;
  const Mesh mesh = subdivide(cage, 2);
  expect_sound(mesh);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  EXPECT_NE(mesh.warnings[0].find("cube: OpenSubdiv refuses this mesh, rendered unrefined from its cage: "),
            std::string::npos)
      << mesh.warnings[0];
  EXPECT_EQ(mesh.quads.size(), 6u);
}

TEST(TortureMeshes, EverySchemeTakesEveryCage) {
  for (const Case& c : cases())
    for (const ControlMesh::Scheme scheme : {ControlMesh::Scheme::loop, ControlMesh::Scheme::bilinear}) {
      SCOPED_TRACE(c.name);
      ControlMesh cage = parse_obj(c.text, "torture.obj");
      cage.scheme = scheme;
      expect_sound(subdivide(cage, 1));
    }
}

TEST(TortureMeshes, SizeAndDistanceFromTheOriginDoNotChangeTheShape) {
  const Mesh unit = subdivide(parse_obj(sheet(1, 0, plain), "unit"), 2);
  for (const double scale : {1e-30, 1e-6, 1e6, 1e14}) {
    const Mesh other = subdivide(parse_obj(sheet(scale, 0, plain), "other"), 2);
    for (size_t i = 0; i < unit.positions.size(); ++i) {
      EXPECT_NEAR((other.normals[i] - unit.normals[i]).length(), 0, 1e-5);
      EXPECT_NEAR((other.dpdu[i] / float(scale) - unit.dpdu[i]).length(), 0, 1e-4);
    }
  }
  // 1e3 sizes away a float still holds 1/16,000 of the shape.
  const Mesh away = subdivide(parse_obj(sheet(1, 1000, plain), "away"), 2);
  for (size_t i = 0; i < unit.positions.size(); ++i)
    EXPECT_NEAR((away.normals[i] - unit.normals[i]).length(), 0, 2e-3);
}

TEST(TortureMeshes, AFullPoleIsSmooth) {
  const Mesh mesh = subdivide(parse_obj(pole(360), "pole"), 2);
  size_t apex = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].z > mesh.positions[apex].z) apex = i;
  EXPECT_NEAR(mesh.normals[apex].z, 1, 1e-4);
}

TEST(TortureMeshes, TenMillionTrianglesWork) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "takes 4 GB and a minute; set SATEEN_LONG_TESTS";
  const auto wave = [](float x, float y) { return Vec3(x, y, std::sin(x) * std::cos(y)); };
  const auto chart = [](float x, float y) { return Vec2(x, y); };
  for (const auto& [cells, level] : {std::pair(560, 2), std::pair(2240, 0)}) {
    const Mesh mesh = subdivide(grid_cage(cells, cells, wave, chart), level);
    EXPECT_GE(mesh.triangles(), 10'000'000);
    expect_sound(mesh);
  }
}

}  // namespace
}  // namespace sateen
