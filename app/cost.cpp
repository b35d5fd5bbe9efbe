#include "study/cost.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/parallel.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "look/read.h"
#include "outputs.h"
#include "picture_flags.h"
#include "scene/environment_file.h"
#include "signals.h"
#include "study/cost_report.h"
#include "work_progress.h"

namespace sateen::app {

namespace {
void describe(Command& c) {
  c.paragraph(
      "Takes the flags of sateen render, measures that picture at a smaller size, and writes a folder: index.html "
      "with "
      "the picture at every price, plots as SVG and PNG, cost.csv, cost.json and cost.txt. --output names the folder "
      "(default: cost); --spp is the largest number of samples of the error against time (default: 128). Stopped by "
      "Ctrl-C it writes what is finished.");
  c.example("sateen cost -l emerald_satin --env low_sun -o out/cost", "the price list of one picture");
  c.example("sateen cost -m dress.obj --bounces 2 -r 1920 1080 -s 256 -o out/cost",
            "of your own mesh, with light that meets cloth again");
}

std::string folder_of(const PictureFlags& flags) {
  if (flags.outputs.empty()) return "cost";
  if (flags.outputs.size() > 1) throw InputError("--output is given twice, and a price list is one folder");
  const std::filesystem::path folder = flags.outputs[0];
  std::error_code error;
  if (folder.has_extension() && !std::filesystem::is_directory(folder, error))
    throw InputError(fmt::format("--output {} looks like a file, and a price list is a folder", folder.string()),
                     "name it without an extension, such as out/cost");
  return flags.outputs[0];
}
/// Nothing of the price list may take the place of what it is made of.
void check_cost_inputs(const PictureFlags& flags, const std::string& folder) {
  const Look look = read_look(flags.scene.look, flags.scene.look_overrides);
  if (!look.back.empty()) read_back(look);
  if (!look.pattern_look.empty()) read_pattern(look);
  std::vector<NamedFile> inputs = config_input(flags.ocio);
  inputs.push_back({"mesh", flags.scene.mesh});
  inputs.push_back({"map", find_environment(flags.scene.environment).string()});
  check_report_folder(folder, {"index.html", "cost.csv", "cost.json", "cost.txt"}, inputs);
}
}  // namespace

int run_cost(const std::vector<std::string>& words) {
  PictureFlags flags;
  Command command("cost",
                  "Tells what accuracy costs in time for your picture, and what every approximation gives away.",
                  "[--look NAME] [--mesh FILE] [--env MAP] [-o FOLDER] [flags]");
  describe(command);
  add_picture_flags(command, flags);
  if (!command.parse(words)) return done;
  constexpr int default_spp = 128, fewest_spp = 16;
  settle_picture_flags(command, flags, default_spp);
  for (const char* rule : {"--error", "--time", "--crop"})
    if (command.given(rule))
      throw InputError(
          fmt::format("{} is not for sateen cost, which finds out what errors and times there are", rule),
          "--spp sets how far it looks");
  if (flags.render.stop.spp < fewest_spp)
    throw InputError(
        fmt::format("--spp is {}, expected {} or more: a curve wants points", flags.render.stop.spp, fewest_spp));
  const std::string folder = folder_of(flags);

  check_cost_inputs(flags, folder);

  const ColorManager colors(flags.ocio, flags.working);
  CostSettings settings;
  settings.scene = flags.scene;
  settings.light = flags.render.light;
  settings.effects = flags.switches;
  settings.display = settle_display(flags.display, colors);
  settings.exposure_ev = flags.exposure_ev;
  settings.seed = flags.render.seed;
  settings.threads = flags.render.threads;
  settings.layers = !flags.layer_list.empty();
  settings.albedo_layer = flags.render.albedo_layer;
  settings.program_seconds = cpu_seconds();
  settings.most_samples = flags.render.stop.spp;
  settings.price_samples = std::clamp(flags.render.stop.spp / 4, 8, 64);
  WorkProgress progress(flags.progress != ProgressStyle::none);
  const StopOnSignal stop_on_signal;
  const CostResult result = measure_cost(
      settings, colors,
      [&](const StudyState& state) { progress.update(state.fraction, state.seconds_left, state.doing); },
      &interrupted);
  progress.finish();
  const std::string command_line = "sateen cost " + shell_line(words);
  if (voice.json)
    print_result(cost_json(result, SATEEN_VERSION, command_line));
  else
    print_note(cost_text(result));
  const std::vector<std::string> files = write_cost(folder, result, SATEEN_VERSION, command_line);
  print_note(fmt::format("wrote {} files into {}; open {}", files.size(), folder,
                         (std::filesystem::path(folder) / "index.html").string()));
  return result.interrupted ? 128 + signal_received() : int(done);
}

}  // namespace sateen::app
