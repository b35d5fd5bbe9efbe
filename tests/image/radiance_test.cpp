#include "image/radiance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "image/file.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

namespace sateen_test {
namespace {

using namespace sateen;
namespace fs = std::filesystem;

using Pixel = std::array<int, 4>;
constexpr int width = 12, height = 9;

// Every pixel another, as seen.
Pixel pixel_at(int x, int y) {
  return {128 + x, 128 + y, 140, 129};
}

std::string bytes_of(const Pixel& p) {
  return {char(p[0]), char(p[1]), char(p[2]), char(p[3])};
}

std::string flat(int scanlines, int length, const std::function<Pixel(int, int)>& at) {
  std::string bytes;
  for (int i = 0; i < scanlines; ++i)
    for (int k = 0; k < length; ++k) bytes += bytes_of(at(i, k));
  return bytes;
}

// The new encoding, as literals of three and runs of two where two are equal.
std::string encoded(int scanlines, int length, const std::function<Pixel(int, int)>& at) {
  std::string bytes;
  for (int i = 0; i < scanlines; ++i) {
    bytes += {2, 2, char(length >> 8), char(length & 255)};
    for (size_t c = 0; c < 4; ++c)
      for (int k = 0; k < length;) {
        const int value = at(i, k)[c];
        if (k + 1 < length && at(i, k + 1)[c] == value) {
          bytes += {char(128 + 2), char(value)};
          k += 2;
        } else {
          bytes += {char(1), char(value)};
          ++k;
        }
      }
  }
  return bytes;
}

struct Radiance {
  const ScratchFolder folder;
  fs::path path = folder.path / "a.hdr";

