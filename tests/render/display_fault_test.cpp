#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "image/scratch_folder.h"
#include "render/picture.h"

namespace sateen_test {
namespace {

using namespace sateen;

std::string fault_of(const std::string& transform) {
  const ScratchFolder folder;
  const std::string path = (folder.path / "a.ocio").string();
  std::ofstream(path) << "ocio_profile_version: 1\nroles: {scene_linear: lin, default: lin, lin_rec709: lin}\n"
                         "displays:\n  sRGB:\n    - !<View> {name: Film, colorspace: screen}\n"
                         "colorspaces:\n  - !<ColorSpace> {name: lin}\n"
                         "  - !<ColorSpace>\n    name: screen\n    from_reference: "
                      << transform << "\n";
  const ColorManager colors(path);
  return display_fault(settle_display({}, colors), colors);
}

std::string matrix(const char* diagonal) {
  return fmt::format("!<MatrixTransform> {{matrix: [{0}, 0, 0, 0, 0, {0}, 0, 0, 0, 0, {0}, 0, 0, 0, 0, 1]}}",
                     diagonal);
}

TEST(DisplayFault, IsAViewThatShowsEveryGreyAsOne) {
  for (const char* diagonal : {".nan", "0", "1e38"})
    EXPECT_NE(fault_of(matrix(diagonal)).find("the view Film of the display sRGB gives every grey"),
              std::string::npos)
        << diagonal;
  EXPECT_NE(
      fault_of("!<MatrixTransform> {matrix: [.nan, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}").find("(red 0)"),
      std::string::npos);
  EXPECT_EQ(fault_of(matrix("0.5")), "");
  EXPECT_EQ(fault_of(matrix("8")), "");
  EXPECT_EQ(fault_of("!<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}"), "");
  const ColorManager colors("built-in");
  for (const std::string& display : colors.displays())
    for (const std::string& view : colors.views(display))
      EXPECT_EQ(display_fault({display, view, {}, {}, false}, colors), "") << display << " " << view;
}

}  // namespace
}  // namespace sateen_test
