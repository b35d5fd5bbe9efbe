#include "render.h"

#include <fmt/format.h>

#include <cmath>

#include "assembly.h"
#include "base/file_identity.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "memory.h"
#include "outputs.h"
#include "picture_report.h"
#include "plan_report.h"
#include "render/checkpoint.h"
#include "run.h"
#include "signals.h"
#include "typed_values.h"

namespace sateen::app {

namespace {
void describe(Command& c) {
  c.paragraph(
      "SIGUSR1 writes the pictures so far and rendering goes on. SIGINT, SIGTERM and SIGHUP write them and a "
      "checkpoint, which --resume goes on from. Over a finished picture they do not go, but beside it: "
      "NAME.partial.exr.");
  c.example("sateen render", "the default satin on the default drape: sateen.png and sateen.exr");
  c.example("sateen render --look emerald_satin --env low_sun -o emerald.png", "another cloth under another light");
  c.example("sateen render -m dress.obj -l black_charmeuse --error 0.02 --time 5m -o dress.exr -o dress.png",
            "your own mesh, until the error is below 2 % or five minutes have passed");
  c.example("sateen render --set warp.gamma_s_deg=3 --azimuth 40 --zoom 2 -r 1920 1080 -o close.png",
            "one field of the look changed, seen from the right and closer");
  c.example("sateen render --env studio.hdr --env-rotate 90 --backdrop environment -s 256 -o scene.jpg",
            "the light itself behind the cloth");
  c.example("sateen render --error 0.02 -o a.exr --checkpoint a.checkpoint",
            "later: the same with --error 0.01 --resume a.checkpoint, from where it was");
}

void add_going_on(Command& c, RenderFlags& f) {
  c.flag(
      "--bill", f.picture.bill,
      "says what every effect cost in time and noise and what the picture would lose without it; a page beside the "
      "first picture shows it");
  c.group("Going on");
  c.text("--checkpoint", "FILE", f.checkpoint,
         "keeps all sums there, every five minutes and at the end (a signal: beside the first picture without it)");
  c.phrase(
      "--checkpoint-every", "T", continues_duration,
      [&f](const std::string& text) { f.checkpoint_every = read_duration("--checkpoint-every", text); },
      "how often the checkpoint is written anew (default: 5m)");
  c.text("--resume", "FILE", f.resume,
         "goes on from a checkpoint of the same picture: the same bits as a render that never stopped");
  c.integer("--samples-from", "N", f.first_sample, 0, 1 << 30,
            "first sample of a range, a multiple of 4, for sateen merge (default: 0)");
}

/// One picture on its way: what is written of it, at the end and in between.
struct Work {
  const RenderFlags& flags;
  const std::vector<std::string>& words;
  const PictureJob& job;
  const SceneReport& report;
  const ColorManager& colors;
  Checkpoint state;
  std::optional<References> references = {};

  WrittenPictures write_outputs(const RenderResult& result) const {
    PictureContent content;
    content.film = &state.film;
    content.crop = job.render.crop;
    content.layers = job.layers;
    content.display = job.display;
    content.exposure_ev = job.exposure_ev;
    content.attributes = picture_attributes(job, report, result);
    if (references) content.overlay = &references->overlay;
    const auto& outputs = flags.picture.outputs;
    const bool partial = result.reason == StopReason::interrupted;
    return write_pictures(partial ? names_for_partial(outputs) : outputs, content, colors, job.render.threads);
  }

  /// A full disk now must not cost what is rendered: it may have room again at the end.
  void snapshot(const RenderResult& result, bool asked, Progress& progress) const {
    std::vector<std::string> failures;
    try {
      if (!flags.checkpoint.empty()) write_checkpoint(flags.checkpoint, state);
    } catch (const OperationError& error) {
      failures.push_back(error.what());
    }
    if (asked) {
      progress.clear_line();
      const WrittenPictures pictures = write_outputs(result);
      for (const WrittenPicture& file : pictures.written) print_written(job, file);
      failures.insert(failures.end(), pictures.failures.begin(), pictures.failures.end());
    }
    if (!failures.empty()) progress.clear_line();
    for (const std::string& failure : failures) print_warning(failure);
  }
};

/// Of a time limit, what the program has taken so far and what writing will take: measured on one core, in
/// microseconds a pixel, 0.4 for a display picture and 0.1 for each layer of an EXR.
double seconds_beside_rendering(const PictureFlags& flags, const PictureJob& job) {
  double each = 0;
  for (const std::string& output : flags.outputs)
    each += is_exr(output) ? 0.1 * (1 + double(job.layers.size())) : 0.4;
  return seconds_since_start() + 1e-6 * each * job.scene.width * job.scene.height;
}

/// Whether the film keeps the layers beside the beauty.
bool keeps_layers(const RenderFlags& f) {
  const auto& outputs = f.picture.outputs;
  return !f.picture.layer_list.empty() &&
         (!f.checkpoint.empty() ||
          std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return is_exr(o); }));
}

