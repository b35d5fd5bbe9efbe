#include "study/study.h"

#include <fmt/format.h>

#include <filesystem>
#include <tuple>

#include "command.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "look/read.h"
#include "outputs.h"
#include "picture_flags.h"
#include "scene/environment_file.h"
#include "signals.h"
#include "study/study_report.h"
#include "typed_values.h"
#include "work_progress.h"

namespace sateen::app {

namespace {
struct StudyFlags {
  StudySettings study;
  std::string folder = "study";
  bool quick = false, quiet = false;
};

std::vector<std::string> split_list(const std::string& what, const std::string& text) {
  std::vector<std::string> parts;
  for (size_t at = 0, end = 0; at <= text.size(); at = end + 1) {
    end = std::min(text.find(',', at), text.size());
    if (end == at) throw InputError(fmt::format("{} has an empty name in {}", what, text));
    parts.push_back(text.substr(at, end - at));
  }
  return parts;
}

void describe(Command& c, StudyFlags& f) {
  StudySettings& s = f.study;
  c.paragraph(
      "Renders looks under lights by every sampling strategy, several seeds each, against references, and writes a "
      "folder: index.html with pictures to compare, plots as SVG and PNG, study.csv with every render, study.json "
      "and "
      "study.txt. It tells which strategy has the least error in the same CPU time, whether the bars are passed, and "
      "where the talk's claims hold. Stopped by Ctrl-C it writes the scenes that are finished.");
  c.group("What is studied");
  c.text("-m,--mesh", "NAME|FILE.obj", s.scene.mesh, fmt::format("the form (default: {})", s.scene.mesh));
  c.custom(
      "--looks", "NAME,NAME...", 1, 1, [&s](const auto& w) { s.looks = split_list("--looks", w.back()); },
      fmt::format("cloths (default: {}); the first two are measured at growing samples too",
                  fmt::join(study_looks(), ",")));
  c.custom(
      "--envs", "NAME,NAME...", 1, 1, [&s](const auto& w) { s.lights = split_list("--envs", w.back()); },
      fmt::format("lights; white is a constant map (default: {})", fmt::join(study_lights(), ",")));
  c.phrase(
      "-r,--res", "W H", continues_size,
      [&s](const std::string& text) {
        std::tie(s.scene.width, s.scene.height) = read_size("--res", text, 16, {2048, 2048});
      },
      fmt::format("size of the measured renders (default: {} {})", s.scene.width, s.scene.height));
  c.group("How much of it");
  c.integer("--seeds", "N", s.seeds, 2, 100, fmt::format("repetitions, for the intervals (default: {})", s.seeds));
  c.integer("-s,--spp", "N", s.samples, 4, 4096,
            "samples a pixel of mis-compensated, whose time is the equal time (default: as --time allows, 8 to 64)");
  c.phrase(
      "--time", "T", continues_duration,
      [&s](const std::string& text) { s.cpu_seconds = read_duration("--time", text); },
      "CPU time that the whole may take, about: 10m, 2h (default: 1h)");
  c.flag("--quick", f.quick, "a minute or two: satin alone, three lights, smaller renders");
  c.flag("--pictures", s.pictures, "pictures to compare (default)");
  add_approximation_flags(c, s.scene.approximations);
  c.integer("-t,--threads", "N", s.threads, 0, 4096, "0: all that this process may use (default)");
  c.group("Output");
  c.text("-o,--output", "FOLDER", f.folder, fmt::format("where all of it goes (default: {})", f.folder));
  c.flag("-q,--quiet", f.quiet, "warnings and errors only");
  c.example("sateen study --quick -o out/study", "a minute or two, to see what it gives");
  c.example("sateen study -o out/study", "the whole, about an hour of one core; open out/study/index.html");
  c.example("sateen study --looks my_satin.json --envs white,studio.hdr --mesh dress.obj --time 5m",
            "your own look, form and light");
}

// Names are looked at before anything is rendered: the last scene's typing error must not cost an hour.
void check_names(const StudySettings& s) {
  for (const std::string& look : s.looks) read_look(look);
  for (const std::string& light : s.lights)
    if (const std::string map = study_map(light); map != white_light && !map.empty()) find_environment(map);
}

/// What is read besides the looks, whose reading was noted.
std::vector<NamedFile> study_inputs(const StudySettings& s) {
  std::vector<NamedFile> inputs = config_input({});
  inputs.push_back({"mesh", s.scene.mesh});
  for (const std::string& light : s.lights)
    if (const std::string map = study_map(light); map != white_light && !map.empty())
      inputs.push_back({"map", find_environment(map).string()});
  return inputs;
}
}  // namespace

int run_study(const std::vector<std::string>& words) {
  StudyFlags flags;
  flags.study.scene.width = 240;
  flags.study.scene.height = 135;
  Command command("study", "Measures the sampling strategies against each other, at equal samples and at equal time.",
                  "[--quick] [--looks NAMES] [--envs MAPS] [--mesh FILE] [-o FOLDER] [flags]");
  describe(command, flags);
  if (!command.parse(words)) return done;
  if (flags.quiet) voice.verbosity = Verbosity::quiet;
  StudySettings& study = flags.study;
  if (flags.quick) {
    if (!command.given("--looks")) study.looks = {study_looks()[0]};
    if (!command.given("--envs")) study.lights = {white_light, "studio_softboxes", "low_sun"};
    if (!command.given("--res")) study.scene.width = 96, study.scene.height = 54;
    if (!command.given("--seeds")) study.seeds = 3;
    if (!command.given("--time")) study.cpu_seconds = 60;
  }
  check_names(study);
  check_report_folder(flags.folder, {"index.html", "study.csv", "study.json", "study.txt"}, study_inputs(study));
  const ColorManager colors;
  for (const std::string& warning : colors.warnings()) print_warning(warning);
  WorkProgress progress(voice.verbosity != Verbosity::quiet);
  const StopOnSignal stop_on_signal;
  const StudyResult result = sateen::run_study(
      study, colors,
      [&](const StudyState& state) { progress.update(state.fraction, state.seconds_left, state.doing); },
      &interrupted);
  progress.finish();
  print_note(study_text(result));
  const std::vector<std::string> files =
      write_study(flags.folder, result, SATEEN_VERSION, "sateen study " + shell_line(words));
  print_note(fmt::format("wrote {} files into {}; open {}", files.size(), flags.folder,
                         (std::filesystem::path(flags.folder) / "index.html").string()));
  return result.interrupted ? 128 + signal_received() : int(done);
}

}  // namespace sateen::app
