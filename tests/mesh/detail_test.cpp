#include "mesh/detail.h"

#include <gtest/gtest.h>

#include "mesh/hems.h"
#include "mesh/mesh_checks.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

DetailView with_pixels_of(float size) {
  return {[size](const Vec3&) { return size; }, {}};
}
Vec2 plain(float x, float y) {
  return Vec2(x, y);
}

// The chords of a level have their middles among the vertices of the next: how far those are from the chords along
// their normals, of 99.9 % of the chords' length. For cages of quads alone, whose quads come row by row.
double true_distance(const ControlMesh& cage, int level) {
  const Mesh mesh = subdivide(cage, level), finer = subdivide(cage, level + 1);
  const size_t n = size_t(1) << level, per_face = n * n;
  std::vector<std::pair<double, double>> found;  // distance, length
  double all = 0;
  for (size_t q = 0; q < mesh.quads.size(); ++q) {
    const size_t face = q / per_face, j = q % per_face / n, i = q % n;
    const auto child = [&](size_t di, size_t dj) {
      return finer.quads[face * 4 * per_face + (2 * j + dj) * 2 * n + 2 * i + di];
    };
    const auto& c = mesh.quads[q];
    const std::uint32_t below = child(0, 0)[1], right = child(1, 0)[2], middle = child(0, 0)[2];
    const std::array<std::array<std::uint32_t, 3>, 3> chords{
        {{c[0], c[1], below}, {c[1], c[2], right}, {c[1], c[3], middle}}};
    for (const auto& [a, b, m] : chords) {
      const Vec3 off = finer.positions[m] - (mesh.positions[a] + mesh.positions[b]) * 0.5f;
      const double size = double(length(mesh.positions[a] - mesh.positions[b]));
      found.emplace_back(std::abs(double(dot(off, finer.normals[m]))), size);
      all += size;
    }
  }
  std::sort(found.rbegin(), found.rend());
  double above = 0;
  for (const auto& [distance, size] : found)
    if ((above += size) > 1e-3 * all) return distance;
  return 0;
}

TEST(Detail, OfASphereIsTheRiseOfItsArcsAtEveryLevel) {
  const ControlMesh cage = built_in_shape("sphere");
  const double coarse = double(measure_detail(subdivide(cage, 1), with_pixels_of(1)).off_pixels);
  for (int level = 1; level <= 3; ++level) {
    const double truth = true_distance(cage, level);
    const double measured = double(measure_detail(subdivide(cage, level), with_pixels_of(1)).off_pixels);
    EXPECT_GT(measured, 0.95 * truth) << level;
    EXPECT_LT(measured, 1.25 * truth) << level;
    // What the first level says of the others.
    EXPECT_NEAR(coarse / std::pow(4, level - 1), truth, 0.25 * truth) << level;
  }
}

TEST(Detail, OfTheDrapeIsForetoldByACoarseLevelAndNeverTooSmall) {
  const ControlMesh cage = built_in_shape("drape");
  const double truth = true_distance(cage, 2);
  const double measured = double(measure_detail(subdivide(cage, 2), with_pixels_of(1)).off_pixels);
  EXPECT_GT(measured, truth);
  EXPECT_LT(measured, 2.5 * truth) << "the larger end's curvature stands for an edge";
  const double foretold = double(measure_detail(subdivide(cage, 1), with_pixels_of(1)).off_pixels) / 4;
  EXPECT_GT(foretold, measured / 1.1);
  EXPECT_LT(foretold, 2 * measured);
}

TEST(Detail, TheLevelThatIsChosenHoldsAQuarterOfAPixelAndOneLessDoesNot) {
  for (const char* shape : {"sphere", "swatch", "drape"}) {
    const ControlMesh cage = built_in_shape(shape);
    for (const float pixel : {0.02f, 0.005f, 0.002f}) {
      const DetailedMesh made = subdivide_for_view(cage, with_pixels_of(pixel), 2'000'000);
      if (made.level < made.wanted || made.level > 3) continue;  // too large to compare with the next level
      const double off = true_distance(cage, made.level) / double(pixel);
      EXPECT_LE(off, double(most_off_pixels)) << shape << " " << pixel;
      if (made.level == 0) continue;
      const Detail less = measure_detail(subdivide(cage, made.level - 1), with_pixels_of(pixel));
      EXPECT_TRUE(less.off_pixels > 0.8f * most_off_pixels || less.normal_deg > 0.4f || less.rise_pixels > 0.08f)
          << shape << " " << pixel << ": " << less.off_pixels << " " << less.normal_deg << " " << less.rise_pixels;
    }
  }
}

