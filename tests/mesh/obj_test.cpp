#include "mesh/obj.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"

namespace sateen {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string error_of(const std::string& text) {
  try {
    parse_obj(text, "a.obj");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(Obj, KeepsFacesOfAnySizeAndTheirSeparateUvIndices) {
  const ControlMesh m =
      parse_obj(square + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nf 4/3/9 3/2/9 2/1/9 1/1/9\n", "a.obj");
  EXPECT_EQ(m.face_sizes, (std::vector<int>{3, 4}));
  EXPECT_EQ(m.position_indices, (std::vector<int>{0, 1, 2, 3, 2, 1, 0}));
  EXPECT_EQ(m.uv_indices, (std::vector<int>{0, 1, 2, 2, 1, 0, 0}));
  EXPECT_EQ(m.positions[2], Vec3(1, 1, 0));
  EXPECT_EQ(m.uvs.size(), 3u);
  EXPECT_EQ(m.name, "a.obj");
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Obj, ReadsNormalsColoursAndWeightsWithoutUsingThem) {
  const ControlMesh m = parse_obj(
      "v 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nvn 0 0 1\nvt 0.5\nvt 0 0 7\nvt 1 0\nf 1//1 2//1 3//1\n", "a");
  EXPECT_EQ(m.position_indices, (std::vector<int>{0, 1, 2}));
  EXPECT_TRUE(m.uv_indices.empty());
  EXPECT_TRUE(m.uvs.empty());
}

TEST(Obj, CountsNegativeIndicesFromWhatWasReadLast) {
  const ControlMesh m = parse_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 2 0 0\nf -1 -2 -3\n", "a.obj");
  EXPECT_EQ(m.position_indices, (std::vector<int>{0, 1, 2, 3, 2, 1}));
}

TEST(Obj, TakesWindowsLinesByteOrderMarksCommentsAndContinuedLines) {
  const ControlMesh m = parse_obj(
      "\xEF\xBB\xBFv 0 0 0 # origin\r\nv 1 0 \\\r\n  0\r\n\r\n# f 9 9 9\r\n\tv +1 1.0e0 0\r\nf 1 2 \\\r\n3\r\n", "a");
  EXPECT_EQ(m.positions.size(), 3u);
  EXPECT_EQ(m.positions[2], Vec3(1, 1, 0));
  EXPECT_EQ(m.position_indices, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(parse_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3", "a").face_sizes.size(), 1u) << "no newline at the end";
}

TEST(Obj, ACommentEndsWithItsLineThoughThatEndsInABackslash) {
  const ControlMesh m =
      parse_obj("# from C:\\cloth\\\nv 0 0 0\nv 1 0 0 # right \\\nv 1 1 0\nf 1 2 \\\n 3 # C:\\\nf 3 2 1\n", "a");
  EXPECT_EQ(m.positions.size(), 3u);
  EXPECT_EQ(m.face_sizes.size(), 2u);
}

TEST(Obj, TakesFacesThatComeBeforeTheirVertices) {
  EXPECT_EQ(parse_obj("f 1 2 3\n" + square, "a").face_sizes.size(), 1u);
  EXPECT_EQ(error_of("f 1 2 5\n" + square),
            "a.obj:1:7: error: vertex index is 5, expected 1 to 4\n    1 | f 1 2 5\n      |       ^");
}

TEST(Obj, RefusesAnIndexOutOfRangeWithItsPlace) {
  EXPECT_EQ(error_of(square + "f 1 2 99\n"),
            "a.obj:5:7: error: vertex index is 99, expected 1 to 4\n    5 | f 1 2 99\n      |       ^^");
  EXPECT_EQ(error_of(square + "f 1 -5 3\n"),
            "a.obj:5:5: error: vertex index is -5, expected -1 to -4\n    5 | f 1 -5 3\n      |     ^^");
  EXPECT_EQ(
      error_of(square + "vt 0 0\nf 1/1 2/2 3/1\n"),
      "a.obj:6:9: error: texture coordinate index is 2, expected 1 to 1\n    6 | f 1/1 2/2 3/1\n      |         ^");
  EXPECT_EQ(error_of(square + "f 1/1 2/1 3/1\n").substr(0, 85),
            "a.obj:5:5: error: texture coordinate index is 1, but the file holds none\n    5 | f 1/");
}

TEST(Obj, RefusesTheIndexZeroWithHelp) {
  EXPECT_EQ(
      error_of(square + "f 0 1 2\n"),
      "a.obj:5:3: error: vertex index is 0, expected 1 or more, or a negative one\n    5 | f 0 1 2\n      |   ^\n"
      "  help: OBJ counts from 1; -1 is the one read last");
}

TEST(Obj, RefusesNumbersThatAreNotFiniteOrTooLarge) {
  for (const std::string word : {"nan", "inf", "-inf", "1e999", "1e15", "-2e30"})
    EXPECT_EQ(error_of(fmt::format("v 0 {} 0\n", word)),
              fmt::format("a.obj:1:5: error: y is {0}, expected a finite number below 1e15\n    1 | v 0 {0} 0\n"
                          "      |     {1}",
                          word, std::string(word.size(), '^')));
  EXPECT_EQ(error_of("v 0 1,5 0\n"),
            "a.obj:1:5: error: y is '1,5', expected a number\n    1 | v 0 1,5 0\n      |     ^^^");
  EXPECT_EQ(error_of("v 0 1\n"), "a.obj:1:6: error: z is missing, expected a number\n    1 | v 0 1\n      |      ^");
}

TEST(Obj, TakesNumbersTooSmallForAFloatAsZero) {
  const ControlMesh m = parse_obj("v 1e-60 -1e-400 9.9e14\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "a");
  EXPECT_EQ(m.positions[0], Vec3(0, 0, 9.9e14f));
}

TEST(Obj, RefusesFacesOfFewerThanThreeCorners) {
  EXPECT_EQ(error_of(square + "f 1 2\n"),
            "a.obj:5:3: error: face has 2 corners, expected at least 3\n    5 | f 1 2\n      |   ^^^");
  EXPECT_EQ(error_of(square + "f\n"),
            "a.obj:5:2: error: face has 0 corners, expected at least 3\n    5 | f\n      |  ^");
}

TEST(Obj, RefusesAFileWithoutFaces) {
  const std::string none =
      "error: a.obj: holds no face, expected at least one\n"
      "  help: meshes are OBJ text with lines such as f 1 2 3: export it as one";
  EXPECT_EQ(error_of(""), none);
  EXPECT_EQ(
      error_of(square + "f 1 1 2\n"),
      "error: a.obj:5: no face is left: its only one meets a vertex twice and crosses itself, has no area or is "
      "too large to cut\n  help: name each vertex of a face once, in the order around it");
  EXPECT_NE(error_of(square + "\nf 1 1 2\nf 1 2 1 2\n").find("a.obj:6: no face is left: all 2 meet a vertex twice"),
            std::string::npos);
}

TEST(Obj, SaysWhatAFileWithoutFacesHolds) {
  const auto expect_told = [](const std::string& text, const std::string& what) {
    EXPECT_NE(error_of(text).find(what), std::string::npos) << error_of(text);
  };
  expect_told(square, "a.obj: holds no face, expected at least one; it holds 4 vertices\n  help: points alone");
  expect_told(square + "cstype bezier\nsurf 0 1 0 1 1 2 4 3\nparm u 0 1\nend\nl 1 2\n",
              "a.obj:6:1: error: holds no face, expected at least one; it holds 1 free-form surface, 1 line\n"
              "    6 | surf 0 1 0 1 1 2 4 3\n      | ^^^^\n  help: export it as polygons");
  expect_told(square + "curv 0 1 1 2 3 4\ncurv 0 1 1 2\n",
              "a.obj:5:1: error: holds no face, expected at least one; "
              "it holds 2 free-form curves");
  expect_told(square + "l 1 2 3 4\n", "it holds 1 line");
  expect_told(square + "l 1 2 3 4\n", "help: export its faces, not its edges alone");
  expect_told(square + "p 1 2 3\np 4\np 1 2\n", "it holds 6 points");
  expect_told("call other.obj\n",
              "a.obj:1:1: error: holds no face, expected at least one; it calls other.obj, which is "
              "not read");
}

TEST(Obj, TellsWhatIsMissingBesideItsFaces) {
  const auto warning = [](const std::string& lines) {
    const ControlMesh m = parse_obj(lines + square + "f 1 2 3 4\n", "a.obj");
    EXPECT_EQ(m.warnings.size(), 1u) << lines;
    return m.warnings.empty() ? "" : m.warnings[0];
  };
  EXPECT_EQ(warning("\ncall \x1b[31mother.obj\n"),
            "a.obj:2: it calls \\x1b[31mother.obj, which is not followed: what is in there is missing");
  EXPECT_EQ(warning("call b.obj\ncall c.obj\n"),
            "a.obj:1: it calls 2 files, b.obj the first, which are not followed: what is in there is missing");
  EXPECT_EQ(warning("csh -date\n"), "a.obj:1: 1 csh command is not run");
  EXPECT_EQ(warning("surf 0 1 0 1 1 2 4 3\n"),
            "a.obj:1: 1 free-form surface is passed over and missing: export it as polygons");
  EXPECT_EQ(warning("curv 0 1 1 2\ncurv 0 1 2 3\n"), "a.obj:1: 2 free-form curves are passed over");
  // Nothing of the cloth is missing without these.
  EXPECT_TRUE(parse_obj(square + "l 1 2\np 3\ns 1\nvn 0 0 1\nmtllib a.mtl\nf 1 2 3 4\n", "a").warnings.empty());
}

TEST(Obj, RefusesIndicesBelowTheFirstHoweverSmall) {
  for (const std::string index :
       {"-9223372036854775808", "-9223372036854775807", "-4294967297", "-2147483649", "-5"}) {
    EXPECT_EQ(error_of(square + "f 1 2 " + index + "\n")
                  .find("a.obj:5:7: error: vertex index is " + index + ", expected -1 to -4\n"),
              0u)
        << index;
    EXPECT_EQ(error_of(square + "vt 0 0\nf 1/1 2/1 3/" + index + "\n")
                  .find("a.obj:6:13: error: texture coordinate index is " + index + ", expected -1 to -1\n"),
              0u)
        << index;
  }
  EXPECT_NE(error_of(square + "f 1 2 -9223372036854775809\n").find("vertex index is '-9223372036854775809'"),
            std::string::npos);
  EXPECT_NE(error_of(square + "f 1 2 9223372036854775807\n").find("expected at most 2147483647"), std::string::npos);
  // Vertices that come later are no vertices before.
  EXPECT_EQ(error_of(square + "f 1 2 3 -9223372036854775808\nv 5 5 5\n").find("a.obj:5:9: error: vertex index is "),
            0u);
  EXPECT_EQ(error_of("f -1 -2 -3\n" + square)
                .find("a.obj:1:3: error: vertex index is -1, but no vertex stands before "
                      "it\n"),
            0u);
  EXPECT_EQ(
      error_of(square + "f 1/-1 2/-1 3/-1\nvt 0 0\n")
          .find("a.obj:5:5: error: texture coordinate index is -1, but no texture coordinate stands before it\n"),
      0u);
  for (const std::string tag : {"crease 2/1/0 0 ", "corner 1/1/0 ", "hole 1/0/0 ", "interpolateboundary 1/0/0 "})
    for (const std::string index : {"-9223372036854775808", "9223372036854775807"})
      EXPECT_EQ(error_of(square + "f 1 2 3 4\nt " + tag + index + " 1\n").find("a.obj:6:"), 0u) << tag << index;
}

TEST(Obj, TakesMicrosoftsWordsForNoNumberAsSuch) {
  for (const std::string word :
       {"-1.#IND00", "1.#IND", "1.#QNAN", "-1.#QNAN0", "1.#SNAN", "1.#INF", "-1.#INF00", "1.#J"}) {
    EXPECT_EQ(error_of("v 0 0 0\nv 1 0 " + word + "\nv 1 1 0\nf 1 2 3\n")
                  .find("a.obj:2:7: error: z is " + word + ", expected a finite number below 1e15\n"),
              0u)
        << word;
    const ControlMesh m = parse_obj(square + "vt 0 0\nvt 1 " + word + "\nf 1/1 2/2 3/1\n", "a.obj");
    ASSERT_EQ(m.warnings.size(), 1u) << word;
    EXPECT_EQ(m.warnings[0].find("a.obj:6: 1 texture coordinate is not finite"), 0u) << m.warnings[0];
  }
  EXPECT_NE(error_of("v 0 0 1#x\n").find("z is '1#x', expected a number"), std::string::npos);
  // A comment begins with a word, and a # inside one belongs to it.
  const ControlMesh m = parse_obj(square + "usemtl a#1\nf 1 2 3 #4\nusemtl a#2\n\tf 1 3 4\n#f 1\n", "a.obj");
  EXPECT_EQ(m.face_sizes, (std::vector<int>{3, 3}));
  EXPECT_EQ(m.warnings.at(0), "a.obj: its 2 materials (a#1, a#2) are all rendered with one look");
}

TEST(Obj, NamesTextInSixteenBits) {
  std::string wide;
  for (const char c : square + "f 1 2 3 4\n") wide += {c, '\0'};
  EXPECT_EQ(error_of("\xff\xfe" + wide),
            "error: a.obj: is UTF-16 text, expected UTF-8 or plain ASCII text\n  help: save it as UTF-8");
  EXPECT_NE(error_of("\xfe\xff").find("is UTF-16 text,"), std::string::npos);
  EXPECT_NE(error_of(wide).find("is UTF-16 text, or no text at all"), std::string::npos);
  EXPECT_NE(error_of(wide.substr(1)).find("is UTF-16 text, or no text at all"), std::string::npos);
}

TEST(Obj, ReadsLineEndsOfEverySystemAlsoInOneFile) {
  const std::string text = square + "f 1 2 3 4\n";
  const std::vector<Vec3> positions = parse_obj(text, "a").positions;
  for (const std::string end : {"\r", "\r\n", "\r\r\n"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(parse_obj(other, "a").positions, positions);
    EXPECT_EQ(parse_obj("# by hand\n" + other, "a").positions, positions) << "with a line feed somewhere";
    EXPECT_EQ(parse_obj(other + "# by hand\n", "a").face_sizes.size(), 1u);
    EXPECT_EQ(error_of(other + "f 1 2 9" + end).find("a.obj:6:7: error:"), 0u);
  }
}

TEST(Obj, PassesOverTheEndOfTextThatDosWrites) {
  const std::string end = "\x1a", zeros(3, '\0');
  for (const std::string& text :
       {square + "f 1 2 3 4" + end, square + "f 1 2 3 4\r\n" + end, square + "f 1 2 3 4\n" + end + end + zeros,
        square + "f 1 2 3 4" + end + "\nv 5 5 5\n",
        square + end + "f 1 2 3 4\n" + end + "v 5 5 5" + end + "\n" + end}) {
    const ControlMesh m = parse_obj(text, "a.obj");
    EXPECT_EQ(m.position_indices, (std::vector<int>{0, 1, 2, 3}));
    EXPECT_TRUE(m.warnings.empty()) << m.warnings[0];
  }
  EXPECT_NE(error_of(square + "f 1 2" + end + "3 4\n").find("vertex index is '2"), std::string::npos);
}

TEST(Obj, ReportsAllErrorsAtOnceButNoMoreThanTwentyInFull) {
  std::string text = square;
  for (int i = 0; i < 30; ++i) text += "f 0 1 2\n";
  const std::string error = error_of(text);
  EXPECT_NE(error.find("a.obj:5:3"), std::string::npos);
  EXPECT_NE(error.find("a.obj:24:3"), std::string::npos);
  EXPECT_EQ(error.find("a.obj:25:3"), std::string::npos);
  EXPECT_NE(error.find("... and 10 more"), std::string::npos);
}

TEST(Obj, GivesUpAfterAHundredErrors) {
  std::string text = square;
  for (int i = 0; i < 5000; ++i) text += "f 0 1 2\n";
  EXPECT_NE(error_of(text).find("... and 80 more"), std::string::npos);
}

TEST(Obj, PlacesErrorsOnContinuedLinesWhereTheyStand) {
  EXPECT_EQ(error_of(square + "f 1 \\\n 2 \\\n  99\n"),
            "a.obj:7:3: error: vertex index is 99, expected 1 to 4\n    7 |   99\n      |   ^^");
}

TEST(Obj, PositionsFarFromTheOriginKeepWhatTheFileSays) {
  // Floats of this size are 64 apart.
  const ControlMesh m = parse_obj("v 1000000000 5 0\nv 1000000001.5 5 0\nv 1000000000 6.25 0\nf 1 2 3\n", "a.obj");
  EXPECT_EQ(m.positions[1] - m.positions[0], Vec3(1.5f, 0, 0));
  EXPECT_EQ(m.positions[2] - m.positions[0], Vec3(0, 1.25f, 0));
  EXPECT_EQ(m.placement.origin + Vec3d(m.positions[0]), Vec3d(1e9, 5, 0));
  // Near it they are as they were.
  const ControlMesh near = parse_obj("v 20 5 0\nv 21.5 5 0\nv 20 6.25 0\nf 1 2 3\n", "a.obj");
  EXPECT_TRUE(near.placement.is_identity());
  EXPECT_EQ(near.positions[1], Vec3(21.5f, 5, 0));
}

TEST(Obj, RefusesALineAboveOneMebibyte) {
  std::string text = square + "f";
  for (int i = 0; i < 400000; ++i) text += " 1 2";
  const std::string error = error_of(text + "\n");
  EXPECT_EQ(error.substr(0, 50), "a.obj:5:1: error: line is longer than 1 MiB\n    5 ");
  EXPECT_EQ(error_of(square + "#" + std::string((1 << 20) - 1, 'x') + "\nf 1 2 3\n"), "no error");
  // Nothing in a comment is read, however long.
  EXPECT_EQ(error_of("# " + std::string(3 << 20, 'x') + "\n" + square + "f 1 2 3\n"), "no error");
  EXPECT_EQ(error_of(square + "  # " + std::string(3 << 20, 'x') + "\nf 1 2 3\n"), "no error");
}

TEST(Obj, DropsRepeatedVerticesAndCountsThem) {
  const ControlMesh m = parse_obj(square + "f 1 2 3 4\nf 1 2 2 3\nf 1 1 1\nf 1 2 1 3\n", "a.obj");
  EXPECT_EQ(m.face_sizes, (std::vector<int>{4, 3}));
  ASSERT_EQ(m.warnings.size(), 2u);
  EXPECT_EQ(m.warnings[0], "a.obj:6: 1 face repeats a corner: the repetition was dropped");
  EXPECT_EQ(m.warnings[1],
            "a.obj:7: 2 faces meet a vertex twice and cross themselves, have no area or are too large to cut: they "
            "were dropped");
}

TEST(Obj, TakesTheUvsOfAFaceWhoseUvsAreNotFinite) {
  const ControlMesh m = parse_obj(square + "vt 0 0\nvt nan 0\nvt 1 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/1\n", "a.obj");
  EXPECT_EQ(m.uv_indices, (std::vector<int>{-1, -1, -1, 0, 2, 0}));
  ASSERT_EQ(m.warnings.size(), 1u);
  EXPECT_EQ(m.warnings[0].substr(0, 43), "a.obj:6: 1 texture coordinate is not finite");
}

TEST(Obj, TakesTheUvsOfAFaceThatHasThemAtSomeCornersOnly) {
  const ControlMesh m = parse_obj(square + "vt 0 0\nf 1/1 2 3/1\nf 1 2 3\nf 1/1 2/1 3/1\n", "a.obj");
  EXPECT_EQ(m.uv_indices, (std::vector<int>{-1, -1, -1, -1, -1, -1, 0, 0, 0}));
  ASSERT_EQ(m.warnings.size(), 1u);
}

TEST(ObjTags, ReadsCreasesCornersHolesAndBoundaryRules) {
  const ControlMesh m = parse_obj(square +
                                      "f 1 2 3 4\nf 1 2 3\nt crease 4/2/0 0 1 2 1 2.5 99\nt corner 2/1/0 0 3 4.0\n"
                                      "t hole 1/0/0 1\nt interpolateboundary 1/0/0 2\n"
                                      "t facevaryinginterpolateboundary 1/0/0 5\n",
                                  "a.obj");
  ASSERT_EQ(m.creases.size(), 2u);
  EXPECT_EQ(m.creases[0].vertices, (std::vector<int>{0, 1}));
  EXPECT_EQ(m.creases[0].sharpness, 2.5f);
  EXPECT_EQ(m.creases[1].vertices, (std::vector<int>{1, 2}));
  EXPECT_EQ(m.creases[1].sharpness, 10.0f);
  ASSERT_EQ(m.corners.size(), 2u);
  EXPECT_EQ(m.corners[1].vertex, 3);
  EXPECT_EQ(m.corners[1].sharpness, 4.0f);
  EXPECT_EQ(m.holes, std::vector<int>{1});
  EXPECT_EQ(m.boundary, ControlMesh::Boundary::edge_only);
  EXPECT_EQ(m.fvar_boundary, ControlMesh::FvarBoundary::all);
  EXPECT_TRUE(m.warnings.empty());
}

TEST(ObjTags, MergesRepeatedTags) {
  const std::string tags = "t crease 2/1/0 0 1 2\nt corner 1/1/0 2 3\nt hole 1/0/0 0\n";
  const ControlMesh m = parse_obj(square + "f 1 2 3 4\nf 1 2 3\n" + tags + tags + "t crease 2/1/0 1 0 5\n", "a.obj");
  ASSERT_EQ(m.creases.size(), 1u);
  EXPECT_EQ(m.creases[0].sharpness, 5.0f) << "the last one counts";
  EXPECT_EQ(m.corners.size(), 1u);
  EXPECT_EQ(m.holes.size(), 1u);
}

TEST(ObjTags, FollowsHolesPastDroppedFaces) {
  const ControlMesh m = parse_obj(square + "f 1 2 3\nf 1 1 2\nf 2 3 4\nt hole 2/0/0 1 2\n", "a.obj");
  EXPECT_EQ(m.holes, std::vector<int>{1});
}

TEST(ObjTags, RefusesTagsThatPointNowhere) {
  EXPECT_EQ(error_of(square + "f 1 2 3 4\nt crease 2/1/0 0 4 1\n"),
            "a.obj:6:18: error: crease at vertex 4, expected 0 to 3\n    6 | t crease 2/1/0 0 4 1\n"
            "      |                  ^");
  EXPECT_NE(error_of(square + "f 1 2 3 4\nt hole 1/0/0 -1\n").find("hole at face -1, expected 0 to 0"),
            std::string::npos);
  EXPECT_NE(error_of(square + "f 1 2 3 4\nt interpolateboundary 1/0/0 7\n")
                .find("interpolateboundary is 7, expected 0 to 2"),
            std::string::npos);
}

TEST(ObjTags, PassesOverStrayAndMalformedTagsWithAWarning) {
  for (const std::string line :
       {"t", "t hello world", "t crease 2/1 0 1 1", "t crease 3/1/0 0 1 2 1", "t hole 9999999999999/0/0",
        "t crease 2/1/0 0 1", "t 0.5 0.25", "t corner 1/1/0 1 nan"}) {
    const ControlMesh m = parse_obj(square + "f 1 2 3 4\n" + line + "\n", "a.obj");
    ASSERT_EQ(m.warnings.size(), 1u) << line;
    EXPECT_EQ(m.warnings[0], "a.obj:6: 1 tag not understood and ignored") << line;
    EXPECT_TRUE(m.creases.empty() && m.corners.empty() && m.holes.empty());
  }
}

TEST(ObjFile, IsReadFromDiskAndAMissingOneIsNamed) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "sateen_obj_test.obj";
  std::ofstream(path) << square << "f 1 2 3 4\n";
  EXPECT_EQ(read_obj(path).face_sizes.size(), 1u);
  EXPECT_EQ(read_obj(path).name, path.string());
  std::filesystem::remove(path);
  try {
    read_obj(path);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.kind, InputError::Kind::unreadable);
    EXPECT_EQ(std::string(e.what()), "error: " + path.string() + ": no such file");
  }
}

}  // namespace
}  // namespace sateen
