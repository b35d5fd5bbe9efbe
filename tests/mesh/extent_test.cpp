#include "mesh/extent.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "mesh/obj.h"
#include "mesh/placement.h"
#include "mesh/subdivide.h"

namespace sateen {
namespace {

/// What check_extent tells of an OBJ as it is rendered, or refuses it with, in one text.
std::string told_of(const std::string& text, int level = 1) {
  ControlMesh cage = parse_obj(text, "a.obj");
  settle_placement(cage);
  std::string all;
  try {
    for (const std::string& told : check_extent(cage, subdivide(cage, level))) all += told + "\n";
  } catch (const InputError& e) {
    return e.what();
  }
  return all;
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

std::string square_at(double x) {
  const std::string left = fmt::format("{:.17g}", x), right = fmt::format("{:.17g}", x + 1);
  return "v " + left + " 0 0\nv " + right + " 0 0\nv " + right + " 1 0\nv " + left + " 1 0\nf -4 -3 -2 -1\n";
}

TEST(Extent, AMeshWithoutAreaIsRefusedWithItsFacesAndTheReasonAtEveryLevel) {
  for (int level = 0; level <= 2; ++level) {
    EXPECT_EQ(told_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\nf 1 2 3\n", level),
              "error: a.obj: none of its 2 faces has an area: nothing of it can be seen\n"
              "  help: the corners of each lie on one line; export it anew");
    EXPECT_EQ(told_of("v 7 7 7\nv 7 7 7\nv 7 7 7\nf 1 2 3\n", level),
              "error: a.obj: its only face has no area: nothing of it can be seen\n"
              "  help: all corners lie in one point; export it anew");
  }
}

TEST(Extent, FacesThatAreLostBesideTheirDistanceAreNotCalledPointsOrLines) {
  const std::string reason =
      "across, is lost: nothing of it can be seen\n  help: parts that lie so far apart need files of their own";
  for (const std::string& text : {square + square_at(1e14), square_at(-5e13) + square_at(5e13)}) {
    const std::string told = told_of(text);
    EXPECT_EQ(told.find("error: a.obj: it spans 1e+14 units, beside which the largest of "
                        "its 2 faces, "),
              0u)
        << told;
    EXPECT_NE(told.find(reason), std::string::npos) << told;
  }
  EXPECT_NE(told_of(square + square_at(1e14)).find("faces, 1.41 across, is lost"), std::string::npos);
  // Nearer it is rendered, and what is rounded is told.
  EXPECT_EQ(told_of(square + square_at(1e6))
                .find("it spans 1e+06 units, beside which floats have no more than 24 steps "
                      "across the largest of its 2 faces; parts"),
            0u)
      << told_of(square + square_at(1e6));
}

TEST(Extent, NothingIsToldOfAMeshThatLosesNothing) {
  EXPECT_EQ(told_of(square), "");
  EXPECT_EQ(told_of(square + square_at(1e4)), "");
  EXPECT_EQ(told_of(square_at(500)), "");
  EXPECT_EQ(told_of(square_at(1e6)).find("it lies 7.1e+05 times its own size from the origin"), 0u);
}

}  // namespace
}  // namespace sateen
