#include "render/plan.h"

#include <fmt/format.h>

#include "assembly.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "outputs.h"
#include "picture_report.h"
#include "plan_report.h"
#include "render/candidates.h"

namespace sateen::app {

int run_plan(const std::vector<std::string>& words) {
  PictureFlags flags;
  Command command("plan", "Says which effects a picture will be rendered with, which not, and why; renders nothing.",
                  "[--look NAME] [--mesh FILE] [--env MAP] [--error E] [flags]");
  command.paragraph(
      "Takes the flags of sateen render. An effect is off because the look has none of it, because mesh or map make "
      "it "
      "impossible, or because a pilot found that the picture's error without it stays below half of the error asked "
      "for. "
      "light: its share of the picture's light; time: what it adds to a sample, or saves.");
  add_picture_flags(command, flags);
  add_shutter_flag(command, flags.scene.stage);
  command.example("sateen plan -m dress.obj -l ivory_duchess_satin --error 0.02", "for an error of 2 %");
  command.example("sateen plan --effects auto,-gaps --json", "as JSON, with one effect switched off");
  if (!command.parse(words)) return done;
  settle_picture_flags(command, flags);
  for (const std::string& output : flags.outputs) check_picture_path(output, false);
  if (!flags.stats.empty()) check_can_write(flags.stats);
  const Assembly assembly = assemble_picture(flags, recorded_line("plan", words));
  check_not_read({{"--stats", flags.stats}}, config_input(flags.ocio));
  const SceneReport& report = assembly.report;
  const PictureJob& job = assembly.job;
  for (const std::string& warning : report.warnings) print_warning(warning);
  print_note(fmt::format("{} on {} under {}, level {}, {} triangles", report.look.name, job.scene.mesh,
                         job.scene.environment, report.level, report.triangles));
  if (!voice.json) {
    print_result(plan_text(job.plan));
    print_result("\n" + levels_text(job.plan, report));
    print_result(fmt::format("light is sampled by {}", sampling_text(job.render.light, job.candidates_reason)));
  }
  const int code = report_verdicts(job.plan, job.verdicts) ? int(done) : int(failed);
  JsonWriter w;
  w.open_object();
  write_job(w, flags, job, report);
  write_stats(flags, w.member("exit_code", code).close().text());
  return code;
}

}  // namespace sateen::app
