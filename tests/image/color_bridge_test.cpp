#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/color.h"
#include "image/scratch_folder.h"

// Configs as people have them, made here: no interchange role, odd names, faults in parts that no picture uses.

namespace sateen {
namespace {

using sateen_test::ScratchFolder;
using Chromaticities = ColorManager::Chromaticities;

const Chromaticities display_p3{{0.68f, 0.32f}, {0.265f, 0.69f}, {0.15f, 0.06f}, {0.3127f, 0.329f}};
const Chromaticities odd{{0.66f, 0.31f}, {0.24f, 0.72f}, {0.14f, 0.05f}, {0.32168f, 0.33767f}};
const Chromaticities d50{{0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.3457f, 0.3585f}};

std::string matrix_text(const Matrix3& m) {
  std::string text = "!<MatrixTransform> {matrix: [";
  for (const auto& row : m) text += fmt::format("{:.9f}, {:.9f}, {:.9f}, 0, ", row[0], row[1], row[2]);
  return text + "0, 0, 0, 1]}";
}

struct SpaceText {
  std::string name, to_reference, more = {};
};

/// The reference is ACES2065-1, which no name tells; the first space is scene_linear.
std::string config_text(const std::vector<SpaceText>& spaces, const std::string& roles = {}, int version = 1,
                        const std::string& displays = "    - !<View> {name: Plain, colorspace: Screen}\n",
                        const std::string& active = "active_displays: [sRGB]\nactive_views: [Plain]\n") {
  std::string text = fmt::format(
      "ocio_profile_version: {0}\nsearch_path: .\nstrictparsing: true\nroles:\n  scene_linear: {1}\n  default: "
      "{1}\n{2}displays:\n  "
      "sRGB:\n{3}{4}"
      "colorspaces:\n",
      version, spaces[0].name, roles, displays, active);
  for (const SpaceText& space : spaces) {
    text += fmt::format("  - !<ColorSpace>\n    name: {}\n{}", space.name, space.more);
    if (space.more.find("isdata") == std::string::npos) text += "    isdata: false\n";
    if (!space.to_reference.empty()) text += "    to_reference: " + space.to_reference + "\n";
  }
  return text +
         "  - !<ColorSpace>\n    name: Screen\n    isdata: false\n"
         "    to_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1]}\n";
}

struct Configs {
  ScratchFolder folder;
  mutable int count = 0;

  std::string write(const std::string& text) const {
    const std::string path = (folder.path / fmt::format("{}.ocio", count++)).string();
    std::ofstream(path) << text;
    return path;
  }
  ColorManager read(const std::string& text, const std::string& working = {}) const {
    return ColorManager(write(text), working);
  }
};

SpaceText working(const Chromaticities& space) {
  return {"Work", matrix_text(to_aces2065_1(space))};
}

Color applied(const Matrix3& m, const Color& c) {
  Color r;
  for (size_t i = 0; i < 3; ++i)
    r[int(i)] = float(m[i][0] * double(c.x) + m[i][1] * double(c.y) + m[i][2] * double(c.z));
  return r;
}

void expect_joined(const ColorManager& colors, const Chromaticities& space) {
  SCOPED_TRACE(colors.description());
  EXPECT_TRUE(colors.warnings().empty()) << colors.warnings().front();
  const Matrix3 from_aces = inverse(to_aces2065_1(space));
  const Color color(0.2f, 0.5f, 0.9f);
  for (const auto& [name, own] : {std::pair("lin_rec709", rec709_chromaticities),
                                  {"acescg", ap1_chromaticities},
                                  {"aces2065-1", ap0_chromaticities}}) {
    const Color expected = applied(multiply(from_aces, to_aces2065_1(own)), color);
    const Color found = colors.to_working(color, name);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 1e-3f) << name << " " << c;
  }
  // What an EXR says of its primaries is the light of its pixels.
  const auto said = colors.working_chromaticities();
  ASSERT_TRUE(said.has_value());
  const Matrix3 wanted = to_aces2065_1(space), found = to_aces2065_1(*said);
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) EXPECT_NEAR(found[i][j], wanted[i][j], 3e-3);
}

