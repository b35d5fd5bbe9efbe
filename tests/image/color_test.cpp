#include "image/color.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/scratch_folder.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using sateen_test::ScratchFolder;

Image pixel(float r, float g, float b) {
  Image image(1, 1, 3);
  image.pixels = {r, g, b};
  return image;
}

Color displayed(const ColorManager& colors, Image image, const std::string& view, float ev = 0,
                const std::string& display = "sRGB") {
  colors.to_display(image, display, view, ev);
  return Color(image.pixels[0], image.pixels[1], image.pixels[2]);
}

void expect_near(const Color& found, const Color& expected, float tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << "channel " << i;
}

// A config of the shape of Blender's: version 2.0, no file rules, its own names, Rec.709 working space.
std::string foreign_config(const std::string& interchange_role, const std::string& extra_space) {
  return "ocio_profile_version: 2\n"
         "roles:\n"
         "  scene_linear: Linear\n"
         "  default_byte: sRGB\n"
         "  default: Linear\n" +
         interchange_role +
         "displays:\n"
         "  Screen:\n"
         "    - !<View> {name: Plain, colorspace: sRGB}\n"
         "active_displays: [Screen]\n"
         "active_views: [Plain]\n"
         "colorspaces:\n"
         "  - !<ColorSpace>\n"
         "    name: Linear\n"
         "    encoding: scene-linear\n"
         "    isdata: false\n"
         "  - !<ColorSpace>\n"
         "    name: sRGB\n"
         "    isdata: false\n"
         "    from_reference: !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}\n" +
         extra_space;
}

// Linear Rec.709 to CIE XYZ (D65), IEC 61966-2-1, four digits more than printed there.
const std::string xyz_space =
    "  - !<ColorSpace>\n"
    "    name: XYZ\n"
    "    isdata: false\n"
    "    from_reference: !<MatrixTransform> {matrix: [0.4123908, 0.3575843, 0.1804808, 0, 0.2126390, 0.7151687, "
    "0.0721923, 0, 0.0193308, 0.1191948, 0.9505322, 0, 0, 0, 0, 1]}\n";

// ACES2065-1 as Blender's config gives it: through XYZ with Bradford from D65 to the ACES white, written out.
const std::string aces_space =
    "  - !<ColorSpace>\n"
    "    name: Linear ACES\n"
    "    isdata: false\n"
    "    from_reference: !<MatrixTransform> {matrix: [0.4396328, 0.3829887, 0.1773784, 0, 0.0897764, 0.8134392, "
    "0.0967844, 0, 0.0175411, 0.1115465, 0.8709124, 0, 0, 0, 0, 1]}\n";

TEST(ColorManager, GivesTheKnownValuesOfItsBuiltInConfig) {
  const ColorManager colors("built-in");
  EXPECT_EQ(colors.working_space(), "acescg");
  EXPECT_NEAR(displayed(colors, pixel(0.18f, 0.18f, 0.18f), "ACES SDR").x, 0.355954f, 2e-6f);
  EXPECT_NEAR(displayed(colors, pixel(0.18f, 0.18f, 0.18f), "Un-tone-mapped").x, 0.461356f, 2e-6f);
  EXPECT_NEAR(displayed(colors, pixel(0.18f, 0.18f, 0.18f), "Raw").x, 0.18f, 1e-7f);
  expect_near(colors.to_working(Color(1, 0, 0), "lin_rec709"), Color(0.613097f, 0.070194f, 0.020616f), 2e-6f);
}

TEST(ColorManager, ShowsGreyAsGreyOnBothDisplaysInEveryView) {
  const ColorManager colors("built-in");
  EXPECT_EQ(colors.displays(), (std::vector<std::string>{"sRGB", "Rec.1886 Rec.709"}));
  EXPECT_EQ(colors.default_display(), "sRGB");
  EXPECT_EQ(colors.default_view("sRGB"), "ACES SDR");
  for (const std::string& display : colors.displays()) {
    EXPECT_EQ(colors.views(display), (std::vector<std::string>{"ACES SDR", "Un-tone-mapped", "Raw"}));
    for (const std::string& view : colors.views(display)) {
      const Color c = displayed(colors, pixel(0.3f, 0.3f, 0.3f), view, 0, display);
      EXPECT_NEAR(c.x, c.y, 2e-4f) << display << " " << view;
      EXPECT_NEAR(c.z, c.y, 2e-4f) << display << " " << view;
    }
  }
  // Rec.1886: a plain power of 2.4.
  EXPECT_NEAR(displayed(colors, pixel(0.18f, 0.18f, 0.18f), "Un-tone-mapped", 0, "Rec.1886 Rec.709").x,
              std::pow(0.18f, 1 / 2.4f), 1e-4f);
}

