#include <gtest/gtest.h>

#include <cmath>

#include "image/alpha.h"
#include "image/chromaticities.h"
#include "image/file.h"
#include "image/made_files.h"
#include "image/made_pictures.h"
#include "image/scratch_folder.h"

// Pictures as every viewer shows them: orientation tags and alpha.

namespace sateen {
namespace {

namespace fs = std::filesystem;
using namespace sateen_test;

// "abc/def": pixels by letters, rows from the top.
Image letters(const std::string& text) {
  const auto width = int(text.find('/'));
  Image image(width, int(text.size() + 1) / (width + 1), 1);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < width; ++x) *image.at(x, y) = float(text[size_t(y * (width + 1) + x)]);
  return image;
}

std::string as_letters(const Image& image) {
  std::string text;
  for (int y = 0; y < image.height; ++y) {
    if (y) text += '/';
    for (int x = 0; x < image.width; ++x) text += char(image.at(x, y)[0]);
  }
  return text;
}

// TIFF 6.0, tag 274: where the first row and the first column are to be seen.
const char* const shown[] = {"abc/def",  "abc/def",  "cba/fed",  "fed/cba", "def/abc",
                             "ad/be/cf", "da/eb/fc", "fc/eb/da", "cf/be/ad"};

TEST(Orientation, IsAppliedAsTheTagSaysInAllEight) {
  for (int orientation = 0; orientation <= 8; ++orientation)
    EXPECT_EQ(as_letters(apply_orientation(letters("abc/def"), orientation)), shown[orientation]) << orientation;
  for (const int none : {-1, 9, 65535}) EXPECT_EQ(as_letters(apply_orientation(letters("abc/def"), none)), "abc/def");
  Image colours(2, 1, 3);
  colours.pixels = {1, 2, 3, 4, 5, 6};
  EXPECT_EQ(apply_orientation(colours, 3).pixels, (std::vector<float>{4, 5, 6, 1, 2, 3}));
}

TEST(Orientation, OfTiffFilesIsObeyed) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "turned.tif";
  for (int orientation = 0; orientation <= 8; ++orientation) {
    write_tiff(path, {3, 2, 1, {'a', 'b', 'c', 'd', 'e', 'f'}}, TiffAlpha::none, orientation);
    ImageFileInfo info;
    Image image = read_image(path, {}, &info);
    for (float& pixel : image.pixels) pixel = std::round(pixel * 255);
    EXPECT_EQ(as_letters(image), shown[orientation]) << orientation;
    const ImageFileInfo before = read_image_info(path);
    for (const ImageFileInfo& said : {info, before}) {
      EXPECT_EQ(said.width, image.width);
      EXPECT_EQ(said.height, image.height);
    }
  }
}

TEST(Orientation, OfJpegFilesIsObeyed) {
  const ScratchFolder folder;
  // Blocks that JPEG keeps: a to f as greys.
  Image image(24, 16, 3);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = 0.1f + 0.15f * float(x / 8 + 3 * (y / 8));
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const fs::path path = folder.path / ("turned" + std::to_string(orientation) + ".jpg");
    write_display_image(path, image);
    set_jpeg_orientation(path, orientation);
    const Image read = read_image(path);
    std::string found;
    for (int y = 4; y < read.height; y += 8) {
      if (y > 4) found += '/';
      for (int x = 4; x < read.width; x += 8)
        found += char('a' + int(std::lround((read.at(x, y)[0] - 0.1f) / 0.15f)));
    }
    EXPECT_EQ(found, shown[orientation]) << orientation;
  }
}

// The slow axis first: "+X 3 -Y 2" has the columns of the picture as its lines, the left one first, each from the
// top.
TEST(Orientation, OfRadianceFilesIsObeyed) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "turned.hdr";
  // As they are stored, in two lines of three or three lines of two.
  for (const auto& [resolution, expected] : {std::pair("-Y 2 +X 3", "abc/def"),
                                             {"-Y 2 -X 3", "cba/fed"},
                                             {"+Y 2 -X 3", "fed/cba"},
                                             {"+Y 2 +X 3", "def/abc"},
                                             {"+X 2 -Y 3", "ad/be/cf"},
                                             {"-X 2 -Y 3", "da/eb/fc"},
                                             {"-X 2 +Y 3", "fc/eb/da"},
                                             {"+X 2 +Y 3", "cf/be/ad"}}) {
    std::string file = std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") + resolution + "\n";
    for (const char letter : std::string("abcdef")) file += std::string(3, letter) + char(136);
    write_bytes(path, file);
    const Image image = read_image(path);
    EXPECT_EQ(as_letters(image), expected) << resolution;
  }
}

struct Read {
  Image image;
  ImageFileInfo info;
  std::vector<float> alpha;
};

Read read(const fs::path& path) {
  Read r;
  r.image = read_image(path, {}, &r.info);
  r.alpha = take_alpha(r.image, r.info);
  return r;
}