TEST(ColorBridge, IsASpaceOfAKnownNameWhateverTheWorkingSpaceIs) {
  const Configs configs;
  const Matrix3 one{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::pair<std::vector<const char*>, Matrix3> known[] = {
      {{"ACES2065-1", "ACES - ACES2065-1", "lin_ap0", "aces2065-1", "LIN_AP0", "lin_ap0_scene", "ACES/ACES2065-1",
        "Linear ACES", "ACES"},
       one},
      {{"ACEScg", "ACES - ACEScg", "lin_ap1", "ACESCG", "acescg", "lin_ap1_scene", "ACES/ACEScg", "Utility/ACEScg",
        "Linear ACEScg", "ocio:lin_ap1_scene"},
       to_aces2065_1(ap1_chromaticities)},
      {{"lin_rec709", "Utility - Linear - sRGB", "Utility - Linear - Rec.709", "Linear Rec.709 (sRGB)", "lin_srgb",
        "Linear Rec.709", "lin_rec709_scene", "scene-linear Rec.709-sRGB", "Utility/Linear Rec.709 (sRGB)"},
       to_aces2065_1(rec709_chromaticities)},
      {{"XYZ", "CIE XYZ D65", "CIE-XYZ-D65", "Linear CIE-XYZ D65", "cie_xyz_d65"},
       xyz_to_aces2065_1({0.95046, 1, 1.08906})},
      {{"Utility - XYZ - D60", "xyz"}, xyz_to_aces2065_1({0.95265, 1, 1.00883})},
      {{"XYZ", "Linear CIE-XYZ E"}, xyz_to_aces2065_1({1, 1, 1})}};
  for (const Chromaticities& space : {ap1_chromaticities, rec709_chromaticities, display_p3, odd})
    for (const auto& [names, to_reference] : known)
      for (const char* name : names)
        expect_joined(configs.read(config_text({working(space), {name, matrix_text(to_reference)}})), space);
}

TEST(ColorBridge, MayBeTheWorkingSpaceItselfAnAliasARoleOrAnInactiveSpace) {
  const Configs configs;
  const std::string ap1 = matrix_text(to_aces2065_1(ap1_chromaticities));
  expect_joined(configs.read(config_text({{"ACES - ACEScg", ap1}})), ap1_chromaticities);
  expect_joined(configs.read(config_text({working(odd), {"Q", ap1, "    aliases: [q, LIN_ap1]\n"}}, "", 2)), odd);
  expect_joined(configs.read(config_text({working(odd), {"Q", ap1}}, "  acescg: Q\n")), odd);
  expect_joined(configs.read(config_text({working(rec709_chromaticities)}, "  lin_rec709: Work\n")),
                rec709_chromaticities);
  expect_joined(configs.read(config_text({working(odd), {"lin_ap1", ap1}}, "", 2,
                                         "    - !<View> {name: Plain, colorspace: Screen}\n",
                                         "inactive_colorspaces: [lin_ap1]\n")),
                odd);
}

TEST(ColorBridge, IsAssumedAloudWhereNothingIsKnownAndThenNoPrimariesAreWritten) {
  const Configs configs;
  const std::string curve = "!<ExponentTransform> {value: [2.2, 2.2, 2.2, 1]}";
  // Names that only seem to be known: a curve, data, another space.
  for (const SpaceText& decoy : {SpaceText{"Camera", matrix_text(to_aces2065_1(odd))},
                                 {"ACEScg", curve},
                                 {"Output - ACES", curve},
                                 {"XYZ", curve},
                                 {"ACEScct", curve},
                                 {"lin_ap1", "", "    isdata: true\n"},
                                 {"Utility - sRGB - Texture", curve},
                                 {"Linear", matrix_text(to_aces2065_1(d50))}}) {
    const std::string text = config_text({working(odd), decoy});
    const ColorManager colors = configs.read(text);
    ASSERT_EQ(colors.warnings().size(), 1u) << decoy.name;
    for (const char* word : {"Work", "assumed", "Rec.709", "aces_interchange: NAME", "lin_rec709: Work"})
      EXPECT_NE(colors.warnings()[0].find(word), std::string::npos) << colors.warnings()[0];
    EXPECT_FALSE(colors.working_chromaticities().has_value()) << decoy.name;
    EXPECT_TRUE(configs.read(text, "lin_rec709").working_chromaticities().has_value()) << "pixels of a known space";
  }
}

TEST(ColorBridge, TellsOfSpacesThatContradictEachOther) {
  const Configs configs;
  const std::string ap1 = matrix_text(to_aces2065_1(ap1_chromaticities));
  // Called Rec.709 and in truth the reference.
  const ColorManager colors = configs.read(config_text({{"ACEScg", ap1}, {"lin_rec709", ""}}));
  ASSERT_EQ(colors.warnings().size(), 1u);
  for (const char* word : {"ACEScg", "lin_rec709", "contradicts"})
    EXPECT_NE(colors.warnings()[0].find(word), std::string::npos) << colors.warnings()[0];
  EXPECT_EQ(configs.read(config_text({{"Work", ap1}, {"Q", ap1}}, "  aces_interchange: Work\n  acescg: Q\n"))
                .warnings()
                .size(),
            1u)
      << "the role says that AP1 is ACES2065-1";
}

TEST(ColorBridge, GoesByAnotherSpaceWhereTheFirstNeedsAFileThatIsMissing) {
  const Configs configs;
  const SpaceText broken{"Far", "!<FileTransform> {src: gone.spimtx}"};
  const SpaceText ap1{"ACEScg", matrix_text(to_aces2065_1(ap1_chromaticities))};
  expect_joined(configs.read(config_text({working(odd), broken, ap1}, "  aces_interchange: Far\n")), odd);
  try {
    configs.read(config_text({working(odd), broken}, "  aces_interchange: Far\n"));
    FAIL() << "nothing joins it";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("gone.spimtx"), std::string::npos) << error.what();
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
  }
}

