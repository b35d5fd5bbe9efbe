#include "stage_flags.h"

#include <fmt/format.h>

#include "base/nearest_name.h"
#include "look/json.h"
#include "picture_flags.h"

namespace sateen::app {

void add_stage_flags(Command& c, StageFlags& f) {
  c.group("Stage");
  c.choice("--ground", f.ground, ground_names(),
           "catcher: unseen, keeps the cloth's shadow in the alpha; floor: a matte plane; cyclorama: a floor that "
           "sweeps up into a wall behind the object (default: none)");
  c.custom(
      "--ground-height", "Y", 1, 1,
      [&f](const auto& w) { f.height = float(read_number("--ground-height", w.back(), -1e6, 1e6)); },
      "in the mesh's units (default: just below the object's lowest point)");
  c.custom(
      "--ground-color", "R,G,B", 1, 1,
      [&f](const auto& w) { f.color = read_color("--ground-color", w.back(), 0, 1); },
      "its reflectance, working space (default: 0.4,0.4,0.4)");
  c.number("--f-stop", "N", f.f_stop, 0.1, 1000,
           "depth of field of a lens before a sensor 36 mm wide (default: none)");
  c.text("--focus", "auto|METRES", f.focus,
         "distance that is sharp (default: auto, the cloth in the middle of the picture, else the object's middle)");
  c.integer("--blades", "N", f.lens.blades, 3, 32, "of the aperture (default: round)");
  c.number("--metres-per-unit", "X", f.lens.metres_per_unit, 1e-6, 1e6,
           "of the mesh, for --f-stop and --focus: 0.01 for centimetres (default: 1)");
  c.flag("--references", f.references,
         "lays a grey ball (18 %), a chrome ball and a colour chart under the same light over the lower left corner");
}

void add_shutter_flag(Command& c, StageSettings& stage) {
  c.number("--shutter", "DEG", stage.shutter_deg, -360, 360,
           "motion blur: turns the object by that angle while the shutter is open (default: 0)");
}

void settle_stage_flags(const Command& c, const StageFlags& f, StageSettings& stage) {
  const auto wants = [&](const char* part, const char* whole, const char* remedy) {
    if (c.given(part) && !c.given(whole)) throw InputError(fmt::format("{} wants {}", part, whole), remedy);
  };
  for (const char* part : {"--ground-height", "--ground-color"}) wants(part, "--ground", "such as --ground floor");
  for (const char* part : {"--focus", "--blades", "--metres-per-unit"})
    wants(part, "--f-stop", "such as --f-stop 2.8");
  for (size_t i = 1; i < ground_names().size(); ++i)
    if (f.ground == ground_names()[i]) stage.ground = GroundSettings{GroundKind(i - 1), f.height, f.color};
  if (f.f_stop <= 0) return;
  stage.lens = f.lens;
  stage.lens->f_stop = f.f_stop;
  if (f.focus != "auto") {
    if (f.focus.find_first_of("0123456789") == std::string::npos)
      throw InputError(fmt::format("--focus is {}, expected auto or a distance in metres", shown_name(f.focus)));
    stage.lens->focus = float(read_number("--focus", f.focus, 1e-6, 1e9));
  }
}

Color read_color(const std::string& what, const std::string& text, double low, double high) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3)
    throw InputError(fmt::format("{} is {}, expected three numbers such as 0.4,0.4,0.4", what, shown_name(text)));
  Color color;
  for (int i = 0; i < 3; ++i) color[i] = float(read_number(what, parts[size_t(i)], low, high));
  return color;
}

void read_backdrop(const std::string& text, SceneSettings& scene, std::optional<Color>& display_ground) {
  scene.backdrop = Backdrop::none;
  display_ground.reset();
  if (text == "none") return;
  const std::string word = text.substr(0, text.find(':'));
  if (text == "environment") {
    scene.backdrop = Backdrop::environment;
  } else if (word == "blurred") {
    scene.backdrop = Backdrop::blurred;
    if (word.size() < text.size())
      scene.stage.backdrop_blur_deg = float(read_number("--backdrop blurred", text.substr(word.size() + 1), 2, 180));
  } else if (text[0] == '#') {
    display_ground = read_hex_color("--backdrop", text);
  } else if (split(text, ',').size() == 3) {
    scene.backdrop = Backdrop::plain;
    scene.backdrop_color = read_color("--backdrop", text, 0, 1e6);
  } else {
    const std::string near = nearest_name(word, {"none", "environment", "blurred"});
    throw InputError(
        fmt::format("--backdrop is {}, expected none, environment, blurred, blurred:DEG, #rrggbb or r,g,b",
                    shown_name(text)),
        near.empty() ? "#000000 is black, #ffffff white" : "did you mean " + near + "?");
  }
}

}  // namespace sateen::app
