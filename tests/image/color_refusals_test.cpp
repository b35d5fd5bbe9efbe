#include <gtest/gtest.h>

#include "base/error.h"
#include "image/color.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

// What is no config is told in words about the file and not about the parser.

namespace sateen {
namespace {

std::string refusal(const std::string& text) {
  const sateen_test::ScratchFolder folder;
  const auto path = folder.path / "a.ocio";
  sateen_test::write_bytes(path, text);
  try {
    const ColorManager colors(path.string());
    return "(taken)";
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
    return error.what();
  }
}

const std::string rest =
    "displays:\n  sRGB:\n    - !<View> {name: Raw, colorspace: lin}\ncolorspaces:\n  - !<ColorSpace> {name: lin}\n";
const std::string roles = "roles: {scene_linear: lin, default: lin, lin_rec709: lin}\n";

TEST(ColorRefusals, SayWhatTheFileLacks) {
  const auto expect = [](const std::string& text, const std::string& part) {
    const std::string said = refusal(text);
    EXPECT_NE(said.find(part), std::string::npos) << said;
    for (const char* jargon : {"stoi", "operator[]", "yaml-cpp", "<null>", "Loading the OCIO profile"})
      EXPECT_EQ(said.find(jargon), std::string::npos) << said;
  };
  expect("", "is empty, expected a colour config");
  expect(" \n", "is empty, expected a colour config");
  expect("hello\n", "has no line ocio_profile_version");
  expect("ocio_profile_version: abc\n" + roles + rest, "its ocio_profile_version is abc, and OpenColorIO");
  expect("ocio_profile_version:\n" + roles + rest, "its ocio_profile_version is");
  expect("ocio_profile_version: 0\n" + roles + rest, "its ocio_profile_version is 0");
  expect("ocio_profile_version: 9.1\n" + roles + rest, "its ocio_profile_version is 9.1");
  expect("ocio_profile_version: 1\nroles: {scene_linear: lim}\n" + rest,
         "its role scene_linear names the colour space lim, which it does not define");
  expect("ocio_profile_version: 1\nroles: {scene_linear: lim}\n" + rest, "did you mean lin");
  expect("ocio_profile_version: 1\n" + roles + "\t" + rest, "a.ocio:3:");
  expect("ocio_profile_version: 1\n" + roles + rest + "  - !<ColorSpace> {name: lin}\n", "already defined)");
  EXPECT_EQ(refusal("ocio_profile_version: 1\n" + roles + rest), "(taken)");
  EXPECT_EQ(refusal("{\"ocio_profile_version\": \"2\", roles: {scene_linear: lin, default: lin, lin_rec709: lin}, "
                    "displays: {sRGB: [!<View> {name: Raw, colorspace: lin}]}, colorspaces: [!<ColorSpace> {name: "
                    "lin}]}"),
            "(taken)");
}

}  // namespace
}  // namespace sateen