  Image read(const std::string& bytes, LightFileInfo* info = nullptr) const {
    write_bytes(path, bytes);
    const auto file = open_radiance(path);
    if (info) *info = file->info;
    Image image(file->info.width, file->info.height, 3);
    // In bands, the first of them twice.
    const int half = image.height / 2;
    file->read_rows(0, half, image.pixels.data());
    file->read_rows(0, half, image.pixels.data());
    file->read_rows(half, image.height - half, image.pixels.data() + 3 * image.width * half);
    return image;
  }
  std::string refusal(const std::string& bytes) const {
    try {
      read(bytes);
    } catch (const InputError& error) {
      EXPECT_EQ(error.kind, InputError::Kind::unreadable);
      return error.diagnostics.at(0).message;
    }
    return "it was read";
  }
};

const std::string magic = "#?RADIANCE\n", format = "FORMAT=32-bit_rle_rgbe\n", usual = "\n-Y 9 +X 12\n";

void expect_picture(const Image& image, float scale = 1) {
  ASSERT_EQ(image.width, width);
  ASSERT_EQ(image.height, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Pixel p = pixel_at(x, y);
      for (size_t c = 0; c < 3; ++c)
        ASSERT_FLOAT_EQ(image.at(x, y)[c], scale * std::ldexp(float(p[c]), p[3] - 136)) << x << " " << y;
    }
}

TEST(Radiance, TurnsThePictureAsItsResolutionStringSaysInAllEightOrders) {
  const Radiance r;
  for (const bool columns : {false, true})
    for (const char x_sign : {'+', '-'})
      for (const char y_sign : {'-', '+'}) {
        const std::string x_axis = std::string(1, x_sign) + "X 12", y_axis = std::string(1, y_sign) + "Y 9";
        const std::string resolution = columns ? x_axis + " " + y_axis : y_axis + " " + x_axis;
        SCOPED_TRACE(resolution);
        const auto at = [&](int i, int k) {
          const int across = columns ? i : k, down = columns ? k : i;
          return pixel_at(x_sign == '+' ? across : width - 1 - across, y_sign == '-' ? down : height - 1 - down);
        };
        const int scanlines = columns ? width : height, length = columns ? height : width;
        const std::string header = magic + format + "\n" + resolution + "\n";
        LightFileInfo info;
        expect_picture(r.read(header + encoded(scanlines, length, at), &info));
        EXPECT_EQ(info.notes.empty(), resolution == "-Y 9 +X 12");
        expect_picture(r.read(header + flat(scanlines, length, at)));
        expect_picture(read_image(r.path));  // textures too
      }
}

TEST(Radiance, ReadsHeadersAsProgramsWriteThem) {
  const Radiance r;
  const std::string pixels = encoded(height, width, [](int y, int x) { return pixel_at(x, y); });
  for (const std::string& header :
       {"#?RGBE\n" + format + usual, "#?PICTURE\n" + format + usual, "#?RADIANCE" + usual, magic + usual,
        magic + "# a comment\nSOFTWARE=none\nVIEW= -vtv\n" + format + usual, magic + format + "-Y 9 +X 12\n",
        magic + format + "\n\n-Y 9 +X 12\n",
        std::string("#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 9 +X 12\r\n"),
        magic + "FORMAT= 32-bit_rle_rgbe \n" + usual, magic + "\tEXPOSURE=7\n" + format + usual,
        magic + "EXPOSURE=1\nGAMMA=1.0\n" + format + usual}) {
    SCOPED_TRACE(header);
    expect_picture(r.read(header + pixels));
  }
}

TEST(Radiance, DividesByAllExposuresAndColourCorrectionsAndUndoesGamma) {
  const Radiance r;
  const std::string pixels = flat(height, width, [](int y, int x) { return pixel_at(x, y); });
  LightFileInfo info;
  expect_picture(r.read(magic + "EXPOSURE=4\n" + format + "EXPOSURE= 0.5\n" + usual + pixels, &info), 0.5f);
  ASSERT_EQ(info.notes.size(), 1u);
  EXPECT_NE(info.notes[0].find("divided by 2,"), std::string::npos) << info.notes[0];
  const Image corrected = r.read(magic + format + "COLORCORR= 2 1 0.5\nEXPOSURE=2\n" + usual + pixels);
  const Image plain = r.read(magic + format + usual + pixels);
  const float factors[] = {4, 2, 1};
  const Image curved = r.read(magic + format + "GAMMA=2\n" + usual + pixels);
  for (size_t i = 0; i < plain.pixels.size(); ++i) {
    EXPECT_FLOAT_EQ(corrected.pixels[i], plain.pixels[i] / factors[i % 3]);
    EXPECT_FLOAT_EQ(curved.pixels[i], plain.pixels[i] * plain.pixels[i]);
  }
}

TEST(Radiance, SaysWhichPrimariesAndThatItHoldsXyz) {
  const Radiance r;
  const std::string pixels = flat(height, width, [](int y, int x) { return pixel_at(x, y); });
  LightFileInfo info;
  r.read(magic + "PRIMARIES=0.7347 0.2653 0 1 0.0001 -0.077 0.3217 0.3377\n" + format + usual + pixels, &info);
  ASSERT_TRUE(info.chromaticities);
  EXPECT_FLOAT_EQ(info.chromaticities->blue[1], -0.077f);
  EXPECT_FALSE(info.xyz);
  r.read(magic + "FORMAT=32-bit_rle_xyze\n" + usual + pixels, &info);
  EXPECT_TRUE(info.xyz);
  EXPECT_THROW(read_image(r.path), InputError);  // a texture of XYZ is refused by its name
}

TEST(Radiance, ReadsTheOldRunLengthEncoding) {
  const Radiance r;
  // 300 pixels of one colour in a line: one, then 43 and 256 more in two counts; then a line of four pixels' worth.
  std::string bytes = magic + format + "\n-Y 2 +X 301\n";
  bytes += bytes_of({128, 64, 32, 129}) + bytes_of({1, 1, 1, 43}) + bytes_of({1, 1, 1, 1}) + bytes_of({8, 4, 2, 129});
  bytes += bytes_of({128, 128, 128, 129}) + bytes_of({1, 1, 1, 100}) + bytes_of({64, 64, 64, 129}) +
           bytes_of({1, 1, 1, 199});
  const Image image = r.read(bytes);
  EXPECT_EQ(image.at(0, 0)[0], 1);
  EXPECT_EQ(image.at(299, 0)[0], 1);
  EXPECT_EQ(image.at(300, 0)[0], 8 / 128.0f);
  EXPECT_EQ(image.at(100, 1)[2], 1);
  EXPECT_EQ(image.at(101, 1)[2], 0.5f);
  EXPECT_EQ(image.at(300, 1)[2], 0.5f);
}

TEST(Radiance, RefusesWhatIsDamagedByItsName) {
  const Radiance r;
  const std::string pixels = encoded(height, width, [](int y, int x) { return pixel_at(x, y); });
  const std::string whole = magic + format + usual + pixels;
  for (size_t cut = 1; cut < pixels.size(); cut += 7) {
    const std::string said = r.refusal(whole.substr(0, whole.size() - cut));
    EXPECT_EQ(said.rfind("its pixels cannot be read: the file is damaged or cut short (scanline ", 0), 0u) << said;
  }
  const auto expect = [&](const std::string& bytes, const std::string& part) {
    const std::string said = r.refusal(bytes);
    EXPECT_NE(said.find(part), std::string::npos) << said;
  };
  expect(magic + "FORMAT=24-bit_yuv\n" + usual + pixels, "in the format 24-bit_yuv");
  expect(magic + format + "EXPOSURE=0\n" + usual + pixels, "EXPOSURE=0, expected a number from 1e-30 to 1e30");
  expect(magic + format + "EXPOSURE=lots\n" + usual + pixels, "EXPOSURE=lots, expected 1 number");
  expect(magic + format + "PRIMARIES=1 2 3\n" + usual + pixels, "expected 8 numbers");
  expect(magic + format + "\n-Y 9\n" + pixels, "without a resolution string");
  expect(magic + format, "without a resolution string");
  expect(magic + format + "\n-Y 9 +Y 12\n", "without a resolution string");
  expect(magic + format + "\n-Y 99999999999 +X 12\n", "resolution string says 12 x 99999999999");
  expect(magic + format + "\n-Y -9 +X 12\n", "resolution string says 12 x -9");
  expect(magic + format + "\n-Y 9 +X 2000000\n", "expected at most 1000000 a side");
  expect(magic + format + "\n+Y 30000 +X 30000\n", "takes 10.1 GiB decoded");  // held whole: before it is allocated
  expect(magic + format + "\n-Y 9 +X 13\n" + pixels, "is said to have 12 pixels instead of 13");
  expect(magic + format + "\n-Y 1 +X 3\n" + bytes_of({1, 1, 1, 3}), "begins with a repetition");
  expect(magic + format + "\n-Y 1 +X 3\n" + bytes_of({9, 9, 9, 9}) + bytes_of({1, 1, 1, 9}), "longer than the line");
  expect(std::string("#?RADIANCE\n") + std::string(2 << 20, 'a'), "does not end within 1 MiB");
}

}  // namespace
}  // namespace sateen_test
