#include "picture_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <tuple>

#include "base/nearest_name.h"
#include "console.h"
#include "light_flags.h"
#include "look/json.h"
#include "mesh/shapes.h"
#include "render/quality.h"
#include "typed_values.h"

namespace sateen::app {

namespace {
void add_scene(Command& c, PictureFlags& f) {
  SceneSettings& s = f.scene;
  c.group("Scene");
  c.text("-l,--look", "NAME|FILE", s.look,
         fmt::format("the cloth (default: {}); sateen look list shows all", s.look));
  c.texts("--set", "PATH=VALUE", s.look_overrides,
          "changes one field of the look, such as warp.gamma_s_deg=4; repeatable");
  std::string shapes;
  for (const std::string& shape : built_in_shapes()) shapes += (shapes.empty() ? "" : ", ") + shape;
  c.text("-m,--mesh", "NAME|FILE.obj", s.mesh, fmt::format("{}, or an OBJ (default: {})", shapes, s.mesh));
  c.choice("--up", s.up, {"y", "z"}, "the mesh's own axis that points upwards (default: y)");
  c.flag("--weld", s.weld, "joins borders of the mesh that coincide, such as sewn seams that were exported apart");
  c.custom(
      "--level", "N|auto", 1, 1,
      [&s](const auto& w) { s.level = w.back() == "auto" ? -1 : read_integer("--level", w.back(), 0, 6); },
      "subdivision, 0 to 6 (default: auto, until outlines and highlights show no facets)");
  c.number("--warp-angle", "DEG", s.warp_angle_deg, -360, 360, "turns the warp on the mesh");
  c.number(
      "--uv-metres", "M", s.uv_metres, 1e-6, 1e6,
      "cloth that one UV unit spans, by which threads are counted (default: built-in shapes 1, else taken as 1)");
  c.text("-e,--env", "NAME|FILE", s.environment,
         fmt::format("the light, a lat-long HDR map (default: {}); sateen env list shows all", s.environment));
  c.number("--env-rotate", "DEG", s.environment_rotation_deg, -36000, 36000, "turns the light to the right");
  c.number("--env-exposure", "EV", s.environment_ev, -100, 100, "brightens the light by stops");
  c.text("--env-space", "NAME", s.environment_space, "colour space of the map (default: as the file says)");
  add_layer_flag(c, s.environment_layer);
  add_image_limit(c);
  c.custom(
      "--backdrop", "none|environment|blurred[:DEG]|COLOUR", 1, 1,
      [&f](const auto& w) { read_backdrop(w.back(), f.scene, f.display.ground); },
      "behind the cloth. none: grey paper in display pictures, alpha in an EXR. #rrggbb: that colour on the display, "
      "alpha "
      "in an EXR. blurred: the light through a soft kernel of that width (20 degrees). r,g,b: light of that colour, "
      "working space");
}

void add_camera(Command& c, PictureFlags& f) {
  CameraSettings& k = f.scene.camera;
  c.group("Camera");
  c.phrase(
      "-r,--res", "W H", continues_size,
      [&f](const std::string& text) {
        std::tie(f.scene.width, f.scene.height) = read_size("--res", text, 1, {32768, 32768});
      },
      fmt::format("size in pixels (default: {} {})", f.scene.width, f.scene.height));
  c.number("--azimuth", "DEG", k.azimuth_deg, -36000, 36000, "walks to the right around the object");
  c.number("--elevation", "DEG", k.elevation_deg, -89, 89,
           fmt::format("above the horizon (default: {})", k.elevation_deg));
  c.number("--fov", "DEG", k.fov_deg, 1, 150, fmt::format("of the longer side (default: {})", k.fov_deg));
  c.number("--zoom", "X", k.zoom, 0.01, 1000, "above 1 comes closer than the framing");
  c.custom(
      "--crop", "X0 Y0 X1 Y1", 4, 4,
      [&f](const std::vector<std::string>& w) {
        int v[4];
        for (size_t i = 0; i < 4; ++i) v[i] = read_integer("--crop", w[i], 0, 32768);
        f.render.crop = {v[0], v[1], v[2], v[3]};
        if (v[2] <= v[0] || v[3] <= v[1])
          throw InputError(fmt::format("--crop {} {} {} {} is empty, expected X0 below X1 and Y0 below Y1", v[0],
                                       v[1], v[2], v[3]));
      },
      "renders and writes this window of the picture only, in pixels from the top left");
}

void add_quality(Command& c, PictureFlags& f) {
  StopRules& stop = f.render.stop;
  c.group("Quality (whichever is met first stops)");
  c.integer(
      "-s,--spp", "N", stop.spp, 1, 1 << 30,
      fmt::format("samples a pixel, with --adaptive their mean (default: {}, adaptive, when no other rule is given)",
                  default_samples));
  c.share("--error", "E", stop.error, 1e-6, 100,
          "relative error of the picture, such as 0.02 or 2%; its upper bound counts");
  c.text("--quality", "NAME", f.quality,
         "draft, preview or final: --error 0.18, 0.075 or 0.018, and the effects that such an error calls for; "
         "sateen cost finds what suits your scene");
  c.phrase(
      "--time", "T", continues_duration,
      [&stop](const std::string& text) { stop.seconds = read_duration("--time", text); },
      "wall clock of the whole program, setting up and writing included: 30, 30s, 2m, 1h30m, 2 min");
  c.flag("--adaptive", f.adaptive, "samples go where the error is (default but with --spp alone)");
  c.integer("--seed", "N", f.seed, 0, 0x7fffffff,
            "another seed is another noise, of the pilots that plan the picture, too (default: 1)");
  c.integer("-t,--threads", "N", f.render.threads, 0, 4096, "0: all that this process may use (default)");
  c.text("--strategy", "NAME", f.strategy,
         fmt::format("how light is sampled (default: {}): {}", strategy_name(f.render.light.strategy),
                     fmt::join(strategy_names(), ", ")));
  c.custom(
      "--candidates", "N|TABLE+MAP", 1, 1,
      [&f](const auto& w) { f.render.light.candidates = candidates_from_text(w.back()); },
      "directions that a point looks into for light, for resampled: N of each kind, or by the cloth's table and by "
      "the map, such as 4+16 (default: by a pilot on the scene)");
  c.integer("--bounces", "N", f.render.light.bounces, 0, 64,
            "how often light may meet cloth or ground again (default: as often as the error asked for calls for)");
  add_approximation_flags(c, f.scene.approximations);
  std::string names;
  for (const EffectInfo& info : effect_list())
    if (info.switchable) names += (names.empty() ? "" : ", ") + info.name;
  c.text(
      "--effects", "LIST", f.effects,
      fmt::format("auto, all, none, and changes such as +interreflection,-gaps (default: auto, see sateen plan): {}",
                  names));
  c.flag(
      "--verify-plan", f.verify_plan,
      "checks on some pixels what every effect that the plan rules out would change, and fails where it is too much");
  c.flag("--strict", f.strict, "exit code 5 when a sample was not finite");
}

void add_output(Command& c, PictureFlags& f) {
  c.group("Colour");
  c.custom(
      "--exposure", "EV|auto", 1, 1,
      [&f](const auto& w) {
        f.exposure_ev.reset();
        if (w.back() == "auto") return;
        if (w.back().find_first_of("0123456789") == std::string::npos)
          throw InputError(fmt::format("--exposure is {}, expected auto or a number of stops", shown_name(w.back())));
        f.exposure_ev = float(read_number("--exposure", w.back(), -100, 100));
      },
      "of display pictures; an EXR keeps the light as it is (default: auto, metered from the light)");
  c.text("--ocio", "FILE", f.ocio, "colour config, or built-in (default: $OCIO, else built-in)");
  c.text("--working", "NAME", f.working, "space to render in (default: the config's scene_linear role)");
  c.text("--display", "NAME", f.display.display,
         "what the picture will be shown on (default: the config's first, built-in: sRGB; or Rec.1886 Rec.709)");
  c.text(
      "--view", "NAME", f.display.view,
      "how light becomes display colour (default: the display's first, built-in: ACES SDR; or Un-tone-mapped, Raw)");
  c.flag("--transparent", f.display.transparent, "alpha instead of a backdrop in PNG and TIFF");

  c.group("Output");
  c.texts("-o,--output", "FILE", f.outputs, "repeatable; the extension picks the format: exr, png, jpg, tif");
  c.text("--aov", "LIST", f.layers,
         fmt::format("layers of an EXR beside the beauty: all, none, or of {}", fmt::join(layer_names(), ", ")));
  c.text("--stats", "FILE", f.stats, "writes what was done and how long it took, as JSON");
  c.flag("--timings", f.timings, "times go into the pictures, too: then no two files have the same bytes");
  c.flag("--json", voice.json, "prints the same JSON, and nothing else, on standard output");
  c.choice("--progress", f.progress_name, {"auto", "bar", "alf", "openjd", "json", "none"},
           "how progress is told (default: auto, a bar on a terminal and lines elsewhere)");
  c.flag("--dry-run", f.dry_run, "reads and checks everything, says what would be done, renders nothing");
  c.flag("-q,--quiet", f.quiet, "warnings and errors only");
  c.flag("-v,--verbose", f.verbose, "says more");
}

ProgressStyle progress_style(const PictureFlags& f) {
  if (f.progress_name == "none" || (f.quiet && f.progress_name == "auto")) return ProgressStyle::none;
  if (f.progress_name == "bar") return ProgressStyle::bar;
  if (f.progress_name == "alf") return ProgressStyle::alf;
  if (f.progress_name == "openjd") return ProgressStyle::openjd;
  if (f.progress_name == "json") return ProgressStyle::json;
  return error_is_terminal() ? ProgressStyle::bar : ProgressStyle::lines;
}

/// The error that a quality asks for, where the command line does not.
void settle_quality(const std::string& name, RenderSettings& render) {
  if (name.empty()) return;
  std::vector<std::string> known;
  for (const NamedQuality& quality : named_qualities) {
    known.push_back(quality.name);
    if (name != quality.name) continue;
    if (render.stop.error == 0) render.stop.error = quality.error;
    return;
  }
  throw InputError(fmt::format("there is no quality {}", shown_name(name)), suggestion(name, known));
}
}  // namespace

void add_picture_flags(Command& command, PictureFlags& flags) {
  add_scene(command, flags);
  add_camera(command, flags);
  add_stage_flags(command, flags.stage);
  add_quality(command, flags);
  add_output(command, flags);
}

void settle_picture_flags(const Command& command, PictureFlags& f, int samples) {
  voice.verbosity = f.quiet ? Verbosity::quiet : f.verbose ? Verbosity::detailed : Verbosity::normal;
  StopRules& stop = f.render.stop;
  settle_stage_flags(command, f.stage, f.scene.stage);
  settle_quality(f.quality, f.render);
  const bool no_rule = stop.spp == 0 && stop.error == 0 && stop.seconds == 0;
  if (no_rule) stop.spp = samples;
  f.render.adaptive = command.given("--adaptive") ? f.adaptive : no_rule || stop.error > 0 || stop.seconds > 0;
  f.render.seed = std::uint32_t(f.seed);
  f.render.light.strategy = strategy_from_name(f.strategy);
  f.scene.threads = f.render.threads;
  f.switches = read_effects(f.effects);
  if (f.switches.named_on(Effect::references)) f.stage.references = true;
  if (f.switches.named_off(Effect::references)) f.stage.references = false;
  f.switches.references = f.stage.references;
  if (command.given("--candidates")) f.switches.candidates = f.render.light.candidates;
  if (command.given("--bounces")) {
    f.switches.bounces = f.render.light.bounces;
    const bool off = f.switches.named_off(Effect::interreflection), on = f.switches.named_on(Effect::interreflection);
    if ((off && f.render.light.bounces > 0) || (on && f.render.light.bounces == 0))
      throw InputError(
          fmt::format("--bounces {} and --effects {} contradict each other", f.render.light.bounces, f.effects),
          "leave one of them out");
  }
  f.layer_list = read_layers(f.layers);
  f.render.albedo_layer = std::find(f.layer_list.begin(), f.layer_list.end(), "albedo") != f.layer_list.end();
  f.progress = progress_style(f);
  const Crop& crop = f.render.crop;
  if (crop.x1 > f.scene.width || crop.y1 > f.scene.height)
    throw InputError(fmt::format("--crop ends at {} {}, expected at most {} {}, the size of the picture", crop.x1,
                                 crop.y1, f.scene.width, f.scene.height));
}

std::vector<std::string> read_layers(const std::string& list) {
  if (list == "all") return layer_names();
  if (list == "none") return {};
  std::vector<std::string> chosen;
  for (const std::string& word : split(list, ',')) {
    if (std::find(layer_names().begin(), layer_names().end(), word) == layer_names().end())
      throw InputError(fmt::format("there is no layer {}", shown_name(word)), suggestion(word, layer_names()));
    chosen.push_back(word);
  }
  return chosen;
}

void add_approximation_flags(Command& command, Approximations& to) {
  for (const Approximation& each : approximation_list())
    command.custom(
        each.flag, each.value, 1, 1, [&each, &to](const auto& w) { each.read(w.back(), to); }, each.help);
}

Color read_hex_color(const std::string& what, const std::string& text) {
  std::string digits = text.substr(1);
  if (digits.size() == 3) digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
  unsigned value = 0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (digits.size() != 6 || code != std::errc() || end != digits.data() + 6)
    throw InputError(
        fmt::format("{} is {}, expected # and six hexadecimal digits, such as #c0b8a8", what, shown_name(text)));
  return {float(value >> 16) / 255.0f, float(value >> 8 & 255u) / 255.0f, float(value & 255u) / 255.0f};
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  size_t at = 0;
  for (;;) {
    const size_t end = text.find(separator, at);
    parts.push_back(text.substr(at, end - at));
    if (end == std::string::npos) return parts;
    at = end + 1;
  }
}

std::string shell_line(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=.,/:@%") == std::string::npos;
    std::string quoted;
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += (line.empty() ? "" : " ") + (plain ? word : "'" + quoted + "'");
  }
  return line;
}

std::string recorded_line(const std::string& subcommand, const std::vector<std::string>& words) {
  static const std::vector<std::string> with_value{
      "-o",        "--output",   "--stats", "--checkpoint", "--checkpoint-every", "--resume", "-t",
      "--threads", "--progress", "--sheet", "--frames"};
  static const std::vector<std::string> alone{"--json", "-q",       "--quiet", "-v",        "--verbose",
                                              "--redo", "--labels", "--bill",  "--dry-run", "--timings"};
  const auto among = [](const std::vector<std::string>& list, const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  };
  std::vector<std::string> kept{subcommand};
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (among(with_value, word)) {
      ++i;
      continue;
    }
    const bool is_long = word.starts_with("--");
    if (is_long && among(with_value, word.substr(0, word.find('=')))) continue;
    if (!is_long && word.size() > 2 && among(with_value, word.substr(0, 2))) continue;  // -oNAME
    if (among(alone, word) || (word.starts_with("--no-") && among(alone, "--" + word.substr(5)))) continue;
    kept.push_back(word);
  }
  return shell_line(kept);
}

}  // namespace sateen::app
