#include "image/figure.h"

#include <gtest/gtest.h>

#include <set>

#include "image/bitmap_font.h"
#include "image/contact_sheet.h"

namespace sateen_test {

using namespace sateen;

TEST(BitmapFont, EveryPrintableCharacterHasAGlyphOfItsOwn) {
  std::set<std::string> seen;
  for (char c = ' '; c <= '~'; ++c) {
    std::string dots;
    for (int y = 0; y < font_height; ++y)
      for (int x = 0; x < font_width; ++x) dots += font_ink(c, x, y) ? '#' : '.';
    EXPECT_EQ(dots.find('#') == std::string::npos, c == ' ') << c;
    EXPECT_TRUE(seen.insert(dots).second) << c;
  }
  EXPECT_EQ(shown_length("caf\xc3\xa9"), 4);
}

TEST(Figure, ALineCoversItsWidthOnceEvenAtItsJoints) {
  Figure figure;
  figure.width = 40;
  figure.height = 20;
  figure.shapes.push_back(FigureLine{{Vec2(5, 10), Vec2(20, 10), Vec2(35, 10)}, Color(0, 0, 0), 4, false});
  const Image image = draw_figure(figure);
  double ink = 0;
  for (size_t i = 0; i < image.pixels.size(); i += 3) ink += 1 - double(image.pixels[i]);
  // 30 x 4 and the two round ends, pi 2^2, within what the smooth border costs.
  EXPECT_NEAR(ink, 30 * 4 + 12.57, 2);
  EXPECT_EQ(image.at(20, 10)[0], 0.0f);
  EXPECT_EQ(image.at(20, 3)[0], 1.0f);
}

TEST(Figure, TextIsPlacedByItsAnchor) {
  for (const auto anchor : {FigureText::Anchor::left, FigureText::Anchor::middle, FigureText::Anchor::right}) {
    Figure figure;
    figure.width = 100;
    figure.height = 12;
    figure.shapes.push_back(FigureText{Vec2(50, 2), "HHH", Color(0, 0, 0), 1, anchor});
    const Image image = draw_figure(figure);
    int first = 100, last = -1;
    for (int x = 0; x < 100; ++x)
      for (int y = 0; y < 12; ++y)
        if (image.at(x, y)[0] < 0.5f) first = std::min(first, x), last = std::max(last, x);
    const int expected = anchor == FigureText::Anchor::left ? 50 : anchor == FigureText::Anchor::middle ? 42 : 33;
    EXPECT_NEAR(first, expected, 1);
    EXPECT_EQ(last - first, 16);
  }
}

TEST(Figure, SvgEscapesTextAndHoldsEveryShape) {
  Figure figure;
  figure.width = figure.height = 10;
  figure.shapes = {FigureText{Vec2(0, 0), "a<b & c", Color(0, 0, 0), 1, FigureText::Anchor::left},
                   FigureBox{Vec2(0, 0), Vec2(2, 2), Color(1, 0, 0)}, FigurePicture{Vec2(0, 0), Image(4, 4, 3), 1},
                   FigureLine{{Vec2(0, 0), Vec2(1, 1)}, Color(0, 0, 0), 1, true}};
  const std::string svg = figure_svg(figure);
  for (const char* part : {"a&lt;b &amp; c", "fill=\"#ff0000\"", "M0 3.5h4", "<polygon"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

TEST(ContactSheet, ShrinkingKeepsTheMeanAndTheShape) {
  Image image(64, 32, 3);
  double before = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i) before += double(image.pixels[i] = float(i % 97) / 97);
  const Image small = shrink_image(image, 16);
  ASSERT_EQ(small.width, 16);
  ASSERT_EQ(small.height, 8);
  double after = 0;
  for (const float v : small.pixels) after += double(v);
  EXPECT_NEAR(after / double(small.pixels.size()), before / double(image.pixels.size()), 1e-6);
  EXPECT_EQ(shrink_image(image, 100).pixels, image.pixels);
}

TEST(ContactSheet, HoldsEveryPictureAndLabelsTakeRoomOnlyWhereAskedFor) {
  std::vector<SheetPicture> pictures;
  for (int i = 0; i < 7; ++i) {
    Image image(20, 10, 3);
    for (float& v : image.pixels) v = 0.3f + 0.1f * float(i);
    pictures.push_back({image, "n"});
  }
  const Image plain = contact_sheet(pictures, false), labelled = contact_sheet(pictures, true);
  EXPECT_GT(labelled.height, plain.height);
  for (int i = 0; i < 7; ++i) {
    int found = 0;
    for (size_t p = 0; p < plain.pixels.size(); p += 3)
      found += std::abs(plain.pixels[p] - (0.3f + 0.1f * float(i))) < 1e-6f;
    EXPECT_EQ(found, 200) << i;
  }
  EXPECT_GT(contact_sheet({}, true).width, 0);
}

}  // namespace sateen_test
