#include "assembly.h"

#include "image/file.h"
#include "render/candidates.h"

namespace sateen::app {

Assembly assemble_picture(PictureFlags& flags, const std::string& command_line, bool pilots) {
  set_exr_threads(flags.render.threads);
  ColorManager colors(flags.ocio, flags.working);
  flags.display = settle_display(flags.display, colors);
  SceneReport report;
  Scene scene = assemble_scene(flags.scene, colors, report);
  PictureJob job = plan_picture(flags, report, scene, colors, command_line, pilots);
  return {std::move(colors), std::move(report), std::move(scene), std::move(job)};
}

PictureJob plan_picture(const PictureFlags& flags, const SceneReport& report, Scene& scene,
                        const ColorManager& colors, const std::string& command_line, bool pilots) {
  PictureJob job;
  job.scene = flags.scene;
  job.render = flags.render;
  job.exposure_ev = flags.exposure_ev.value_or(report.metered_ev);
  job.render.error_floor = error_floor_at(job.exposure_ev);
  job.plan = make_plan(scene, report.look, flags.switches, flags.render.stop.error, flags.render.light,
                       flags.render.seed, flags.render.threads, pilots);
  if (flags.verify_plan && pilots)
    job.verdicts = verify_plan(scene, job.plan, flags.render.light, flags.render.seed, flags.render.threads);
  apply_plan(job.plan, scene, job.render.light);
  if (pilots || flags.switches.candidates)
    job.candidates_reason = settle_candidates(scene, flags.switches.candidates, job.render.light, flags.render.seed,
                                              flags.render.threads);
  job.display = flags.display;
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

void keep_effects(PictureFlags& flags, const std::vector<Fact>& facts) {
  for (const Fact& fact : facts)
    if (fact.name == "bounces" && !flags.switches.bounces)
      flags.switches.bounces = read_integer("bounces", fact.value, 0, 64);
    else if (fact.name == "bounce share")
      flags.switches.bounce_share = float(read_number("bounce share", fact.value, 0.001, 1));
    else if (fact.name == "candidates" && !flags.switches.candidates)
      flags.switches.candidates = candidates_from_text(fact.value);
    else if (fact.name == "strategy" && flags.strategy == strategy_name(Strategy::automatic))
      flags.render.light.strategy = strategy_from_name(fact.value);
}

}  // namespace sateen::app
