#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "base/error.h"
#include "image/attributes.h"
#include "image/chromaticities.h"
#include "image/dither.h"
#include "image/file.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using namespace sateen_test;

Image noise(int width, int height, int channels, float scale, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, scale);
  Image image(width, height, channels);
  for (float& v : image.pixels) v = uniform(random);
  return image;
}

ImageLayer layer(const std::string& name, std::vector<std::string> channels, bool half, Image image) {
  ImageLayer l;
  l.name = name;
  l.channels = std::move(channels);
  l.half = half;
  l.image = std::move(image);
  return l;
}

int files_in(const fs::path& folder) {
  return int(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteExr, KeepsLayersAttributesAndChromaticities) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "layers.exr";
  const Attributes attributes{{"sateen:spp", 64},
                              {"sateen:error", 0.1},
                              {"sateen:look", std::string("{\n  \"a\": \"\\\"\" }")},
                              {"Software", std::string("sateen 0.1")}};
  const Image beauty = noise(13, 7, 4, 100), normal = noise(13, 7, 3, 1, 2), uv = noise(13, 7, 2, 1, 3);
  EXPECT_EQ(write_exr(path,
                      {layer("", {"R", "G", "B", "A"}, true, beauty), layer("N", {"X", "Y", "Z"}, false, normal),
                       layer("uv", {"U", "V"}, false, uv)},
                      attributes, ap1_chromaticities)
                .held,
            0);
  ImageFileInfo info;
  const Image back = read_image(path, {}, &info);
  ASSERT_EQ(back.channels, 9);
  const auto channel = [&](const std::string& name) {
    const auto found = std::find(info.channel_names.begin(), info.channel_names.end(), name);
    EXPECT_NE(found, info.channel_names.end()) << name;
    return int(found - info.channel_names.begin());
  };
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x < 13; ++x) {
      EXPECT_NEAR(back.at(x, y)[channel("G")], beauty.at(x, y)[1], 0.04f);  // half: 11 bits
      EXPECT_NEAR(back.at(x, y)[channel("A")], beauty.at(x, y)[3], 0.04f);
      EXPECT_EQ(back.at(x, y)[channel("N.Z")], normal.at(x, y)[2]);
      EXPECT_EQ(back.at(x, y)[channel("uv.V")], uv.at(x, y)[1]);
    }
  EXPECT_EQ(read_attributes(path), attributes);
  ASSERT_TRUE(info.chromaticities.has_value());
  EXPECT_EQ(info.chromaticities->green[1], 0.83f);
}

TEST(WriteExr, HoldsHalfLayersWithinRangeAndCounts) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "clamped.exr";
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  Image image(4, 2, 1);
  image.pixels = {1e6f, -1e30f, 65504, 65519, inf, -inf, nan, 0.5f};
  const HalfRange range = write_exr(path, {layer("", {"Y"}, true, image)}, {}, ap1_chromaticities);
  EXPECT_EQ(range.held, 3);
  EXPECT_EQ(range.brightest, 1e30f);
  const Image back = read_image(path);
  EXPECT_EQ(back.pixels[0], 65504);
  EXPECT_EQ(back.pixels[1], -65504);
  EXPECT_EQ(back.pixels[2], 65504);
  EXPECT_EQ(back.pixels[3], 65504);
  EXPECT_EQ(back.pixels[4], inf);
  EXPECT_TRUE(std::isnan(back.pixels[6]));
  EXPECT_EQ(write_exr(path, {layer("", {"Y"}, false, image)}, {}, ap1_chromaticities).held, 0);
  EXPECT_EQ(read_image(path).pixels[1], -1e30f);
}

TEST(WriteExr, SaysWhereHalfFloatsHoldLittleOfADimPicture) {
  const ScratchFolder folder;
  const auto range = [&](float brightest) {
    Image image(2, 1, 4);
    image.pixels = {brightest, 0, 1e-9f, 1, 0, 0, 0, 1};
    return write_exr(folder.path / "dim.exr", {layer("", {"R", "G", "B", "A"}, true, image)}, {}, ap1_chromaticities);
  };
  EXPECT_FALSE(HalfRange{}.is_dim());  // black
  EXPECT_TRUE(range(1e-9f).is_dim());
  EXPECT_TRUE(range(9e-4f).is_dim());
  EXPECT_FALSE(range(1e-3f).is_dim());
}

