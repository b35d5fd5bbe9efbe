#include "render/turntable.h"

#include <fmt/format.h>

#include <algorithm>

#include "assembly.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "film/develop.h"
#include "image/contact_sheet.h"
#include "memory.h"
#include "outputs.h"
#include "picture_flags.h"
#include "picture_report.h"
#include "render/frames.h"
#include "signals.h"

namespace sateen::app {

namespace {
struct TurntableFlags {
  PictureFlags picture;
  std::string turn = "object", frames, sheet;
  int count = 36;
  double degrees = 360, motion_blur = 0;
  bool labels = true, redo = false;
};

/// One frame on its way: a job of its own, with the camera and light of its angle.
struct Frame {
  int number = 0;
  double angle = 0;
  std::vector<std::string> files;
  PictureJob job;
};

void describe(Command& c, TurntableFlags& f) {
  c.group("Turntable");
  c.choice("--turn", f.turn, turn_names(),
           "what turns: the object and with it its folds, the camera, or the light (default: object)");
  c.integer("-n,--count", "N", f.count, 1, 100000, "frames of the whole orbit (default: 36)");
  c.number("--degrees", "DEG", f.degrees, -36000, 36000, "of the whole orbit (default: 360)");
  c.text("--frames", "LIST", f.frames, "only these: 1-100, 1-100x2, 1..10, 1,5,9 (default: 1 to N)");
  c.share("--motion-blur", "SHARE", f.motion_blur, 0, 1,
          "of the step between frames that the shutter is open: 0.5 is a shutter of 180 degrees (default: 0)");
  c.flag("--redo", f.redo, "renders frames anew that are finished already");
  c.text("--sheet", "FILE", f.sheet, "a sheet of all these frames, small");
  c.flag("--labels", f.labels, "frame and angle under each picture of the sheet (default)");
  add_picture_flags(c, f.picture);
  c.paragraph(
      "Frame 1 stands at 0 degrees. Names take a place for the number: # (4 digits), ####, %04d or $F4. A frame is "
      "skipped when its files are whole and were made by the same job; anything that changes the pixels makes "
      "another job.");
  c.example("sateen turntable -l emerald_satin -s 32 -o out/turn.####.png --sheet out/sheet.png",
            "36 frames and a sheet of them");
  c.example("sateen turntable --turn light -n 120 --frames 1-120x4 -o light.%04d.exr",
            "every fourth frame of a light that turns");
}

/// The outputs of all frames, the sheet and the stats. InputError where a name does not fit, or two are one file.
std::vector<NamedFile> check_names(TurntableFlags& f, const std::vector<int>& frames) {
  PictureFlags& p = f.picture;
  if (p.outputs.empty()) p.outputs = {"turntable.####.png"};
  for (const std::string& output : p.outputs) {
    if (frames.size() > 1 && !has_frame_place(output))
      throw InputError(fmt::format("--output {} has no place for a frame's number, and there are {} frames", output,
                                   frames.size()),
                       "write it such as turn.####.png");
    check_picture_path(frame_name(output, frames[0]), false);
  }
  if (!f.sheet.empty()) {
    check_picture_path(f.sheet, false);
    if (is_exr(f.sheet)) throw InputError("a sheet is for looking at and is not written as EXR", "use .png or .jpg");
    if (has_frame_place(f.sheet))
      throw InputError(fmt::format("--sheet {} has a place for a number, but is one picture", f.sheet));
  }
  std::vector<std::string> names;
  for (const int frame : frames)
    for (const std::string& output : p.outputs) names.push_back(frame_name(output, frame));
  std::vector<NamedFile> files = named_outputs(names, {{"--sheet", f.sheet}, {"--stats", p.stats}});
  if (!p.dry_run) {
    // One frame stands for all: they lie in one folder, or in one that is made when they are written.
    for (size_t i = 0; i < p.outputs.size(); ++i) check_can_write(names[i]);
    for (const std::string& other : {f.sheet, p.stats})
      if (!other.empty()) check_can_write(other);
    check_film_memory(p);
  }
  return files;
}

// The display picture of a frame that is there already.
Image read_small(const Frame& frame, const ColorManager& colors, int side) {
  for (const std::string& file : frame.files)
    if (!is_exr(file)) return shrink_image(read_image(file), side);
  const Image beauty = read_exr_beauty(frame.files[0]);
  return shrink_image(develop_display(beauty, colors, frame.job.display, frame.job.exposure_ev), side);
}

class Turntable {
 public:
  Turntable(TurntableFlags& flags, const std::string& words)
      : flags_(flags), colors_(flags.picture.ocio, flags.picture.working) {
    PictureFlags& p = flags_.picture;
    set_exr_threads(p.render.threads);
    p.display = settle_display(p.display, colors_);
    p.scene.from_all_around = flags_.turn != "light";
    scene_ = assemble_scene(p.scene, colors_, report_);
    if (const std::string fault = display_fault(p.display, colors_); !fault.empty())
      report_.warnings.push_back(fault);
    const Turn turn = Turn(std::find(turn_names().begin(), turn_names().end(), flags_.turn) - turn_names().begin());
    report_.metered_ev = turntable_exposure(scene_.environment, turn, p.scene.camera.azimuth_deg,
                                            p.scene.environment_ev, flags_.degrees);
    start_ = start_turntable(scene_, p.scene.camera, turn);
    set_turning_stage(scene_, start_, p.scene.stage);
    p.scene.from_all_around = true;  // one plan for all frames
    job_ = plan_picture(p, report_, scene_, colors_, words);
  }