TEST(ColorBridge, ReadsOneLightInOneWayByNameAndByChromaticities) {
  const Configs configs;
  // Rec.709 as configs have it that adapt white by other means: here not at all but for the white itself.
  Matrix3 other = to_aces2065_1(rec709_chromaticities);
  other[0][0] += 0.006, other[0][2] -= 0.006, other[1][1] -= 0.004, other[1][2] += 0.004;
  const std::string ap1 = matrix_text(to_aces2065_1(ap1_chromaticities));
  const std::vector<std::string> texts{
      config_text({{"ACES - ACEScg", ap1}, {"lin_rec709", matrix_text(other)}}),
      config_text({{"ACES - ACEScg", ap1}, {"lin_rec709", matrix_text(other)}, {"ACES2065-1", ""}},
                  "  aces_interchange: ACES2065-1\n"),
      config_text({{"ACEScg", ap1}}),
      config_text({working(odd), {"lin_rec709", matrix_text(other)}}),
      config_text({working(odd)}),
      config_text({{"ACEScg", ap1}, {"lin_rec709", ""}})};  // contradicting itself
  for (const std::string& text : texts) {
    const ColorManager colors = configs.read(text);
    SCOPED_TRACE(colors.description());
    Image by_name(1, 1, 3);
    by_name.pixels = {0.2f, 0.5f, 0.9f};
    Image by_numbers = by_name;
    colors.to_working(by_name, "lin_rec709");
    colors.chromaticities_to_working(by_numbers, rec709_chromaticities);
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(by_numbers.pixels[c], by_name.pixels[c], 1e-4f);
  }
}