TEST(WriteExr, RefusesLayersThatDoNotFitTogether) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "bad.exr";
  EXPECT_THROW(write_exr(path, {}, {}, ap1_chromaticities), OperationError);
  EXPECT_THROW(write_exr(path, {layer("", {"R"}, true, Image(0, 0, 1))}, {}, ap1_chromaticities), OperationError);
  EXPECT_THROW(write_exr(path, {layer("", {"R", "G"}, true, Image(2, 2, 1))}, {}, ap1_chromaticities),
               OperationError);
  EXPECT_THROW(write_exr(path, {layer("", {"R"}, true, Image(2, 2, 1)), layer("a", {"R"}, true, Image(3, 2, 1))}, {},
                         ap1_chromaticities),
               OperationError);
  EXPECT_THROW(write_exr(path, {layer("a", {"R", "R"}, true, Image(2, 2, 2))}, {}, ap1_chromaticities),
               OperationError);
  EXPECT_EQ(files_in(folder.path), 0);
}

TEST(WriteFiles, GiveTheSameBytesForTheSamePicture) {
  const ScratchFolder folder;
  const Image image = noise(40, 30, 3, 1);
  const Attributes attributes{{"sateen:spp", 4}};
  const char* extensions[] = {".exr", ".png", ".jpg", ".tif"};
  for (const char* name : {"a", "b"}) {
    for (const char* extension : extensions) {
      const fs::path path = folder.path / (std::string(name) + extension);
      if (path.extension() == ".exr")
        write_exr(path, {layer("", {"R", "G", "B"}, true, image)}, attributes, ap1_chromaticities);
      else
        write_display_image(path, image, attributes);
    }
    if (*name == 'a') usleep(1100000);  // a time in the file would differ
  }
  for (const char* extension : extensions)
    EXPECT_TRUE(read_bytes(folder.path / (std::string("a") + extension)) ==
                read_bytes(folder.path / (std::string("b") + extension)))
        << extension;
}

TEST(WriteFiles, HaveTheSameBytesInOneBandOrInMany) {
  const ScratchFolder folder;
  // 700 rows are several bands of either kind; rows that are asked for are counted.
  const Image image = noise(600, 700, 4, 1);
  int asked = 0;
  const auto rows = [&](int y0, int y1) {
    ++asked;
    Image part(image.width, y1 - y0, 4);
    std::copy_n(image.at(0, y0), part.pixels.size(), part.pixels.begin());
    return part;
  };
  write_exr(folder.path / "a.exr", {layer("", {"R", "G", "B", "A"}, false, image)}, {}, ap1_chromaticities);
  write_exr(
      folder.path / "b.exr", 600, 700,
      [&](int y0, int y1) {
        return std::vector{layer("", {"R", "G", "B", "A"}, false, rows(y0, y1))};
      },
      {}, ap1_chromaticities);
  EXPECT_GE(asked, 4);
  asked = 0;
  for (const char* extension : {".png", ".jpg", ".tif"}) {
    write_display_image(folder.path / (std::string("a") + extension), image);
    write_display_image(folder.path / (std::string("b") + extension), 600, 700, 4, rows);
  }
  EXPECT_GE(asked, 12);
  for (const char* extension : {".exr", ".png", ".jpg", ".tif"})
    EXPECT_TRUE(read_bytes(folder.path / (std::string("a") + extension)) ==
                read_bytes(folder.path / (std::string("b") + extension)))
        << extension;
  ImageFileInfo info;
  const Image back = read_image(folder.path / "b.exr", {}, &info);
  for (size_t c = 0; c < 4; ++c) {
    const auto name = std::string(1, "RGBA"[c]);
    const auto at =
        size_t(std::find(info.channel_names.begin(), info.channel_names.end(), name) - info.channel_names.begin());
    for (size_t i = 0; i < image.pixels.size() / 4; ++i) ASSERT_EQ(back.pixels[4 * i + at], image.pixels[4 * i + c]);
  }
}

TEST(WriteFiles, RowsThatDifferWhenTheyAreMadeAgainAreNoticed) {
  const ScratchFolder folder;
  int times = 0;
  const auto rows = [&](int y0, int y1) {
    Image part(64, y1 - y0, 3);
    for (float& v : part.pixels) v = ++times > 20'000 ? 0.5f : 0.25f;
    return part;
  };
  EXPECT_THROW(write_display_image(folder.path / "a.png", 64, 100, 3, rows), OperationError);
  EXPECT_EQ(files_in(folder.path), 0);
}

