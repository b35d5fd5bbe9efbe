#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <random>

#include "base/error.h"
#include "base/files.h"
#include "image/chromaticities.h"
#include "image/file.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using namespace sateen_test;

std::string refusal(const fs::path& path, const ImageLimits& limits = {}) {
  try {
    read_image(path, limits);
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
    EXPECT_EQ(error.diagnostics.at(0).file, path.string());
    return error.diagnostics.at(0).message;
  }
  return "it was read";
}

bool begins_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

TEST(ReadImage, PlacesADataWindowInItsDisplayWindow) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "window.exr";
  const int windows[][4] = {{3, 2, 5, 4}, {-4, -3, 30, 20}, {-2, 5, 8, 12}, {0, 0, 16, 12}, {100, 100, 2, 2}};
  for (const auto& w : windows) {
    write_windowed_exr(path, 16, 12, w[0], w[1], w[2], w[3]);
    const Image image = read_image(path);
    ASSERT_EQ(image.width, 16);
    ASSERT_EQ(image.height, 12);
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x) {
        const bool inside = x >= w[0] && x < w[0] + w[2] && y >= w[1] && y < w[1] + w[3];
        EXPECT_EQ(image.at(x, y)[0], inside ? float(x) : 0.0f) << w[0] << " " << x << " " << y;
        EXPECT_EQ(image.at(x, y)[1], inside ? float(y) : 0.0f);
        EXPECT_EQ(image.at(x, y)[2], inside ? 2.0f : 0.0f);
      }
  }
}

// OpenEXR fills what an attribute claims to hold before it looks whether the file holds it: half a minute.
TEST(ReadImage, RefusesAnAttributeThatClaimsMoreThanTheFileHolds) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "claims.exr";
  write_windowed_exr(path, 16, 12, 0, 0, 16, 12);
  std::string bytes = read_text_file(path, 1 << 20);
  const size_t size_at = bytes.find("compression") + std::string("compression").size() + 1 + sizeof "compression";
  ASSERT_EQ(bytes.substr(size_at, 4), std::string("\1\0\0\0", 4));
  bytes.replace(size_at, 4, "\xff\xff\xff\x7f");
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_TRUE(begins_with(refusal(path), "its attribute compression claims 2147483647 bytes")) << refusal(path);
}

TEST(ReadImage, TakesTheFullResolutionOfTiledAndMipMappedFiles) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "tiled.exr";
  for (bool mipmapped : {false, true}) {
    write_tiled_exr(path, 50, 37, mipmapped);
    const Image image = read_image(path);
    ASSERT_EQ(image.width, 50);
    ASSERT_EQ(image.height, 37);
    for (int y = 0; y < 37; ++y)
      for (int x = 0; x < 50; ++x) ASSERT_EQ(image.at(x, y)[0] + 1000 * image.at(x, y)[1], float(x + 1000 * y));
  }
}

TEST(ReadImage, RefusesDeepPixelsAndTakesTheFirstFlatPart) {
  const ScratchFolder folder;
  const fs::path deep = folder.path / "deep.exr", parts = folder.path / "parts.exr";
  write_deep_exr(deep, 8, 6);
  EXPECT_TRUE(begins_with(refusal(deep), "holds deep pixels only")) << refusal(deep);
  write_multipart_exr(parts, 8, 6);
  const Image image = read_image(parts);
  EXPECT_EQ(image.channels, 3);
  EXPECT_EQ(image.at(5, 4)[0], 5);
  EXPECT_EQ(image.at(5, 4)[1], 4);
}

TEST(ReadImage, ReadsAnyNumberOfChannelsAndSaysWhatTheFileIs) {
  const ScratchFolder folder;
  const std::vector<std::string> names[] = {
      {"Y"}, {"A", "Y"}, {"R", "G", "B"}, {"R", "G", "B", "A"}, {"R", "G", "B", "A", "Z"}};
  for (const auto& channels : names) {
    ImageLayer layer;
    layer.channels = channels;
    layer.image = Image(3, 2, int(channels.size()));
    for (size_t i = 0; i < layer.image.pixels.size(); ++i) layer.image.pixels[i] = float(i);
    const fs::path path = folder.path / "channels.exr";
    write_exr(path, {layer}, {}, ap1_chromaticities);
    ImageFileInfo info;
    const Image image = read_image(path, {}, &info);
    EXPECT_EQ(image.channels, int(channels.size()));
    EXPECT_EQ(info.channel_names.size(), channels.size());
    EXPECT_EQ(info.format, "openexr");
    EXPECT_EQ(info.pixel_type, "float");
    EXPECT_EQ(info.color_space, "");  // the library's "Linear" is not the file's word
    ASSERT_TRUE(info.chromaticities.has_value());
    EXPECT_EQ(info.chromaticities->blue[1], 0.044f);
    EXPECT_EQ(read_image_info(path).width, 3);
  }
}

