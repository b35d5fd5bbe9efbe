#include "assembly.h"

#include "image/file.h"
#include "render/candidates.h"

namespace sateen::app {

Assembly assemble_picture(PictureFlags& flags, const std::string& command_line, const Checkpoint* begun) {
  set_exr_threads(flags.render.threads);
  ColorManager colors(flags.ocio, flags.working);
  flags.display = settle_display(flags.display, colors);
  SceneReport report;
  Scene scene = assemble_scene(flags.scene, colors, report);
  if (const std::string fault = display_fault(flags.display, colors); !fault.empty())
    report.warnings.push_back(fault);
  PictureJob job = plan_picture(flags, report, scene, colors, command_line, begun);
  return {std::move(colors), std::move(report), std::move(scene), std::move(job)};
}

namespace {

void plan_anew(const PictureFlags& flags, const SceneReport& report, double error_floor, Scene& scene,
               PictureJob& job) {
  const RenderSettings& r = flags.render;
  job.plan =
      make_plan(scene, report.look,
                {flags.switches, r.stop.error, error_floor, r.light, r.seed, r.threads, flags.scene.from_all_around});
  if (flags.verify_plan) job.verdicts = verify_plan(scene, job.plan, r.light, error_floor, r.seed, r.threads);
  apply_plan(job.plan, scene, job.render.light);
  job.candidates_reason =
      settle_candidates(scene, flags.switches.candidates, job.render.light, error_floor, r.seed, r.threads);
}

/// As another render of the picture was planned. What the flags say besides makes it another picture, which
/// check_same_job() tells.
void plan_as_begun(const PictureFlags& flags, const Checkpoint& begun, double error_floor, Scene& scene,
                   PictureJob& job) {
  const RenderSettings& r = flags.render;
  job.plan = read_plan(begun.plan);
  hold_to(flags.switches, job.plan);
  if (flags.verify_plan) job.verdicts = verify_plan(scene, job.plan, r.light, error_floor, r.seed, r.threads);
  apply_plan(job.plan, scene, job.render.light);
  for (const Fact& fact : begun.facts)
    if (fact.name == "candidates") job.render.light.candidates = candidates_from_text(fact.value);
  if (flags.switches.candidates) job.render.light.candidates = *flags.switches.candidates;
  job.candidates_reason = begun.candidates_reason;
}

}  // namespace

PictureJob plan_picture(const PictureFlags& flags, const SceneReport& report, Scene& scene,
                        const ColorManager& colors, const std::string& command_line, const Checkpoint* begun) {
  PictureJob job;
  job.scene = flags.scene;
  job.render = flags.render;
  job.display = flags.display;
  job.exposure_ev = flags.exposure_ev.value_or(report.metered_ev);
  const double error_floor = job.render.error_floor = error_floor_at(double(job.exposure_ev));
  if (begun)
    plan_as_begun(flags, *begun, error_floor, scene, job);
  else
    plan_anew(flags, report, error_floor, scene, job);
  job.layers = flags.layer_list;
  job.references = flags.stage.references;
  job.timings = flags.timings;
  job.effects = effects_text(scene, job.render.light);
  job.color_config = colors.description();
  job.working_space = colors.working_space();
  job.version = SATEEN_VERSION;
  job.command_line = "sateen " + command_line;
  return job;
}

void keep_strategy(PictureFlags& flags, const std::vector<Fact>& facts) {
  for (const Fact& fact : facts)
    if (fact.name == "strategy" && flags.strategy == strategy_name(Strategy::automatic))
      flags.render.light.strategy = strategy_from_name(fact.value);
}

}  // namespace sateen::app