TEST(ImageDecodes, TellsAWholeFileFromOneThatIsCutShort) {
  const ScratchFolder folder;
  const Image image = noise(300, 200, 3, 1);
  for (const char* name : {"a.exr", "a.png", "a.tif"}) {
    const fs::path path = folder.path / name;
    if (path.extension() == ".exr")
      write_exr(path, {layer("", {"R", "G", "B"}, false, image)}, {}, ap1_chromaticities);
    else
      write_display_image(path, image);
    EXPECT_TRUE(image_decodes(path)) << name;
    fs::resize_file(path, fs::file_size(path) * 2 / 3);
    bool whole = false;
    try {
      whole = image_decodes(path);
    } catch (const InputError&) {
    }
    EXPECT_FALSE(whole) << name;
  }
}

TEST(WriteDisplayImage, KeepsCodesAlphaAndAttributesInEveryLosslessFormat) {
  const ScratchFolder folder;
  const Attributes attributes{{"sateen:spp", 64},
                              {"sateen:error", 0.1},
                              {"sateen:map", std::string("a \"b\"\nc\\d")},
                              {"Software", std::string("sateen 0.1")}};
  for (const char* name : {"a.png", "a.tif", "a.TIFF"})
    for (int bits : {8, 16})
      for (int channels : {3, 4}) {
        const fs::path path = folder.path / name;
        Image image = noise(17, 9, channels, 1);
        write_display_image(path, image, attributes, bits);
        ImageFileInfo info;
        Image back = read_image(path, {}, &info);
        EXPECT_EQ(info.pixel_type, bits == 8 ? "uint8" : "uint16");
        EXPECT_EQ(read_attributes(path), attributes) << name;
        ASSERT_EQ(back.channels, channels);
        if (channels == 4) continue;  // reading multiplies by alpha; the verification compares the codes themselves
        for (size_t i = 0; i < back.pixels.size(); ++i)
          ASSERT_NEAR(back.pixels[i], image.pixels[i], bits == 8 ? 1 / 255.0f : 0.51f / 65535) << name;
      }
}

TEST(WriteDisplayImage, WritesAGoodJpegWithoutAlpha) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.jpg";
  Image image(64, 48, 4);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 4; ++c) image.at(x, y)[c] = c == 3 ? 0.1f : float(x + y * c) / 200;
  write_display_image(path, image, {{"sateen:spp", 3}});
  const Image back = read_image(path);
  ASSERT_EQ(back.channels, 3);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(back.at(x, y)[c], image.at(x, y)[c], 0.03f);
  EXPECT_EQ(read_attributes(path), (Attributes{{"sateen:spp", 3}}));
}

TEST(WriteDisplayImage, RefusesWhatItCannotWrite) {
  const ScratchFolder folder;
  const Image image = noise(4, 4, 3, 1);
  EXPECT_THROW(write_display_image(folder.path / "a.gif", image), InputError);
  EXPECT_THROW(write_display_image(folder.path / "a", image), InputError);
  EXPECT_THROW(write_display_image(folder.path / "a.png", image, {}, 12), InputError);
  EXPECT_THROW(write_display_image(folder.path / "a.jpg", image, {}, 16), InputError);
  EXPECT_THROW(write_display_image(folder.path / "a.png", Image(4, 4, 1)), OperationError);
  EXPECT_THROW(write_display_image(folder.path / "a.png", Image()), OperationError);
  EXPECT_EQ(files_in(folder.path), 0);
}

TEST(WriteDisplayImage, SaysSrgbInAPngOnlyWhereItIs) {
  const ScratchFolder folder;
  const Image image = noise(4, 4, 3, 1);
  write_display_image(folder.path / "a.png", image);
  EXPECT_NE(read_bytes(folder.path / "a.png").find("sRGB"), std::string::npos);
  write_display_image(folder.path / "b.png", image, {}, 8, false);
  EXPECT_EQ(read_bytes(folder.path / "b.png").find("sRGB"), std::string::npos);
}

