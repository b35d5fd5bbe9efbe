#include "image/plain_exr.h"

#include <gtest/gtest.h>

#include <cstring>

#include "base/files.h"
#include "image/oiio/functions.h"
#include "made_files.h"
#include "scratch_folder.h"

namespace sateen_test {
namespace {

using namespace sateen;
namespace fs = std::filesystem;

TEST(PlainExr, HasThePixelsAndTheInfoOfTheModule) {
  for (const char* name : {"studio_softboxes", "overcast", "low_sun", "three_light_rig"}) {
    const fs::path path = data_folder() / "envmaps" / (std::string(name) + ".exr");
    ImageFileInfo plain_info, info;
    const std::optional<Image> plain = read_plain_exr(path, {}, &plain_info);
    ASSERT_TRUE(plain) << name;
    const Image image = image_file_functions().read_pixels(path, {}, &info);
    ASSERT_EQ(plain->pixels.size(), image.pixels.size()) << name;
    EXPECT_EQ(std::memcmp(plain->pixels.data(), image.pixels.data(), image.pixels.size() * sizeof(float)), 0) << name;
    EXPECT_EQ(plain_info.width, info.width);
    EXPECT_EQ(plain_info.height, info.height);
    EXPECT_EQ(plain_info.channels, info.channels);
    EXPECT_EQ(plain_info.channel_names, info.channel_names) << name;
    EXPECT_EQ(plain_info.format, info.format);
    EXPECT_EQ(plain_info.pixel_type, info.pixel_type);
    EXPECT_EQ(plain_info.color_space, info.color_space);
    ASSERT_EQ(plain_info.chromaticities.has_value(), info.chromaticities.has_value()) << name;
    if (info.chromaticities) {
      EXPECT_EQ(std::memcmp(&*plain_info.chromaticities, &*info.chromaticities, sizeof *info.chromaticities), 0);
    }
  }
}

TEST(PlainExr, LeavesEverythingElseToTheModule) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.exr";
  const auto plain = [&](const ImageLimits& limits = {}) {
    return read_plain_exr(path, limits, nullptr).has_value();
  };
  EXPECT_FALSE(plain()) << "missing";
  write_windowed_exr(path, 8, 6, 0, 0, 8, 6);
  EXPECT_TRUE(plain());
  EXPECT_FALSE(plain({4, 1 << 20})) << "too large";
  const std::string bytes = read_bytes(path);
  write_bytes(path, bytes.substr(0, bytes.size() - 20));
  EXPECT_FALSE(plain()) << "cut short";
  write_windowed_exr(path, 8, 6, 1, 1, 4, 4);
  EXPECT_FALSE(plain()) << "a data window of its own";
  write_deep_exr(path, 4, 4);
  EXPECT_FALSE(plain()) << "deep";
  write_multipart_exr(path, 4, 4);
  EXPECT_FALSE(plain()) << "several parts";
  write_bytes(path, "not a picture");
  EXPECT_FALSE(plain());
}

}  // namespace
}  // namespace sateen_test
