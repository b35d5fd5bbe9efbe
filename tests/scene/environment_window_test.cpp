#include <gtest/gtest.h>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/file.h"
#include "image/made_exr.h"
#include "image/scratch_folder.h"
#include "maps.h"
#include "scene/environment_file.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using sateen_test::make_map;
using sateen_test::ScratchFolder;
using sateen_test::write_map;

TEST(ReadEnvironment, TakesAWindowInAHugePictureWhereTheMapIsMadeSmallAndNamesTheFileWhereItHasNoRoom) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const fs::path path = folder.path / "a.exr";
  const sateen_test::MadePart ones = sateen_test::counted({"B", "G", "R"});
  sateen_test::write_made_exr(path, {ones}, {2000, 40000, 16, 8}, {0, 0, 1000000, 1000000});
  EnvironmentFileOptions options;
  options.width = 4;
  EXPECT_EQ(read_environment(path.string(), colors, options).width, 4);
  options.width = 0;
  EXPECT_THROW(read_environment(path.string(), colors, options), InputError);
  options.limits = image_limits_of(1e6);
  try {
    read_environment(path.string(), colors, options);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a.exr: error: its picture of 1000000 x 1000000 pixels takes more than"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("help: --map-size"), std::string::npos);
  }
  // Rows without pixels are passed over; what they add is black.
  const sateen_test::MadePart inside{
      {}, {{"B", [](int, int) { return 3.0f; }}, {"G", [](int, int) { return 2.0f; }}, {"R", [](int x, int) {
                                                                                          return float(x);
                                                                                        }}}};
  sateen_test::write_made_exr(path, {inside}, {8, 9, 16, 3}, {0, 0, 48, 24});
  for (const int width : {0, 12, 7}) {
    options.width = width;
    const Environment windowed = read_environment(path.string(), colors, options);
    write_map(folder.path / "b.exr",
              make_map(48, 24,
                       [](int x, int y) {
                         return x >= 8 && x < 24 && y >= 9 && y < 12 ? Color(float(x), 2, 3) : Color(0);
                       }),
              rec709_chromaticities);
    const Environment whole = read_environment((folder.path / "b.exr").string(), colors, options);
    ASSERT_EQ(windowed.height, whole.height);
    for (int y = 0; y < whole.height; ++y)
      for (int x = 0; x < whole.width; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(windowed.radiance_at(x, y)[c], whole.radiance_at(x, y)[c], 1e-5f) << x << " " << y;
  }
}

}  // namespace
}  // namespace sateen