TEST(Dither, KeepsTheMeanAndTheEnds) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "grey.png";
  for (float value : {0.0f, 1.0f, 0.5f, 0.3333f, 0.12345f}) {
    Image image(64, 64, 3);
    for (float& v : image.pixels) v = value;
    write_display_image(path, image);
    const Image back = read_image(path);
    double sum = 0;
    for (float v : back.pixels) {
      sum += double(v);
      if (value == 0 || value == 1) {
        ASSERT_EQ(v, value);
      }
    }
    // 1,024 thresholds a tile: the mean is right to 1/1024 of a code.
    EXPECT_NEAR(sum / double(back.pixels.size()), double(value), 1.0 / 255 / 1024);
  }
}

TEST(Dither, HasEveryThresholdOnceATileAndIsBlue) {
  std::vector<int> seen(1024, 0);
  double neighbours = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const float t = dither_threshold(x, y, 0);
      ++seen[size_t(t * 1024)];
      EXPECT_EQ(dither_threshold(x + 32, y + 64, 0), t);
      neighbours += double(std::abs(t - dither_threshold(x + 1, y, 0)));
    }
  for (int count : seen) EXPECT_EQ(count, 1);
  EXPECT_GT(neighbours / 1024, 0.37);  // 1/3 for white noise
}

TEST(Attributes, GoThroughTextAndBack) {
  const Attributes attributes{{"a", 1},
                              {"b", -5},
                              {"c", 1.0},
                              {"d", 1e-300},
                              {"e", 0.1},
                              {"f", std::string()},
                              {"g", std::string("x = \"y\"\n\\n\\")},
                              {"h", std::string("7")},
                              {"i", 1e21}};
  EXPECT_EQ(attributes_from_text(to_text(attributes)), attributes);
  EXPECT_EQ(attributes_from_text("made by hand\n = 3\nx = \nq = 2\nbroken = \"no end\n"), (Attributes{{"q", 2}}));
}

// Both writers must fail, say so, keep the old file and leave nothing beside it.
void expect_failure_that_keeps(const fs::path& folder, const std::function<void(const Image&)>& under_fault) {
  const std::string good_exr = read_bytes(folder / "a.exr"), good_png = read_bytes(folder / "a.png");
  const Image image = noise(256, 256, 3, 1);
  under_fault(image);
  EXPECT_TRUE(read_bytes(folder / "a.exr") == good_exr);
  EXPECT_TRUE(read_bytes(folder / "a.png") == good_png);
  EXPECT_EQ(files_in(folder), 2);
}

void write_small(const fs::path& folder) {
  const Image image = noise(4, 4, 3, 1);
  write_exr(folder / "a.exr", {layer("", {"R", "G", "B"}, true, image)}, {}, ap1_chromaticities);
  write_display_image(folder / "a.png", image);
}

void expect_both_fail(const fs::path& folder, const Image& image) {
  EXPECT_THROW(write_exr(folder / "a.exr", {layer("", {"R", "G", "B"}, false, image)}, {}, ap1_chromaticities),
               OperationError);
  EXPECT_THROW(write_display_image(folder / "a.png", image), OperationError);
}

TEST(WriteFiles, KeepTheOldFileWhereTheSizeLimitStopsThem) {
  const ScratchFolder folder;
  write_small(folder.path);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  expect_failure_that_keeps(folder.path, [&](const Image& image) {
    rlimit small = old;
    small.rlim_cur = 20000;
    setrlimit(RLIMIT_FSIZE, &small);
    expect_both_fail(folder.path, image);
    setrlimit(RLIMIT_FSIZE, &old);
  });
  std::signal(SIGXFSZ, handler);
}

TEST(WriteFiles, KeepTheOldFileOnAFullDisk) {
  const ScratchFolder folder;
  if (mount("tmpfs", folder.path.c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "a file system of 64 KiB cannot be mounted here: " << std::strerror(errno);
  write_small(folder.path);
  expect_failure_that_keeps(folder.path, [&](const Image& image) { expect_both_fail(folder.path, image); });
  umount(folder.path.c_str());
}

TEST(WriteFiles, RefuseAFolderThatCannotBeWritten) {
  const Image image = noise(4, 4, 3, 1);
  EXPECT_THROW(write_display_image("/proc/no/a.png", image), OperationError);
  const ScratchFolder folder;
  fs::create_directory(folder.path / "a.png");
  EXPECT_THROW(write_display_image(folder.path / "a.png", image), OperationError);
}

}  // namespace
}  // namespace sateen
