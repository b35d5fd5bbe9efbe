#include "render/frames.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace sateen {

namespace {
std::string refusal(const std::string& text) {
  try {
    parse_frames(text);
  } catch (const InputError& error) {
    return error.diagnostics.at(0).message;
  }
  return "accepted";
}
using Frames = std::vector<int>;
}  // namespace

TEST(Frames, RangesStepsDotsListsAndMixturesAreRead) {
  EXPECT_EQ(parse_frames("7"), (Frames{7}));
  EXPECT_EQ(parse_frames("1-4"), (Frames{1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("1-10x3"), (Frames{1, 4, 7, 10}));
  EXPECT_EQ(parse_frames("3..5"), (Frames{3, 4, 5}));
  EXPECT_EQ(parse_frames("1,5,9"), (Frames{1, 5, 9}));
  EXPECT_EQ(parse_frames("9,1-3,2..4"), (Frames{9, 1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("0-0"), (Frames{0}));
}

TEST(Frames, AnythingElseIsRefusedWithItsReason) {
  EXPECT_EQ(refusal(""), "frames \"\": a number is missing");
  EXPECT_EQ(refusal("a"), "frames a: a number is missing");
  EXPECT_EQ(refusal("-3"), "frames -3: a number is missing");
  EXPECT_EQ(refusal("1-"), "frames 1-: a number is missing");
  EXPECT_EQ(refusal("5-1"), "frames 5-1: the range 5 to 1 runs backwards");
  EXPECT_EQ(refusal("1-9x0"), "frames 1-9x0: a step is 1 or more");
  EXPECT_EQ(refusal("1-9y2"), "frames 1-9y2: y2 is not understood");
  EXPECT_EQ(refusal("1,,2"), "frames 1,,2: a number is missing");
  EXPECT_EQ(refusal("1-99999999999"), "frames 1-99999999999: numbers go up to 999999");
  EXPECT_EQ(refusal("0-999999"), "frames 0-999999: 1000000 frames are too many");
}

TEST(Frames, NamesTakeTheNumberWhereTheyHaveAPlace) {
  EXPECT_EQ(frame_name("a.#.png", 7), "a.0007.png");
  EXPECT_EQ(frame_name("a.######.png", 7), "a.000007.png");
  EXPECT_EQ(frame_name("a.%04d.png", 12345), "a.12345.png");
  EXPECT_EQ(frame_name("a%d.png", 7), "a7.png");
  EXPECT_EQ(frame_name("$F4.exr", 7), "0007.exr");
  EXPECT_EQ(frame_name("x$F.exr", 7), "x7.exr");
  EXPECT_EQ(frame_name("100%.png", 7), "100%.png");
  EXPECT_FALSE(has_frame_place("turn.png"));
  EXPECT_FALSE(has_frame_place("50%off.png"));
  EXPECT_TRUE(has_frame_place("turn#.png"));
  EXPECT_THROW(frame_name("a.#.#.png", 1), InputError);
}

}  // namespace sateen