void expect_pixel(const Read& found, size_t i, const std::vector<float>& codes, float alpha,
                  float tolerance = 1e-6f) {
  ASSERT_GT(found.alpha.size(), i);
  EXPECT_NEAR(found.alpha[i], alpha, 1e-6f);
  for (size_t c = 0; c < codes.size(); ++c)
    EXPECT_NEAR(found.image.pixels[i * size_t(found.image.channels) + c], codes[c], tolerance) << i << " " << c;
}

TEST(Alpha, LeavesTheColoursOfPngFilesAsTheyAreStored) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.png";
  for (const int bits : {8, 16}) {
    const std::uint16_t one = bits == 8 ? 255 : 65535, half = bits == 8 ? 128 : 32768, fifth = one / 5;
    const float h = float(half) / float(one);
    write_png(path, {2, 1, 4, {fifth, one, half, half, one, fifth, 0, 0}}, bits);
    Read r = read(path);
    expect_pixel(r, 0, {0.2f, 1, h}, h);
    EXPECT_EQ(r.alpha[1], 0);
    write_png(path, {2, 1, 2, {fifth, half, one, 0}}, bits);
    r = read(path);
    expect_pixel(r, 0, {0.2f}, h);
    EXPECT_EQ(r.alpha[1], 0);
    // One colour, or one grey, of those without alpha.
    write_png(path, {2, 1, 3, {fifth, one, half, one, fifth, 0}}, bits, {one, fifth, 0});
    r = read(path);
    expect_pixel(r, 0, {0.2f, 1, h}, 1);
    EXPECT_EQ(r.alpha[1], 0);
    write_png(path, {2, 1, 1, {fifth, half}}, bits, {half});
    r = read(path);
    expect_pixel(r, 0, {0.2f}, 1);
    EXPECT_EQ(r.alpha[1], 0);
    write_png(path, {2, 1, 4, {fifth, one, half, one, one, fifth, 0, one}}, bits);
    EXPECT_TRUE(read(path).alpha.empty()) << "opaque";
  }
  write_palette_png(path, 3, 1, {0, 1, 2}, {{51, 255, 128, 255}, {51, 0, 102, 51}, {255, 0, 0, 0}});
  const Read r = read(path);
  expect_pixel(r, 0, {0.2f, 1, 128 / 255.0f}, 1);
  expect_pixel(r, 1, {0.2f, 0, 0.4f}, 0.2f);
  EXPECT_EQ(r.alpha[2], 0);
}

TEST(Alpha, IsTakenOutOfColoursThatAFileMultiplies) {
  const ScratchFolder folder;
  const fs::path tiff = folder.path / "a.tif", exr = folder.path / "a.exr";
  for (const TiffAlpha kind : {TiffAlpha::associated, TiffAlpha::unassociated}) {
    const bool multiplied = kind == TiffAlpha::associated;
    const auto code = [&](int c, int a) { return std::uint16_t(multiplied ? c * a / 255 : c); };
    write_tiff(tiff, {2, 1, 4, {code(50, 102), code(200, 102), code(100, 102), 102, code(250, 0), 0, 0, 0}}, kind);
    Read r = read(tiff);
    EXPECT_EQ(r.info.colors_times_alpha, multiplied);
    expect_pixel(r, 0, {50 / 255.0f, 200 / 255.0f, 100 / 255.0f}, 0.4f, 1e-6f);
    EXPECT_EQ(r.alpha[1], 0);
    write_tiff(tiff, {2, 1, 2, {code(50, 51), 51, code(250, 255), 255}}, kind);
    r = read(tiff);
    expect_pixel(r, 0, {50 / 255.0f}, 0.2f, 1e-6f);
    expect_pixel(r, 1, {250 / 255.0f}, 1, 1e-6f);
  }
  Image image(4, 1, 4);
  const float nan = std::nanf("");
  image.pixels = {0.25f, 0.5f, 0.125f, 0.5f, 3, 2, 1, 1, 7, 7, 7, 0, 1, 1, 1, nan};
  write_exr(exr, {{"", {"R", "G", "B", "A"}, false, image}}, {}, rec709_chromaticities);
  const Read r = read(exr);
  EXPECT_TRUE(r.info.colors_times_alpha);
  expect_pixel(r, 0, {0.5f, 1, 0.25f}, 0.5f);
  expect_pixel(r, 1, {3, 2, 1}, 1);
  EXPECT_EQ(r.alpha[2], 0);
  EXPECT_EQ(r.alpha[3], 0);
}

TEST(Alpha, IsNoneInAPictureOfNumbers) {
  const ScratchFolder folder;
  for (const std::vector<std::string>& names : {std::vector<std::string>{"U", "V"}, {"A"}, {"R", "G", "B"}}) {
    Image image(1, 1, int(names.size()));
    std::fill(image.pixels.begin(), image.pixels.end(), 0.25f);
    write_exr(folder.path / "n.exr", {{"", names, false, image}}, {}, rec709_chromaticities);
    const Read r = read(folder.path / "n.exr");
    EXPECT_TRUE(r.alpha.empty()) << names[0];
    EXPECT_EQ(r.image.pixels[0], 0.25f);
  }
}

}  // namespace
}  // namespace sateen