  std::vector<Frame> frames(const std::vector<int>& numbers) const {
    std::vector<Frame> all;
    for (const int number : numbers) {
      Frame frame;
      frame.number = number;
      frame.angle = flags_.degrees * (number - 1) / flags_.count;
      for (const std::string& output : flags_.picture.outputs) frame.files.push_back(frame_name(output, number));
      frame.job = job_;
      frame.job.turn = fmt::format("{} {}", flags_.turn, frame.angle);
      all.push_back(frame);
    }
    return all;
  }

  bool is_finished(const Frame& frame) const {
    const std::string hash = job_hash(frame.job, report_);
    return !flags_.redo && std::all_of(frame.files.begin(), frame.files.end(), [&](const std::string& file) {
      return is_finished_picture(file, hash, frame.job.render.stop);
    });
  }

  RenderResult render_frame(const Frame& frame, Progress& progress, WrittenPictures& pictures) {
    pose_turntable(scene_, start_, frame.angle);
    const auto& files = frame.files;
    Film film(job_.scene.width, job_.scene.height, keeps_layers());
    const RenderResult result = render(
        scene_, frame.job.render, film, [&](const RenderState& state) { progress.update(state); }, &interrupted);
    PictureContent content{&film,
                           frame.job.render.crop,
                           frame.job.layers,
                           frame.job.display,
                           frame.job.exposure_ev,
                           picture_attributes(frame.job, report_, result)};
    const std::optional<References> references = references_of(flags_.picture, frame.job, scene_, colors_);
    if (references) content.overlay = &references->overlay;
    const bool partial = result.reason == StopReason::interrupted;
    // Whoever waits for a frame shall not find the beginning of one, even where none is there yet.
    if (!partial || result.samples > 0)
      pictures = write_pictures(partial ? partial_names(files, true) : files, content, colors_, job_.render.threads);
    return result;
  }

  bool keeps_layers() const {
    const auto& outputs = flags_.picture.outputs;
    return !job_.layers.empty() &&
           std::any_of(outputs.begin(), outputs.end(), [](const auto& o) { return is_exr(o); });
  }

  const ColorManager& colors() const { return colors_; }
  const PictureJob& job() const { return job_; }
  const SceneReport& report() const { return report_; }

