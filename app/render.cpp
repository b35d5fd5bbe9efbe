#include <fmt/format.h>

#include <cmath>
#include <set>

#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "picture_flags.h"
#include "picture_report.h"
#include "render/exposure.h"
#include "signals.h"

namespace sateen::app {

namespace {
void describe(Command& c) {
  c.example("sateen render", "the default satin on the default drape: sateen.png and sateen.exr");
  c.example("sateen render --look emerald_satin --env low_sun -o emerald.png", "another cloth under another light");
  c.example("sateen render -m dress.obj -l black_charmeuse --error 0.02 --time 5m -o dress.exr -o dress.png",
            "your own mesh, until the error is below 2 % or five minutes have passed");
  c.example("sateen render --set warp.gamma_s_deg=3 --azimuth 40 --zoom 2 -r 1920 1080 -o close.png",
            "one field of the look changed, seen from the right and closer");
  c.example("sateen render --env studio.hdr --env-rotate 90 --backdrop environment -s 256 -o scene.jpg",
            "the light itself behind the cloth");
}
}  // namespace

int run_render(const std::vector<std::string>& words) {
  PictureFlags flags;
  Command command("render",
                  "Renders one picture. Without any flag: the default satin, to sateen.png and sateen.exr here.",
                  "[--look NAME] [--mesh FILE] [--env MAP] [-o FILE]... [flags]");
  add_picture_flags(command, flags);
  describe(command);
  if (!command.parse(words)) return done;
  constexpr int default_spp = 128;
  settle_picture_flags(command, flags, default_spp);
  if (flags.outputs.empty()) flags.outputs = {"sateen.png", "sateen.exr"};
  std::set<std::string> names;
  for (const std::string& output : flags.outputs) {
    check_picture_path(output, !flags.dry_run);
    if (!names.insert(output).second) throw InputError(fmt::format("--output {} is given twice", output));
  }

  const ColorManager colors(flags.ocio, flags.working);
  flags.display = settle_display(flags.display, colors);
  SceneReport report;
  Scene scene = assemble_scene(flags.scene, colors, report);
  report.metered_ev = metered_towards(scene.environment, flags.scene.camera.azimuth_deg, flags.scene.environment_ev);
  const PictureJob job = make_job(flags, report, scene, colors, "render " + shell_line(words));
  print_scene(flags, job, report);
  if (flags.dry_run) return report_dry_run(flags, job, report);

  const bool any_exr =
      std::any_of(flags.outputs.begin(), flags.outputs.end(), [](const auto& o) { return is_exr(o); });
  Film film(flags.scene.width, flags.scene.height, any_exr && !job.layers.empty());
  Progress progress(flags.progress, progress_writer(flags.progress));
  const StopOnSignal stop_on_signal;
  const RenderResult result = render(
      scene, job.render, film, [&](const RenderState& state) { progress.update(state); }, &interrupted);

  PictureContent content;
  content.film = &film;
  content.crop = flags.render.crop;
  content.layers = job.layers;
  content.display = job.display;
  content.exposure_ev = job.exposure_ev;
  content.attributes = picture_attributes(job, report, result);
  std::vector<WrittenPicture> written;
  for (const std::string& output : flags.outputs) written.push_back(write_picture(output, content, colors));
  if (result.reason == StopReason::interrupted) progress.stopped();
  progress.done();

  for (const WrittenPicture& file : written) print_written(job, file);
  print_result_line(job, result);
  const int code = picture_code(flags, result);
  JsonWriter w;
  w.open_object();
  write_job(w, flags, job, report);
  write_result(w, result, written);
  write_stats(flags, w.member("exit_code", code).close().text());
  return code;
}

}  // namespace sateen::app
