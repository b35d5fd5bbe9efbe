#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "image/color.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

// Configs whose names lead back to themselves: OpenColorIO follows them until the stack is used up.

namespace sateen {
namespace {

using sateen_test::ScratchFolder;

struct Ring {
  const char* what;
  std::string spaces, rest;  ///< YAML behind the colour spaces' list and after it
  std::string ring;          ///< as the warning names it
};

std::string space(const std::string& name, const std::string& transform, const std::string& more = {}) {
  return fmt::format("  - !<ColorSpace>\n    name: {}\n{}    to_scene_reference: {}\n", name, more, transform);
}
std::string to(const std::string& src) {
  return fmt::format("!<ColorSpaceTransform> {{src: {}, dst: lin}}", src);
}

const std::vector<Ring>& rings() {
  static const std::vector<Ring> all{
      {"a space of itself", space("a", to("a")), "", "a -> a"},
      {"a space by its alias", space("a", to("other"), "    aliases: [other]\n"), "", "a -> a"},
      {"a space by a role", space("a", to("texture_paint")), "", "a -> a"},
      {"a space by a variable", space("a", to("$SHOT")), "", "a -> a"},
      {"the other direction", space("a", "!<MatrixTransform> {}\n    from_scene_reference: " + to("a")), "",
       "a -> a"},
      {"three spaces", space("a", to("b")) + space("b", to("c")) + space("c", to("a")), "", "a -> b -> c -> a"},
      {"groups within groups",
       space("a", "!<GroupTransform> {children: [!<MatrixTransform> {}, !<GroupTransform> {children: [" + to("b") +
                      "]}]}") +
           space("b", to("a")),
       "", "a -> b -> a"},
      {"a known name", space("ACEScg", to("ACEScg")), "", "ACEScg -> ACEScg"},
      {"a look", space("a", "!<LookTransform> {src: lin, dst: lin, looks: \"-warm | +cold\"}"),
       "looks:\n  - !<Look> {name: cold, process_space: lin, transform: " + to("a") + "}\n",
       "a -> the look cold -> a"},
      {"a look's process space", space("a", "!<LookTransform> {src: lin, dst: lin, looks: cold}"),
       "looks:\n  - !<Look> {name: cold, process_space: a, transform: !<MatrixTransform> {}}\n",
       "a -> the look cold -> a"},
      {"a view", space("a", "!<DisplayViewTransform> {src: lin, display: sRGB, view: Odd}"), "", "a -> a"},
      {"a named transform", space("a", "!<ColorSpaceTransform> {src: name, dst: lin}"),
       "named_transforms:\n  - !<NamedTransform> {name: name, transform: " + to("a") + "}\n",
       "a -> the named transform name -> a"},
  };
  return all;
}

std::string config_text(const Ring& ring) {
  return "ocio_profile_version: 2\nenvironment: {SHOT: a}\nsearch_path: .\nroles:\n  scene_linear: lin\n"
         "  default: lin\n  lin_rec709: lin\n  texture_paint: a\n"
         "displays:\n  sRGB:\n    - !<View> {name: Plain, colorspace: screen}\n"
         "    - !<View> {name: Odd, colorspace: a}\n"
         "active_displays: [sRGB]\nactive_views: [Plain, Odd]\n"
         "colorspaces:\n  - !<ColorSpace> {name: lin}\n"
         "  - !<ColorSpace>\n    name: screen\n    to_scene_reference: !<ExponentTransform> {value: 2.2}\n" +
         ring.spaces + ring.rest;
}

ColorManager with_config(const std::string& text) {
  const ScratchFolder folder;
  const auto path = folder.path / "ring.ocio";
  sateen_test::write_bytes(path, text);
  return ColorManager(path.string());
}

TEST(ColorRings, AreToldAndPassedOverWhereNoPictureUsesThem) {
  for (const Ring& ring : rings()) {
    SCOPED_TRACE(ring.what);
    const ColorManager colors = with_config(config_text(ring));
    std::string told;
    for (const std::string& warning : colors.warnings()) told += warning + "\n";
    EXPECT_NE(told.find("without end: " + ring.ring + ";"), std::string::npos) << told;
    Image image(1, 1, 3);
    image.pixels = {0.25f, 0.25f, 0.25f};
    colors.to_display(image, "sRGB", "Plain", 0);
    EXPECT_NEAR(image.pixels[0], std::pow(0.25f, 1 / 2.2f), 1e-4f);
  }
}

TEST(ColorRings, AreRefusedByNameWhereAPictureUsesThem) {
  for (const Ring& ring : rings()) {
    SCOPED_TRACE(ring.what);
    const ColorManager colors = with_config(config_text(ring));
    const std::string name = ring.ring.substr(0, ring.ring.find(' '));
    try {
      colors.to_working(Color(1, 1, 1), name);
      ADD_FAILURE() << "converted";
    } catch (const InputError& error) {
      EXPECT_EQ(error.kind, InputError::Kind::wrong);
      EXPECT_NE(error.diagnostics.at(0).message.find(ring.ring), std::string::npos)
          << error.diagnostics.at(0).message;
    }
    EXPECT_THROW(colors.from_working(Color(1, 1, 1), name), InputError);
    if (name != "a") continue;
    Image image(1, 1, 3);
    EXPECT_THROW(colors.to_display(image, "sRGB", "Odd", 0), InputError);
  }
}

TEST(ColorRings, OfAViewTransformAreRefusedWithTheView) {
  const ColorManager colors = with_config(
      "ocio_profile_version: 2\nroles:\n  scene_linear: lin\n  default: lin\n  lin_rec709: lin\n"
      "displays:\n  sRGB:\n    - !<View> {name: Film, view_transform: film, display_colorspace: screen}\n"
      "    - !<View> {name: Raw, colorspace: lin}\n"
      "view_transforms:\n  - !<ViewTransform>\n    name: film\n"
      "    from_scene_reference: !<ColorSpaceTransform> {src: lin, dst: screen}\n"
      "display_colorspaces:\n  - !<ColorSpace> {name: screen}\ncolorspaces:\n  - !<ColorSpace> {name: lin}\n");
  EXPECT_FALSE(colors.warnings().empty());
  Image image(1, 1, 3);
  EXPECT_NO_THROW(colors.to_display(image, "sRGB", "Raw", 0));
  try {
    colors.to_display(image, "sRGB", "Film", 0);
    ADD_FAILURE() << "shown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::wrong);
    EXPECT_NE(error.diagnostics.at(0).message.find("the view transform film -> the view transform film"),
              std::string::npos)
        << error.diagnostics.at(0).message;
  }
}

TEST(ColorRings, OfSceneLinearItselfAreRefusedAtOnce) {
  EXPECT_THROW(with_config("ocio_profile_version: 1\nroles: {scene_linear: a, default: a}\n"
                           "displays:\n  sRGB:\n    - !<View> {name: Film, colorspace: a}\n"
                           "colorspaces:\n  - !<ColorSpace> {name: a, to_reference: !<ColorSpaceTransform> "
                           "{src: b, dst: a}}\n  - !<ColorSpace> {name: b}\n"),
               InputError);
}

TEST(ColorRings, AreNotSeenWhereSpacesAreBuiltOnOneAnother) {
  Ring chain{"a chain", space("a", to("b")) + space("b", to("c")) + space("c", "!<MatrixTransform> {}"), "", ""};
  const ColorManager colors = with_config(config_text(chain));
  EXPECT_TRUE(colors.warnings().empty());
  EXPECT_NO_THROW(colors.to_working(Color(1, 1, 1), "a"));
}

TEST(ColorRings, ChainsThatForkAtEveryNameAreNotFollowed) {
  Ring fork{"a fork", "", "", ""};
  for (int i = 0; i < 40; ++i) {
    const std::string next = i < 39 ? fmt::format("s{}", i + 1) : "lin";
    fork.spaces +=
        space(i ? fmt::format("s{}", i) : "a", fmt::format("!<GroupTransform> {{children: [{0}, {0}]}}", to(next)));
  }
  const ColorManager colors = with_config(config_text(fork));
  EXPECT_FALSE(colors.warnings().empty());
  EXPECT_THROW(colors.to_working(Color(1, 1, 1), "a"), InputError);
}

}  // namespace
}  // namespace sateen