TEST(Detail, AFlatSheetWithARoundHemIsRefinedForItsHem) {
  ControlMesh cage;
  constexpr int corners = 8;
  for (int k = 0; k < corners; ++k) {
    const float angle = 2 * pi * float(k) / corners;
    cage.positions.push_back(Vec3(std::cos(angle), std::sin(angle), 0));
    cage.position_indices.push_back(k);
  }
  cage.face_sizes = {corners};
  cage.boundary = ControlMesh::Boundary::edge_only;
  for (int level = 1; level <= 3; ++level) {
    const Mesh mesh = subdivide(cage, level);
    const std::vector<HemEdge> hems = hem_edges(mesh);
    ASSERT_EQ(hems.size(), size_t(corners << level));
    // A uniform cubic spline around eight points is all but a circle.
    const double radius = double(mesh.positions[hems[0].a].length());
    const double rise = radius * (1 - std::cos(double(pi) / double(hems.size())));
    const double off = double(measure_detail(mesh, with_pixels_of(1)).off_pixels);
    EXPECT_GT(off, rise) << level;
    EXPECT_LT(off, 1.4 * rise) << level;
  }
  EXPECT_EQ(subdivide_for_view(cage, with_pixels_of(1), 1000).level, 0);
  EXPECT_GE(subdivide_for_view(cage, with_pixels_of(0.001f), 100'000).level, 3);
}

TEST(Detail, AStraightSheetHasHemsAndSeamsButNoDetail) {
  const ControlMesh cage = grid_cage(
      5, 4, [](float x, float y) { return Vec3(x, y, 0.3f * x); }, plain);
  const Mesh mesh = subdivide(cage, 1);
  EXPECT_EQ(hem_edges(mesh).size(), 2u * 2 * (5 + 4));
  const Detail detail = measure_detail(mesh, with_pixels_of(0.001f));
  EXPECT_LT(detail.off_pixels, 1e-3f);
  EXPECT_EQ(subdivide_for_view(cage, with_pixels_of(0.001f), 1'000'000).level, 0);
}

TEST(Detail, ABumpThatIsSeenFromAboveNeedsLessThanOneSeenFromTheSide) {
  const auto bump = [](float x, float y) {
    return Vec3(x, 0.5f * std::exp(-0.2f * ((x - 5) * (x - 5) + (y - 5) * (y - 5))), y);
  };
  const Mesh mesh = subdivide(grid_cage(10, 10, bump, plain), 2);
  DetailView view = with_pixels_of(0.01f);
  const float all = measure_detail(mesh, view).off_pixels;
  view.eye = Vec3(5, 1000, 5);
  const float above = measure_detail(mesh, view).off_pixels;
  view.eye = Vec3(5, 0.2f, 1000);
  const float side = measure_detail(mesh, view).off_pixels;
  EXPECT_LT(above, 0.6f * side);
  EXPECT_NEAR(side, all, 0.15f * all);
}

TEST(Detail, WhatIsNotSeenCountsForNothing) {
  const ControlMesh cage = built_in_shape("sphere");
  for (const float size : {0.0f, -1.0f, NAN, INFINITY}) {
    const DetailedMesh made = subdivide_for_view(cage, with_pixels_of(size), 1'000'000);
    EXPECT_EQ(made.level, 0) << size;
    EXPECT_EQ(measure_detail(made.mesh, with_pixels_of(size)).off_pixels, 0) << size;
  }
}

TEST(Detail, MemoryIsKeptAndWhatWasWantedIsSaid) {
  const ControlMesh cage = built_in_shape("sphere");
  const DetailedMesh made = subdivide_for_view(cage, with_pixels_of(1e-6f), 10'000);
  EXPECT_EQ(made.level, 2) << "384 * 16 quads fit, four times as many do not";
  EXPECT_EQ(made.wanted, finest_level);
  EXPECT_EQ(subdivide_for_view(cage, with_pixels_of(1e-6f), 1).level, 0);
}

TEST(Detail, CagesWithoutCurvatureToMeasureHaveTheirOwnLevel) {
  ControlMesh cage = built_in_shape("sphere");
  cage.scheme = ControlMesh::Scheme::bilinear;
  EXPECT_EQ(subdivide_for_view(cage, with_pixels_of(1e-4f), 1'000'000).level, 1);
  cage.scheme = ControlMesh::Scheme::loop;  // of quads: refused
  const DetailedMesh made = subdivide_for_view(cage, with_pixels_of(1e-4f), 1'000'000);
  EXPECT_FALSE(made.mesh.refined);
  EXPECT_EQ(made.level, 0);
}

TEST(Detail, IsTheSameForAnyNumberOfThreads) {
  const Mesh mesh = subdivide(built_in_shape("drape"), 1);
  const Detail one = measure_detail(mesh, with_pixels_of(0.001f), 1),
               three = measure_detail(mesh, with_pixels_of(0.001f), 3);
  EXPECT_EQ(one.off_pixels, three.off_pixels);
  EXPECT_EQ(one.missing_levels, three.missing_levels);
  EXPECT_EQ(one.normal_deg, three.normal_deg);
}

}  // namespace
}  // namespace sateen