TEST(ReadImage, RefusesWhatIsNoRegularPicture) {
  const ScratchFolder folder;
  EXPECT_EQ(refusal(folder.path / "none.exr"), "no such file");
  EXPECT_EQ(refusal(folder.path), "is a folder, expected a picture");
  const fs::path pipe = folder.path / "pipe.exr";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusal(pipe), "is not a regular file");
  const fs::path empty = folder.path / "empty.exr";
  write_bytes(empty, "");
  EXPECT_EQ(refusal(empty), "is empty, expected a picture");
  for (const char* name : {"text.exr", "text.hdr", "text.png", "text", "text.xyz"}) {
    write_bytes(folder.path / name, "this is a text and not a picture of anything\n");
    EXPECT_TRUE(begins_with(refusal(folder.path / name),
                            "is text that begins with \"this is a text and n\", expected a picture"))
        << refusal(folder.path / name);
  }
}

TEST(ReadImage, ChecksSizesBeforeItAllocates) {
  const ScratchFolder folder;
  // 53 bytes that claim 41 GB.
  const fs::path hdr = folder.path / "bomb.hdr";
  write_bytes(hdr, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32000 +X 107000\n");
  EXPECT_EQ(refusal(hdr), "its data window is 107000 x 32000 pixels, expected at most 32768 a side");
  write_bytes(hdr, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32000 +X 32000\n");
  EXPECT_EQ(refusal(hdr),
            "its data window of 32000 x 32000 pixels with 3 channels takes 11.4 GiB decoded, expected at most 2.0");
  const fs::path exr = folder.path / "small.exr";
  write_windowed_exr(exr, 16, 12, 0, 0, 16, 12);
  ImageLimits limits;
  limits.side = 15;
  EXPECT_EQ(refusal(exr, limits), "its data window is 16 x 12 pixels, expected at most 15 a side");
  limits = {};
  limits.decoded_bytes = 16 * 12 * 3 * 4 - 1;
  EXPECT_NE(refusal(exr, limits), "it was read");
  limits.decoded_bytes += 1;
  EXPECT_EQ(refusal(exr, limits), "it was read");
  // A tiny data window in a huge display window.
  write_windowed_exr(exr, 1 << 20, 12, 0, 0, 2, 2);
  EXPECT_EQ(refusal(exr), "its picture is 1048576 x 12 pixels, expected at most 32768 a side");
}

TEST(ReadImage, RefusesEveryTruncation) {
  const ScratchFolder folder;
  const fs::path whole = folder.path / "whole.exr", cut = folder.path / "cut.exr";
  write_windowed_exr(whole, 64, 48, 0, 0, 64, 48);
  const std::string bytes = read_bytes(whole);
  ASSERT_GT(bytes.size(), 600u);
  for (size_t length = 1; length < bytes.size(); length += bytes.size() / 60) {
    write_bytes(cut, bytes.substr(0, length));
    EXPECT_NE(refusal(cut), "it was read") << length << " of " << bytes.size();
  }
}

TEST(ReadImage, ReadsRadianceFilesAndRefusesCutOnes) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.hdr";
  std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 4\n";
  for (int i = 0; i < 16; ++i)
    bytes += {char(128), char(64), char(8 * i), char(130)};  // mantissa / 256 * 2^(130 - 128)
  write_bytes(path, bytes);
  ImageFileInfo info;
  const Image image = read_image(path, {}, &info);
  EXPECT_EQ(info.format, "hdr");
  EXPECT_EQ(info.pixel_type, "float");
  EXPECT_NEAR(image.at(0, 0)[0], 2, 0.02f);
  EXPECT_NEAR(image.at(3, 3)[2], 1.875f, 0.02f);
  for (size_t cut : {1, 17, 40, 63}) {
    write_bytes(path, bytes.substr(0, bytes.size() - cut));
    EXPECT_TRUE(begins_with(refusal(path), "its pixels cannot be read")) << cut << ": " << refusal(path);
  }
}

TEST(ReadImage, RefusesCutDisplayPictures) {
  const ScratchFolder folder;
  std::mt19937 random(3);
  Image noise(64, 64, 3);
  for (float& v : noise.pixels) v = float(random() % 1000) / 1000;
  for (const char* name : {"a.png", "a.tif"}) {
    const fs::path path = folder.path / name;
    write_display_image(path, noise);
    const std::string bytes = read_bytes(path);
    for (double share : {0.1, 0.5, 0.9}) {
      write_bytes(path, bytes.substr(0, size_t(share * double(bytes.size()))));
      EXPECT_NE(refusal(path), "it was read") << name << " " << share;
    }
  }
}

TEST(ReadImage, SurvivesDamagedBytes) {
  // Not whether it refuses, which a changed pixel does not deserve, but that nothing else than InputError comes out.
  const ScratchFolder folder;
  const fs::path whole = folder.path / "whole.exr", hurt = folder.path / "hurt.exr";
  write_windowed_exr(whole, 32, 24, 0, 0, 32, 24);
  const std::string bytes = read_bytes(whole);
  std::mt19937 random(1);
  for (int k = 0; k < 300; ++k) {
    std::string damaged = bytes;
    for (int i = 0; i < 3; ++i) damaged[8 + random() % (k % 2 ? 400 : damaged.size() - 8)] = char(random());
    write_bytes(hurt, damaged);
    try {
      const Image image = read_image(hurt);
      EXPECT_EQ(image.pixels.size(), size_t(image.width) * size_t(image.height) * size_t(image.channels));
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("hurt.exr: error: "), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace sateen