 private:
  TurntableFlags& flags_;
  ColorManager colors_;
  SceneReport report_;
  Scene scene_;
  TurntableStart start_;
  PictureJob job_;
};

/// A sheet of the frames that are there.
void write_sheet(const TurntableFlags& flags, const Turntable& turntable, const std::vector<Frame>& frames) {
  // A sheet is looked at as a whole: about 2,400 pixels wide however many frames there are.
  const int side = std::clamp(int(2400 / std::ceil(std::sqrt(double(frames.size()) * 1.5))), 48, 320);
  std::vector<SheetPicture> pictures;
  for (const Frame& frame : frames) try {
      pictures.push_back(
          {read_small(frame, turntable.colors(), side), fmt::format("{}: {:.4g} deg", frame.number, frame.angle)});
    } catch (const InputError& error) {
      print_warning(fmt::format("the sheet leaves frame {} out: {}", frame.number, error.diagnostics[0].message));
    }
  if (pictures.empty()) throw OperationError(fmt::format("{}: not written: no frame is there", flags.sheet));
  write_display_image(flags.sheet, contact_sheet(pictures, flags.labels));
  print_note("wrote " + flags.sheet);
}
}  // namespace

int run_turntable(const std::vector<std::string>& words) {
  TurntableFlags flags;
  Command command("turntable",
                  "Renders an orbit: numbered frames of a turning object, camera or light, and a sheet of them.",
                  "[--turn object|camera|light] [-n N] [--look NAME] [--mesh FILE] -o NAME.####.png [flags]");
  describe(command, flags);
  if (!command.parse(words)) return done;
  settle_picture_flags(command, flags.picture);
  const std::vector<int> numbers =
      parse_frames(flags.frames.empty() ? fmt::format("1-{}", flags.count) : flags.frames);
  const std::vector<NamedFile> to_write = check_names(flags, numbers);
  if (flags.motion_blur > 0 && flags.turn == "light")
    throw InputError("--motion-blur with --turn light: nothing that is seen moves", "leave one of them out");
  flags.picture.scene.stage.shutter_deg = float(flags.motion_blur * flags.degrees / flags.count);

  Turntable turntable(flags, recorded_line("turntable", words));
  check_not_read(to_write, config_input(flags.picture.ocio));
  const PictureFlags& picture = flags.picture;
  print_scene(picture, turntable.job(), turntable.report());
  if (!picture.dry_run) check_picture_memory(picture, turntable.keeps_layers());
  const std::vector<Frame> frames = turntable.frames(numbers);
  std::vector<bool> finished;
  for (const Frame& frame : frames) finished.push_back(turntable.is_finished(frame));
  const int open = int(std::count(finished.begin(), finished.end(), false));
  print_note(fmt::format(
      "{} frame{}{}", frames.size(), frames.size() == 1 ? "" : "s",
      open < int(frames.size()) ? fmt::format(", {} of them finished already", int(frames.size()) - open) : ""));
  JsonWriter w;
  w.open_object().member("dry_run", picture.dry_run);
  write_job(w, picture, turntable.job(), turntable.report());
  w.member("turn", flags.turn)
      .member("count", flags.count)
      .member("degrees", flags.degrees)
      .key("frames")
      .open_list();

  int code = done;
  Endings endings;
  Progress progress(picture.progress, progress_writer(picture.progress), std::max(open, 1));
  const StopOnSignal stop_on_signal;
  for (size_t i = 0; i < frames.size() && !interrupted; ++i) {
    const Frame& frame = frames[i];
    w.open_object()
        .member("frame", frame.number)
        .member("angle_deg", frame.angle)
        .member("skipped", bool(finished[i]));
    w.member("job", job_hash(frame.job, turntable.report()));
    if (!finished[i] && !picture.dry_run) {
      WrittenPictures pictures;
      const RenderResult result = turntable.render_frame(frame, progress, pictures);
      write_result(w, result, pictures);
      progress.clear_line();
      endings.tell(turntable.job(), pictures);
      if (result.reason == StopReason::interrupted || picture.verbose || result.rays.non_finite > 0)
        print_result_line(frame.job, result);
      code = std::max(code, picture_code(picture, result));
      if (result.reason != StopReason::interrupted) progress.finish_part();
    } else if (picture.dry_run && !finished[i]) {
      for (const std::string& file : frame.files)
        print_note(fmt::format("would write {}  at {:.4g} degrees", file, frame.angle));
    }
    w.close();
  }
  if (interrupted) {
    progress.stopped();
    code = 128 + signal_received();
  } else if (!flags.sheet.empty() && !picture.dry_run) {
    endings.attempt([&] { write_sheet(flags, turntable, frames); });
  } else if (!flags.sheet.empty()) {
    print_note(fmt::format("would write {}  a sheet of all frames", flags.sheet));
  }
  if (!picture.dry_run) progress.done();
  code = endings.code(code);
  w.close().member("exit_code", code).close();
  endings.attempt([&] { write_stats(picture, w.text()); });
  return endings.code(code);
}

}  // namespace sateen::app