TEST(ColorConfig, IsUsedWithAWarningWhereAPartIsFaultyThatNoPictureUses) {
  const Configs configs;
  const std::string plain = "    - !<View> {name: Plain, colorspace: Screen}\n";
  const std::vector<SpaceText> spaces{{"ACEScg", matrix_text(to_aces2065_1(ap1_chromaticities))}};
  const std::pair<std::string, const char*> faulty[] = {
      {config_text(spaces, "", 1, plain, "active_displays: [sRGB, None]\n"), "None"},
      {config_text(spaces, "", 1, plain, "active_displays: [Gone, sRGB]\nactive_views: [Plain]\n"), "Gone"},
      {config_text(spaces, "  data: Non-Color\n"), "Non-Color"},
      {config_text(spaces, "  color_picking: nowhere\n  texture_paint: nor here\n"), "nowhere"},
      {config_text(spaces, "", 1, plain + "    - !<View> {name: Other, colorspace: undefined}\n", ""), "undefined"},
      {config_text(spaces, "", 1, plain + "    - !<View> {name: Other, colorspace: Screen, looks: unheard}\n", ""),
       "unheard"}};
  for (const auto& [text, word] : faulty) {
    const ColorManager colors = configs.read(text);
    ASSERT_EQ(colors.warnings().size(), 1u) << word;
    EXPECT_NE(colors.warnings()[0].find(word), std::string::npos) << colors.warnings()[0];
    EXPECT_EQ(colors.default_display(), "sRGB");
    Image image(1, 1, 3);
    EXPECT_NO_THROW(colors.to_display(image, "sRGB", "Plain", 0)) << word;
  }
  EXPECT_NO_THROW(configs.read(config_text(spaces, "", 1, plain, "active_views: [Plain, No View]\n")));
  // What is used fails, and says where.
  for (const auto& [text, word] : {faulty[4], faulty[5]}) try {
      Image image(1, 1, 3);
      configs.read(text).to_display(image, "sRGB", "Other", 0);
      FAIL() << word;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("the view Other of the display sRGB"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

TEST(ColorConfig, OfLaxParsingDoesNotTakeItsDefaultForANameThatItLacks) {
  const Configs configs;
  std::string text = config_text({{"ACEScg", matrix_text(to_aces2065_1(ap1_chromaticities))}});
  text.replace(text.find("strictparsing: true"), 19, "strictparsing: false");
  const ColorManager colors = configs.read(text);
  expect_joined(colors, ap1_chromaticities);
  EXPECT_FALSE(colors.has_space("lin_rec708"));
  EXPECT_THROW(colors.to_working(Color(1, 1, 1), "lin_rec708"), InputError);
}

TEST(ColorConfig, NamesTheFileAndTheViewWhereALutIsMissing) {
  const Configs configs;
  const ColorManager colors = configs.read(config_text(
      {{"ACEScg", matrix_text(to_aces2065_1(ap1_chromaticities))}, {"Film", "!<FileTransform> {src: film.cube}"}}, "",
      1, "    - !<View> {name: Film, colorspace: Film}\n    - !<View> {name: Plain, colorspace: Screen}\n", ""));
  Image image(1, 1, 3);
  EXPECT_NO_THROW(colors.to_display(image, "sRGB", "Plain", 0));
  try {
    colors.to_display(image, "sRGB", "Film", 0);
    FAIL();
  } catch (const InputError& error) {
    for (const char* word : {"film.cube", "the view Film of the display sRGB"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
  }
}

TEST(ColorConfig, SaysWhatItLacksAndWhichLibraryItNeeds) {
  const Configs configs;
  const auto message = [](const std::string& path) -> std::string {
    try {
      ColorManager colors(path);
    } catch (const InputError& error) {
      EXPECT_EQ(error.kind, InputError::Kind::unreadable) << path;
      return error.what();
    }
    return "(no error)";
  };
  for (const char* name : {"ocio://default", "ocio://cg-config-v1.0.0_aces-v1.3_ocio-v2.1", "/x/pack.ocioz"}) {
    const std::string text = message(name);
    if (text == "(no error)") continue;  // a library that knows them
    for (const char* word : {name, "OpenColorIO 2.2", "this is 2."})
      EXPECT_NE(text.find(word), std::string::npos) << text;
    setenv("OCIO", name, 1);
    EXPECT_NE(message("").find("$OCIO"), std::string::npos);
    unsetenv("OCIO");
  }
  EXPECT_NE(message(configs.write("ocio_profile_version: 2.9\n")).find("2.9"), std::string::npos);
  std::string text = config_text({{"ACEScg", ""}});
  text.replace(text.find("scene_linear: ACEScg"), 20, "scene_linear: absent");
  EXPECT_NE(message(configs.write(text)).find("scene_linear"), std::string::npos);
  text.replace(text.find("scene_linear: absent"), 20, "rendering: ACEScg   ");
  EXPECT_NE(message(configs.write(text)).find("add the line"), std::string::npos) << message(configs.write(text));
}

}  // namespace
}  // namespace sateen