void start(Work& work) {
  const RenderFlags& f = work.flags;
  Checkpoint& state = work.state;
  if (f.resume.empty()) {
    if (!f.picture.dry_run) state.film = Film(work.job.scene.width, work.job.scene.height, keeps_layers(f));
    state.film.first_sample = std::uint32_t(f.first_sample);
    state.facts = sampling_facts(work.job, work.report);
    state.words = work.words;
    state.plan = plan_json(work.job.plan);
    state.candidates_reason = work.job.candidates_reason;
    return;
  }
  check_same_job(f.resume, state.facts, sampling_facts(work.job, work.report));
  if (state.film.layers.empty() && !work.job.layers.empty() && is_exr(f.picture.outputs[0]))
    throw InputError(fmt::format("{} holds no layers, which an EXR wants", f.resume), "add --aov none");
  print_note(fmt::format("{} goes on at {} samples a pixel", f.resume, state.course.samples));
}
std::filesystem::path bill_page(const PictureFlags& flags) {
  return std::filesystem::path(flags.outputs[0]).replace_extension(".bill.html");
}

/// Bills the effects of the picture that was rendered: into the JSON, and with --bill as a table and a page.
void make_out_bill(JsonWriter& w, const PictureFlags& flags, const PictureJob& job, const Scene& scene,
                   const ColorManager& colors) {
  BillSettings settings;
  settings.display = job.display;
  settings.exposure_ev = job.exposure_ev;
  if (flags.bill) settings.columns = 128;
  const Bill bill =
      make_bill(scene, job.plan, job.render.light, settings, colors, job.render.seed, job.render.threads);
  write_bill(w, bill);
  if (!flags.bill) return;
  if (!voice.json) print_result(table_text(bill_table(bill)));
  const std::filesystem::path page = bill_page(flags);
  write_bill_page(page, bill, job.command_line);
  print_note(fmt::format("wrote {}", page.string()));
}

std::vector<NamedFile> files_to_write(const RenderFlags& flags) {
  std::vector<NamedFile> others{{"--checkpoint", flags.checkpoint}, {"--stats", flags.picture.stats}};
  if (flags.picture.bill) others.push_back({"--bill", bill_page(flags.picture).string()});
  return named_outputs(flags.picture.outputs, others);
}

/// What is read and is none of the scene's files. A checkpoint may go on in the file that it is resumed from: it then
/// holds all that it held.
std::vector<NamedFile> inputs_of(const RenderFlags& flags) {
  std::vector<NamedFile> inputs = config_input(flags.picture.ocio);
  if (flags.checkpoint.empty() || !same_file(flags.checkpoint, flags.resume))
    inputs.push_back({"checkpoint", flags.resume});
  return inputs;
}

/// A picture goes on with the effects that it began with, even where a tighter error calls for more.
void warn_of_tighter_plan(const Plan& plan, double error) {
  const PlannedEffect& interreflection = plan.of(Effect::interreflection);
  const std::optional<Interval>& loss = interreflection.loss;
  if (!(error > 0) || interreflection.basis == Basis::asked || plan.bounces >= tracked_bounces) return;
  if (!loss || loss->low <= plan_allowance * error) return;
  print_warning(fmt::format(
      "an error of {:.3g} % calls for more than {} bounces, without which E is off by {:.3g} %; the picture "
      "goes on as it began, and its error does not count that: render it anew to have it",
      100 * error, plan.bounces, 100 * loss->value));
}
}  // namespace

bool read_render_flags(const std::vector<std::string>& words, RenderFlags& flags) {
  Command command("render",
                  "Renders one picture. Without any flag: the default satin, to sateen.png and sateen.exr here.",
                  "[--look NAME] [--mesh FILE] [--env MAP] [-o FILE]... [flags]");
  add_picture_flags(command, flags.picture);
  add_shutter_flag(command, flags.picture.scene.stage);
  add_going_on(command, flags);
  describe(command);
  if (!command.parse(words)) return false;
  settle_picture_flags(command, flags.picture);
  flags.adaptive_given = command.given("--adaptive");
  PictureFlags& p = flags.picture;
  if (p.outputs.empty()) p.outputs = {"sateen.png", "sateen.exr"};
  if (flags.first_sample % replicates != 0)
    throw InputError(fmt::format("--samples-from is {}, expected a multiple of {}", flags.first_sample, replicates));
  if (command.given("--samples-from")) {
    if (flags.adaptive_given && p.render.adaptive)
      throw InputError("--samples-from wants the same samples everywhere, and --adaptive deals them out by error",
                       "leave --adaptive out");
    p.render.adaptive = false;
  }
  return true;
}

