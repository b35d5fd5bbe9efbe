#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "command.h"
#include "commands.h"
#include "console.h"
#include "environment_text.h"
#include "exit_code.h"
#include "light_flags.h"
#include "look/json_writer.h"
#include "outputs.h"
#include "picture_report.h"
#include "render/picture.h"
#include "scene/environment_file.h"
#include "scene/environment_make.h"
#include "typed_values.h"

namespace sateen::app {

namespace {
int env_make(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  std::string output;
  int width = 0, height = 0;
  Command command("env make", "Makes an HDR map from a description of its lights.",
                  "DESCRIPTION.json -o MAP.exr [-r W H]");
  command.arguments("DESCRIPTION.json", names, 1, 1, "lights as JSON; those of the shipped maps are in envmaps/");
  command.text("-o,--output", "FILE.exr", output, "where to write it");
  command.phrase(
      "-r,--res", "W H", continues_size,
      [&](const std::string& text) {
        std::tie(width, height) = read_size("--res", text, 1, {16384, 8192});
      },
      "size in pixels (default: as described)");
  command.flag("--json", voice.json, "prints what was written as JSON");
  command.example("sateen env make my_studio.json -o my_studio.exr", "then: sateen render --env my_studio.exr");
  if (!command.parse(words)) return done;
  if (output.empty()) throw InputError("--output is missing", "-o my_map.exr");
  if (!is_exr(output)) throw InputError(fmt::format("--output is {}, expected a file that ends in .exr", output));
  check_picture_path(output);
  MapDescription description = read_map_description(names[0]);
  check_not_read({{"--output", output}});
  if (width > 0) description.width = width, description.height = height;
  const HalfRange range = write_made_environment(output, description);
  warn_of_half_floats(output, range, "");
  if (voice.json) {
    JsonWriter w;
    w.open_object().member("path", output).member("width", description.width).member("height", description.height);
    print_result(w.member("clamped", range.held).close().text());
  } else {
    print_note(
        fmt::format("wrote {}  {} x {}, {}", output, description.width, description.height, description.color_space));
  }
  return done;
}

int env_inspect(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  EnvironmentFileOptions options;
  std::string ocio, working;
  Command command("env inspect", "Prints what an HDR map holds: size, range, repairs, and where its light is.",
                  "MAP... [flags]");
  command.arguments("MAP", names, 1, 1000, "names or files");
  command.number("--env-rotate", "DEG", options.rotation_deg, -36000, 36000, "turns the light to the right");
  command.number("--env-exposure", "EV", options.exposure_ev, -100, 100, "brightens the light by stops");
  command.text("--env-space", "NAME", options.color_space, "colour space of the map (default: as the file says)");
  add_layer_flag(command, options.layer);
  command.integer("--map-size", "N", options.width, 0, 65536,
                  "shrinks a wider map to N texels across while it is read");
  add_image_limit(command);
  command.text("--ocio", "FILE", ocio, "colour config, or built-in (default: $OCIO, else built-in)");
  command.text("--working", "NAME", working, "space of the numbers (default: the config's scene_linear role)");
  command.flag("--json", voice.json, "the same as JSON");
  command.example("sateen env inspect studio_softboxes",
                  "azimuth 0 is the camera's side, 90 the right of the picture");
  if (!command.parse(words)) return done;
  options.limits = image_limits();
  const ColorManager colors(ocio, working);
  for (const std::string& warning : colors.warnings()) print_warning(warning);
  JsonWriter w;
  w.open_object().key("maps").open_list();
  std::string text;
  for (const std::string& name : names) {
    std::string space;
    const Environment map = read_environment(name, colors, options, &space);
    const EnvironmentReport report = inspect_environment(map);
    text += environment_text(find_environment(name).string(), space, report);
    write_environment(w, find_environment(name).string(), space, report);
  }
  print_result(voice.json ? w.close().close().text() : text);
  return done;
}

int env_list(const std::vector<std::string>& words) {
  Command command(
      "env list",
      "Lists the maps that are found by name: here, in SATEEN_PATH, the program's own, an installed Blender's.",
      "[--json]");
  command.flag("--json", voice.json, "the same as JSON, with paths");
  if (!command.parse(words)) return done;
  JsonWriter w;
  w.open_object().key("maps").open_list();
  std::string text;
  for (const std::string& name : environment_names()) {
    const std::string path = find_environment(name).string();
    text += fmt::format("{:<24}  {}\n", name, path);
    w.open_object().member("name", name).member("path", path).close();
  }
  w.close().close();
  print_result(voice.json ? w.text() : text);
  return done;
}
}  // namespace

const std::vector<Subcommand>& env_subcommands() {
  static const std::vector<Subcommand> all{
      {"list", "the maps that are found by name", env_list},
      {"inspect", "size, range, repairs, and where the light is", env_inspect},
      {"make", "a map from a description of its lights", env_make},
  };
  return all;
}

int run_env(const std::vector<std::string>& words) {
  return run_group("sateen env", "Lights: lat-long HDR maps around the scene.", env_subcommands(), words);
}

}  // namespace sateen::app
