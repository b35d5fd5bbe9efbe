#include "measured_look.h"

#include <fmt/format.h>

#include <memory>

#include "base/parallel.h"
#include "image/color.h"
#include "scene/compile_cloth.h"

namespace sateen::app {

namespace {
// The linear space of a colour space with a curve.
std::string linear_space(const std::string& space) {
  if (space == "srgb_texture") return "lin_rec709";
  if (space == "acescct") return "acescg";
  return space;
}
}  // namespace

MeasuredLook measure_look(const Look& look, bool with_table, const std::string& ocio, const std::string& working) {
  MeasuredLook measured;
  measured.look = look;
  const auto warn = [&](const std::vector<std::string>& more) {
    measured.warnings.insert(measured.warnings.end(), more.begin(), more.end());
  };
  warn(look.weave.draft_warnings);
  measured.space = working.empty() ? linear_space(look.color_space) : working;
  std::unique_ptr<ColorManager> colors;  // made only where a colour needs it: reading a config takes its time
  const ToWorking convert = [&](const Color& value, const std::string& space) {
    if (space == measured.space) return same_space(value, space);
    if (!colors) colors = std::make_unique<ColorManager>(ocio, measured.space);
    return colors->to_working(value, space);
  };
  FabricParts parts;
  parts.table = with_table;
  parts.threads = thread_count(0);
  if (look.textures.empty() && look.pattern_look.empty()) {
    measured.fabric = compile_fabric(look, convert, parts);
    if (colors) warn(colors->warnings());
    return measured;
  }
  colors = std::make_unique<ColorManager>(ocio, measured.space);
  CompiledSide side = compile_side(look, *colors, parts);
  measured.fabric = std::move(side.fabric);
  warn(colors->warnings());
  warn(side.warnings);
  if (side.color_error >= 0.005f)
    measured.warnings.push_back(fmt::format(
        "{}: textures of color are solved for the means of the textures of numbers; where one of those is at the end "
        "of its range the cloth shows a colour that is off by up to {:.2f}",
        look.name, side.color_error));
  return measured;
}

}  // namespace sateen::app
