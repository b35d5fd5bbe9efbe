#include "image/exr_texture.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "image/exr_light.h"
#include "image/made_exr.h"
#include "image/scratch_folder.h"

namespace sateen_test {
namespace {

using namespace sateen;

struct Made {
  ScratchFolder folder;
  std::filesystem::path path = folder.path / "a.exr";

  /// The first pixel, or the error.
  std::vector<float> pixel(const std::vector<MadePart>& parts, bool number, const std::string& layer = {}) {
    write_made_exr(path, parts);
    error.clear();
    doubt.clear();
    try {
      const ExrTexture texture = read_exr_texture(path, layer, number);
      doubt = texture.doubt;
      alpha = texture.info.alpha_channel;
      return {texture.image.pixels.begin(), texture.image.pixels.begin() + texture.image.channels};
    } catch (const InputError& e) {
      error = e.diagnostics[0].message + "; " + e.diagnostics[0].help;
      return {};
    }
  }
  std::string error, doubt;
  int alpha = -1;
};

using Pixel = std::vector<float>;

TEST(ExrTexture, TakesTheColoursThatALightWouldTakeAndTheirAlpha) {
  Made made;
  EXPECT_EQ(made.pixel({counted({"R", "G", "B"})}, false), (Pixel{1, 2, 3}));
  EXPECT_EQ(made.pixel({counted({"A", "B", "G", "R", "Z"})}, false), (Pixel{4, 3, 2, 1}));
  EXPECT_EQ(made.alpha, 3);
  EXPECT_EQ(made.pixel({counted({"AO.B", "AO.G", "AO.R", "B", "G", "R"})}, false), (Pixel{6, 5, 4}));
  EXPECT_EQ(made.pixel({counted({"A", "rgba.A", "rgba.B", "rgba.G", "rgba.R", "x.B", "x.G", "x.R"})}, false),
            (Pixel{5, 4, 3, 2}));
  EXPECT_EQ(made.pixel({counted({"R", "G", "B"}, "AO"), counted({"B", "G", "R"}, "rgba")}, false), (Pixel{3, 2, 1}));
  EXPECT_EQ(made.pixel({counted({"Y"})}, false), Pixel{1});
  EXPECT_EQ(made.pixel({counted({"A", "Y"})}, false), (Pixel{2, 1}));
  EXPECT_EQ(made.alpha, 1);
  EXPECT_TRUE(made.doubt.empty());
  EXPECT_EQ(made.pixel({counted({"Z", "base.B", "base.G", "base.R"})}, false), (Pixel{4, 3, 2}));
  EXPECT_NE(made.doubt.find("base"), std::string::npos);
  EXPECT_EQ(made.pixel({counted({"X", "Y", "Z"})}, false), (Pixel{1, 2, 3}));
  EXPECT_TRUE(read_exr_texture(made.path, {}, false).xyz);
}

TEST(ExrTexture, RefusesWhatSaysNotWhichChannelsAreItsColourAndTakesTheOnesAskedFor) {
  Made made;
  const std::vector<MadePart> layers{counted({"AO.B", "AO.G", "AO.R", "base.B", "base.G", "base.R"})};
  made.pixel(layers, false);
  EXPECT_NE(made.error.find("AO (B, G, R), base (B, G, R); choose one by \"layer\""), std::string::npos)
      << made.error;
  EXPECT_EQ(made.pixel(layers, false, "base"), (Pixel{6, 5, 4}));
  EXPECT_EQ(made.pixel(layers, false, "AO.G"), Pixel{2});
  made.pixel(layers, false, "bas");
  EXPECT_NE(made.error.find("has no layer \"bas\""), std::string::npos) << made.error;
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"G", "R"}, {"Z"}, {"A"}, {"N.X", "N.Y", "N.Z"}, {"mask"}, {"A", "Z"}}) {
    made.pixel({counted(names)}, false);
    EXPECT_NE(made.error.find("does not say which of its layers is the colour"), std::string::npos) << names[0];
    EXPECT_EQ(made.error.empty(), [&] {  // the same verdict as of a light
      try {
        open_exr_light(made.path);
        return true;
      } catch (const InputError&) {
        return false;
      }
    }()) << names[0];
  }
}

TEST(ExrTexture, TakesANumberFromTheOnlyChannelYOrR) {
  Made made;
  for (const char* name : {"Z", "A", "mask", "Y", "wear.amount"})
    EXPECT_EQ(made.pixel({counted({name})}, true), Pixel{1}) << name;
  EXPECT_EQ(made.pixel({counted({"A", "mask"})}, true), (Pixel{2, 1}));
  EXPECT_EQ(made.pixel({counted({"A", "B", "G", "R"})}, true), (Pixel{4, 1}));
  EXPECT_EQ(made.pixel({counted({"A", "Y"})}, true), (Pixel{2, 1}));
  EXPECT_EQ(made.pixel({counted({"G", "R"})}, true), Pixel{2});
  EXPECT_FALSE(made.doubt.empty());
  EXPECT_EQ(made.pixel({counted({"A", "gloss", "wear"})}, true, "wear"), Pixel{3});
  EXPECT_EQ(made.alpha, -1);
  made.pixel({counted({"gloss", "wear"})}, true);
  EXPECT_NE(made.error.find("which of its layers is the number"), std::string::npos) << made.error;
  made.pixel({counted({"X", "Y", "Z"})}, true);
  EXPECT_FALSE(made.error.empty());
}

TEST(ExrTexture, DoesNotTakeNamesOfObjectsUnlessAskedTo) {
  Made made;
  const MadePart ids{{}, {{"id", [](int, int) { return 7.0f; }, MadeType::uint}}};
  made.pixel({ids}, true);
  EXPECT_NE(made.error.find("holds integers"), std::string::npos) << made.error;
  EXPECT_EQ(made.pixel({ids}, true, "id"), Pixel{7});
}

}  // namespace
}  // namespace sateen_test