int run_render(const std::vector<std::string>& words) {
  RenderFlags all;
  if (!read_render_flags(words, all)) return done;
  PictureFlags& flags = all.picture;
  for (const std::string& output : flags.outputs) check_picture_path(output, false);
  const std::vector<NamedFile> outputs = files_to_write(all);
  for (const NamedFile& output : outputs) check_can_write(output.path, !flags.dry_run);
  if (!flags.dry_run) check_film_memory(flags);
  Checkpoint begun;
  if (!all.resume.empty()) {
    begun = read_checkpoint(all.resume);
    all.first_sample = int(begun.film.first_sample);
    // Not part of the picture asked for, but of how it was begun.
    if (!all.adaptive_given)
      for (const Fact& fact : begun.facts)
        if (fact.name == "adaptive") flags.render.adaptive = fact.value == "yes";
    keep_strategy(flags, begun.facts);
  }

  Assembly assembly = assemble_picture(flags, recorded_line("render", words), all.resume.empty() ? nullptr : &begun);
  check_not_read(outputs, inputs_of(all));
  const ColorManager& colors = assembly.colors;
  const SceneReport& report = assembly.report;
  const Scene& scene = assembly.scene;
  PictureJob& job = assembly.job;
  job.first_sample = all.first_sample;
  print_scene(flags, job, report);
  if (!report_verdicts(job.plan, job.verdicts)) return failed;
  try {
    const Film& film = begun.film;
    const bool there = !film.pixels.empty();
    check_picture_memory(flags, there ? !film.layers.empty() : keeps_layers(all), there);
  } catch (const InputError& error) {
    if (!flags.dry_run) throw;
    print_warning("this machine would refuse it: " + error.diagnostics.at(0).message);
  }
  Work work{all, words, job, report, colors, std::move(begun)};
  start(work);
  if (!all.resume.empty()) warn_of_tighter_plan(job.plan, flags.render.stop.error);
  work.references = references_of(flags, job, scene, colors);
  if (flags.dry_run) return report_dry_run(flags, job, report);

  if (job.render.stop.seconds > 0) job.render.seconds_spent = seconds_beside_rendering(flags, job);
  Progress progress(flags.progress, progress_writer(flags.progress));
  const StopOnSignal stop_on_signal;
  bool promised = work.state.course.promise.made;
  RenderHooks hooks;
  hooks.interrupt = &interrupted;
  hooks.snapshot_wanted = &picture_wanted;
  hooks.snapshot_every = all.checkpoint.empty() ? 0 : all.checkpoint_every;
  hooks.observe = [&](const RenderState& state) {
    if (state.promise.made && !promised) {
      promised = true;
      progress.clear_line();
      print_promise(job, state.promise);
    }
    progress.update(state);
  };
  hooks.snapshot = [&](const RenderResult& result, bool asked) { work.snapshot(result, asked, progress); };
  const RenderResult result = render(scene, job.render, work.state.film, work.state.course, hooks);

  // The sums first: of them everything else can be made again.
  Endings endings;
  const bool stopped = result.reason == StopReason::interrupted;
  std::string checkpoint = all.checkpoint;
  if (stopped && checkpoint.empty()) checkpoint = flags.outputs[0] + ".checkpoint";
  if (stopped) progress.stopped();
  progress.done();
  const bool kept = !checkpoint.empty() && endings.attempt([&] { write_checkpoint(checkpoint, work.state); });
  const WrittenPictures pictures = work.write_outputs(result);
  endings.tell(job, pictures);
  print_result_line(job, result);
  if (work.references) print_references(*work.references);
  if (stopped && kept) print_note(fmt::format("--resume {} goes on from here", shell_line({checkpoint})));
  JsonWriter w;
  w.open_object();
  write_job(w, flags, job, report);
  write_result(w, result, pictures);
  if (work.references) write_references(w, *work.references);
  if ((flags.bill || !flags.stats.empty()) && !stopped)
    endings.attempt([&] { make_out_bill(w, flags, job, scene, colors); });
  if (kept) w.member("checkpoint", checkpoint);
  const int code = endings.code(picture_code(flags, result));
  w.member("exit_code", code).close();
  endings.attempt([&] { write_stats(flags, w.text()); });
  return endings.code(code);
}

}  // namespace sateen::app