TEST(ColorManager, DisplaysWithinZeroToOneWhateverComes) {
  const ColorManager colors("built-in");
  const float values[] = {
      -1, 0, 1e-30f, 1, 1e4f, 1e30f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
  for (const char* view : {"ACES SDR", "Un-tone-mapped", "Raw"})
    for (float r : values)
      for (float g : values) {
        const Color c = displayed(colors, pixel(r, g, 0.5f), view);
        for (int i = 0; i < 3; ++i) EXPECT_TRUE(c[i] >= 0 && c[i] <= 1) << view << " " << r << " " << g;
      }
}

TEST(ColorManager, ScalesByStopsBeforeTheViewAndLeavesAlpha) {
  const ColorManager colors("built-in");
  EXPECT_NEAR(displayed(colors, pixel(0.045f, 0.045f, 0.045f), "ACES SDR", 2).x, 0.355954f, 2e-6f);
  Image image(2, 1, 5);
  image.pixels = {0.18f, 0.18f, 0.18f, 0.25f, 7, 0.18f, 0.18f, 0.18f, -3, 1e9f};
  colors.to_display(image, "sRGB", "ACES SDR", 0);
  EXPECT_NEAR(image.pixels[5], 0.355954f, 2e-6f);
  EXPECT_EQ(image.pixels[3], 0.25f);
  EXPECT_EQ(image.pixels[4], 7);
  EXPECT_EQ(image.pixels[8], -3);
  EXPECT_EQ(image.pixels[9], 1e9f);
}

TEST(ColorManager, ConvertsThereAndBack) {
  for (const char* working : {"", "acescg", "lin_rec709", "aces2065-1"}) {
    const ColorManager colors("built-in", working);
    for (const char* space : {"lin_rec709", "acescg", "aces2065-1", "srgb_texture", "cie_xyz_d65"}) {
      const Color c(0.2f, 0.5f, 0.3f);
      expect_near(colors.from_working(colors.to_working(c, space), space), c, 2e-5f);
    }
  }
  const ColorManager colors("built-in", "lin_rec709");
  EXPECT_NEAR(colors.to_working(Color(0.5f, 0.5f, 0.5f), "srgb_texture").x, 0.214041f, 1e-5f);  // IEC 61966-2-1
}

TEST(ColorManager, KnowsTheLuminanceAndTheChromaticitiesOfItsWorkingSpace) {
  const ColorManager acescg("built-in"), rec709("built-in", "lin_rec709");
  expect_near(rec709.luminance_weights(), Color(0.212639f, 0.715169f, 0.072192f), 2e-5f);
  const Color y = acescg.luminance_weights();
  EXPECT_NEAR(y.x + y.y + y.z, 1, 1e-5f);
  const auto a = acescg.working_chromaticities().value(), r = rec709.working_chromaticities().value();
  EXPECT_EQ(a.red[0], 0.713f);
  EXPECT_EQ(a.white[0], 0.32168f);
  EXPECT_EQ(r.green[1], 0.6f);
  EXPECT_EQ(r.white[1], 0.3290f);
}

TEST(ColorManager, ConvertsByChromaticitiesAsItDoesByName) {
  const ColorManager colors("built-in");
  Image image = pixel(0.2f, 0.5f, 0.9f);
  colors.chromaticities_to_working(image, rec709_chromaticities);
  expect_near(Color(image.pixels[0], image.pixels[1], image.pixels[2]),
              colors.to_working(Color(0.2f, 0.5f, 0.9f), "lin_rec709"), 2e-5f);
  // White of any white stays white: Rec.709 primaries under D50, as some map makers write.
  ColorManager::Chromaticities d50 = rec709_chromaticities;
  d50.white[0] = 0.34567f;
  d50.white[1] = 0.35850f;
  image = pixel(1, 1, 1);
  colors.chromaticities_to_working(image, d50);
  expect_near(Color(image.pixels[0], image.pixels[1], image.pixels[2]), Color(1, 1, 1), 1e-5f);
}

TEST(ColorManager, RefusesChromaticitiesThatSpanNoSpace) {
  const ColorManager colors("built-in");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Image image = pixel(1, 1, 1);
  for (const ColorManager::Chromaticities& bad :
       {ColorManager::Chromaticities{{0, 0}, {0, 0}, {0, 0}, {0, 0}},
        ColorManager::Chromaticities{{0.6f, 0.3f}, {0.6f, 0.3f}, {0.1f, 0.1f}, {0.3127f, 0.329f}},
        ColorManager::Chromaticities{{0.6f, 0.3f}, {nan, 0.6f}, {0.1f, 0.1f}, {0.3127f, 0.329f}},
        ColorManager::Chromaticities{{0.6f, 0.3f}, {0.3f, 0.6f}, {0.1f, 0.1f}, {0.9f, 0.9f}}})
    EXPECT_THROW(colors.chromaticities_to_working(image, bad), InputError);
}

TEST(ColorManager, NamesTheNearestSpaceDisplayAndView) {
  const ColorManager colors("built-in");
  const auto message = [](auto&& call) -> std::string {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  Image image = pixel(1, 1, 1);
  EXPECT_NE(message([&] { colors.to_working(Color(1, 1, 1), "lin_rec708"); }).find("lin_rec709"), std::string::npos);
  EXPECT_NE(message([&] { colors.to_display(image, "sRBG", "ACES SDR", 0); }).find("sRGB"), std::string::npos);
  EXPECT_NE(message([&] { colors.to_display(image, "sRGB", "ACES SRD", 0); }).find("ACES SDR"), std::string::npos);
  EXPECT_NE(message([&] { ColorManager("built-in", "acesgc"); }).find("acescg"), std::string::npos);
  EXPECT_NE(message([&] { ColorManager("built-in", "srgb_texture"); }).find("not scene-linear"), std::string::npos);
}

TEST(ColorManager, FailsLoudlyForAMissingOrBrokenConfig) {
  const ScratchFolder folder;
  const auto kind = [](const std::string& path) {
    try {
      ColorManager colors(path);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
      return error.kind;
    }
    return InputError::Kind::wrong;
  };
  EXPECT_EQ(kind((folder.path / "none.ocio").string()), InputError::Kind::unreadable);
  EXPECT_EQ(kind(folder.path.string()), InputError::Kind::unreadable);
  int i = 0;
  for (const char* text :
       {"", "{", "ocio_profile_version: 9\n", "ocio_profile_version: 2\nroles:\n  scene_linear: none\n"}) {
    const fs::path path = folder.path / (std::to_string(i++) + ".ocio");
    std::ofstream(path) << text;
    EXPECT_EQ(kind(path.string()), InputError::Kind::unreadable) << text;
  }
}

TEST(ColorManager, ObeysTheEnvironmentVariableAndAFlagOverIt) {
  const ScratchFolder folder;
  const std::string missing = (folder.path / "missing.ocio").string();
  setenv("OCIO", missing.c_str(), 1);
  EXPECT_THROW(ColorManager(), InputError);
  EXPECT_NO_THROW(ColorManager("built-in"));
  const fs::path path = folder.path / "own.ocio";
  std::ofstream(path) << foreign_config("", "");
  setenv("OCIO", path.c_str(), 1);
  EXPECT_NE(ColorManager().description().find("$OCIO"), std::string::npos);
  unsetenv("OCIO");
  EXPECT_EQ(ColorManager().description(), "the built-in config");
}

// By its interchange role, by its XYZ space, and by the assumption that its scene_linear is Rec.709.
TEST(ColorManager, WorksWithForeignConfigsOfEveryShape) {
  const ScratchFolder folder;
  const ColorManager own("built-in", "lin_rec709");
  int i = 0;
  for (const std::string& text : {foreign_config("  aces_interchange: Linear ACES\n", aces_space),
                                  foreign_config("", xyz_space), foreign_config("", "")}) {
    const fs::path path = folder.path / (std::to_string(i++) + ".ocio");
    std::ofstream(path) << text;
    const ColorManager colors(path.string());
    SCOPED_TRACE(colors.description());
    EXPECT_EQ(colors.working_space(), "Linear");
    EXPECT_EQ(colors.default_display(), "Screen");
    EXPECT_TRUE(colors.has_space("lin_rec709"));
    EXPECT_FALSE(colors.space_of_file("map.exr").has_value());
    // The project's own names, which this config does not know.
    for (const char* space : {"lin_rec709", "acescg", "srgb_texture"})
      expect_near(colors.to_working(Color(0.2f, 0.5f, 0.9f), space), own.to_working(Color(0.2f, 0.5f, 0.9f), space),
                  2e-4f);
    expect_near(colors.to_working(Color(0.5f, 0.5f, 0.5f), "sRGB"), Color(0.214041f, 0.214041f, 0.214041f), 1e-5f);
    if (i < 3)
      EXPECT_EQ(colors.working_chromaticities().value().red[0], 0.64f);
    else
      EXPECT_FALSE(colors.working_chromaticities().has_value()) << "they are assumed";
    expect_near(colors.luminance_weights(), Color(0.212639f, 0.715169f, 0.072192f), 2e-4f);
    expect_near(displayed(colors, pixel(0.214041f, 0.214041f, 0.214041f), "Plain", 0, "Screen"),
                Color(0.5f, 0.5f, 0.5f), 1e-5f);
    // Our working space under their display.
    const ColorManager mixed(path.string(), "acescg");
    const Color red = own.from_working(Color(0.5f, 0.1f, 0.1f), "acescg");
    const Color shown = displayed(mixed, pixel(red.x, red.y, red.z), "Plain", 0, "Screen");
    expect_near(colors.to_working(shown, "sRGB"), Color(0.5f, 0.1f, 0.1f), 1e-3f);
  }
}

TEST(ColorManager, WorksWithTheConfigOfAnInstalledBlender) {
  std::string found;
  std::error_code code;
  for (fs::recursive_directory_iterator it("/usr/share/blender", code), end; !code && it != end; it.increment(code))
    if (it->path().filename() == "config.ocio") found = it->path().string();
  if (found.empty()) GTEST_SKIP() << "no Blender under /usr/share/blender";
  const ColorManager colors(found), own("built-in", "lin_rec709");
  expect_near(colors.to_working(Color(0.2f, 0.5f, 0.9f), "acescg"), own.to_working(Color(0.2f, 0.5f, 0.9f), "acescg"),
              2e-3f);
  Image image = pixel(0.18f, 0.18f, 0.18f);
  colors.to_display(image, colors.default_display(), colors.default_view(colors.default_display()), 0);
  EXPECT_GT(image.pixels[1], 0.3f);
  EXPECT_LT(image.pixels[1], 0.6f);
}

TEST(ColorManager, TakesAFileRuleOfTheConfigButNotItsDefault) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "rules.ocio";
  std::string text = foreign_config("", "");
  text.insert(text.find("displays:"),
              "file_rules:\n"
              "  - !<Rule> {name: Byte, colorspace: sRGB, pattern: \"*\", extension: \"png\"}\n"
              "  - !<Rule> {name: Default, colorspace: default}\n");
  std::ofstream(path) << text;
  const ColorManager colors(path.string());
  EXPECT_EQ(colors.space_of_file("x/map.png").value_or("none"), "sRGB");
  EXPECT_FALSE(colors.space_of_file("x/map.exr").has_value());
}

TEST(Chromaticities, AgreeWithThePublishedMatrices) {
  // SMPTE RP 177 for Rec.709; Academy TB-2014-004 for AP0 to XYZ.
  const Matrix3 rec709 = rgb_to_xyz(rec709_chromaticities), ap0 = rgb_to_xyz(ap0_chromaticities);
  EXPECT_NEAR(rec709[0][0], 0.4123908, 1e-6);
  EXPECT_NEAR(rec709[1][1], 0.7151687, 1e-6);
  EXPECT_NEAR(ap0[0][0], 0.9525523959, 1e-7);
  EXPECT_NEAR(ap0[1][0], 0.3439664498, 1e-7);
  EXPECT_NEAR(ap0[2][2], 1.0088251844, 1e-7);
  const Matrix3 one = multiply(rec709, inverse(rec709));
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(one[i][j], i == j, 1e-12);
}

TEST(Chromaticities, OfAnUnknownSpaceReproduceItsMatrix) {
  ColorManager::Chromaticities p3 = rec709_chromaticities;  // Display P3's primaries
  p3.red[0] = 0.68f, p3.red[1] = 0.32f, p3.green[0] = 0.265f, p3.green[1] = 0.69f;
  const Matrix3 m = to_aces2065_1(p3), again = to_aces2065_1(chromaticities_of(m));
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(again[i][j], m[i][j], 1e-5);
}

}  // namespace
}  // namespace sateen
