#include "picture_report.h"

#include <fmt/format.h>

#include <cmath>

#include "base/files.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "console.h"
#include "exit_code.h"
#include "mesh/check_cage.h"
#include "render/candidates.h"
#include "signals.h"

namespace sateen::app {

namespace {
std::string size_text(long long bytes) {
  if (bytes < 10'000) return fmt::format("{} bytes", bytes);
  return bytes < 1'000'000 ? fmt::format("{:.0f} kB", double(bytes) / 1e3)
                           : fmt::format("{:.1f} MB", double(bytes) / 1e6);
}

std::string count_text(long long n) {
  std::string digits = std::to_string(n), out;
  for (size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) out += ",";
    out += digits[i];
  }
  return out;
}

std::string seconds_text(double s) {
  return s < 60 ? fmt::format("{:.1f} s", s) : clock_text(s);
}

std::string error_text(const PictureError& e) {
  return e.known ? fmt::format("error E {:.4g} (95 %: {:.4g} to {:.4g}){}", e.error, e.low, e.high,
                               e.rests_on_rare_samples ? ", rests on rare samples" : "")
                 : std::string("error not known below 2 samples a pixel");
}

std::string samples_text(int n) {
  return n == 1 ? "1 sample a pixel" : fmt::format("{} samples a pixel", n);
}

std::string rules_text(const StopRules& stop) {
  std::vector<std::string> rules;
  if (stop.spp > 0) rules.push_back(samples_text(stop.spp));
  if (stop.error > 0) rules.push_back(fmt::format("error {}", stop.error));
  if (stop.seconds > 0) rules.push_back(seconds_text(stop.seconds));
  return fmt::format("{}", fmt::join(rules, " or "));
}

std::string reason_text(const StopRules& stop, const RenderResult& result) {
  switch (result.reason) {
    case StopReason::samples:
      return stop.error > 0
                 ? fmt::format("stopped at {} samples a pixel before the error fell to {}", stop.spp, stop.error)
                 : "all samples done";
    case StopReason::error:
      return fmt::format("stopped at the asked error, {}", stop.error);
    case StopReason::time: {
      const std::string time = seconds_text(stop.seconds);
      if (stop.error > 0) return fmt::format("stopped by time ({}) before the error fell to {}", time, stop.error);
      if (stop.spp > 0) return fmt::format("stopped by time ({}) before {} samples a pixel", time, stop.spp);
      return fmt::format("stopped by time ({})", time);
    }
    case StopReason::rare:
      return fmt::format(
          "stopped before the error fell to {}: what few pixels met makes it, and more samples do not "
          "lower it; a small light that is far brighter than all else does that, or cloth like a mirror",
          stop.error);
    case StopReason::interrupted:
      break;
  }
  return "stopped by a signal: the pictures hold the samples that were done";
}

std::string percent_text(double share) {
  return share < 0.995 ? fmt::format("{:.2g} %", 100 * share) : fmt::format("{:.0f} %", 100 * share);
}

// One unit for the three, and no more digits than the interval deserves.
std::string forecast_text(const Forecast& f) {
  if (f.value >= 60) return fmt::format("{} ({} to {})", clock_text(f.value), clock_text(f.low), clock_text(f.high));
  const int digits = f.value < 9.95 ? 1 : 0;
  return fmt::format("{:.{}f} s ({:.{}f} to {:.{}f})", f.value, digits, f.low, digits, f.high, digits);
}

// Not of getrusage(2), which begins with what the process was before it became this program.
long long peak_memory_bytes() {
  return memory_use().peak;
}

}  // namespace

void write_job(JsonWriter& w, const PictureFlags& flags, const PictureJob& job, const SceneReport& report) {
  const SceneSettings& s = job.scene;
  w.member("version", job.version).member("job", job_hash(job, report));
  w.member("look", report.look.name).member("look_hash", report.look_hash);
  w.member("mesh", s.mesh).member("mesh_hash", report.mesh_hash).member("level", report.level);
  w.member("cage_faces", report.cage_faces).member("triangles", report.triangles);
  w.member("map", s.environment).member("map_hash", report.environment_hash);
  w.member("map_rotation_deg", s.environment_rotation_deg).member("map_exposure_ev", s.environment_ev);
  w.key("size").open_list().value(s.width).value(s.height).close();
  w.member("exposure_ev", job.exposure_ev).member("exposure_metered", !flags.exposure_ev);
  w.member("working_space", job.working_space).member("color_config", job.color_config);
  w.member("display", job.display.display).member("view", job.display.view);
  w.member("strategy", strategy_name(job.render.light.strategy))
      .member("candidates", candidates_text(job.render.light.candidates));
  if (!job.candidates_reason.empty()) w.member("candidates_reason", job.candidates_reason);
  w.member("effects", job.effects);
  w.key("plan").open_object();
  write_plan(w, job.plan);
  if (!job.verdicts.empty()) write_verdicts(w, job.verdicts);
  w.close();
  w.member("bounces", job.render.light.bounces).member("bounce_share", job.render.light.bounce_share);
  for (const Approximation& each : approximation_list())
    w.member(underscored(each.name), each.text(s.approximations));
  w.member("seed", job.render.seed);
  w.member("adaptive", job.render.adaptive).member("samples_from", job.first_sample);
  w.member("threads", thread_count(job.render.threads));
  const StopRules& stop = job.render.stop;
  w.key("asked").open_object();
  if (stop.spp > 0) w.member("spp", stop.spp);
  if (stop.error > 0) w.member("error", stop.error);
  if (stop.seconds > 0) w.member("seconds", stop.seconds);
  w.close();
  w.key("assembly_seconds").open_object().member("look", report.look_seconds).member("mesh", report.mesh_seconds);
  w.member("map", report.environment_seconds).member("ray_tracer", report.tracer_seconds).close();
  w.member("ray_tracer_bytes", report.tracer_bytes);
  w.key("warnings").open_list();
  for (const std::string& warning : report.warnings) w.value(warning);
  w.close();
}

void write_stats(const PictureFlags& flags, const std::string& json) {
  if (!flags.stats.empty()) write_text_whole(flags.stats, json + "\n");
  if (voice.json) print_result(json);
}

void print_scene(const PictureFlags& flags, const PictureJob& job, const SceneReport& report) {
  for (const std::string& warning : report.warnings) print_warning(warning);
  const SceneSettings& s = job.scene;
  const float exposure = std::round(job.exposure_ev * 100) / 100 + 0.0f;  // +0.00 and not -0.00
  print_note(fmt::format("{} on {} under {}, {} x {}", report.look.name, s.mesh, s.environment, s.width, s.height));
  print_note(fmt::format("level {}, {} triangles; exposure {:+.2f} EV{}; {}", report.level,
                         count_text(report.triangles), exposure, flags.exposure_ev ? "" : " (metered)",
                         rules_text(job.render.stop)));
  print_detail(fmt::format("colour: {}; working space {}; {}, {}", job.color_config, job.working_space,
                           job.display.display, job.display.view));
  const PlannedEffect& bounces = job.plan.of(Effect::interreflection);
  print_note(fmt::format("interreflection {}: {}", bounces.on ? "on" : "off", bounces.reason));
  // What somebody may look for in the picture and not find.
  for (const PlannedEffect& planned : job.plan.effects)
    if (!planned.on && !planned.missing && planned.effect != Effect::interreflection &&
        effect_info(planned.effect).switchable)
      print_note(fmt::format("{} off: {}", effect_info(planned.effect).name, planned.reason));
  print_note(fmt::format("light sampled by {}", sampling_text(job.render.light, job.candidates_reason)));
  print_detail(
      fmt::format("effects {}, seed {}, {} threads", job.effects, job.render.seed, thread_count(job.render.threads)));
  print_detail(fmt::format("read and built: look {:.2f} s, mesh {:.2f} s, map {:.2f} s, ray tracer {:.2f} s ({})",
                           report.look_seconds, report.mesh_seconds, report.environment_seconds,
                           report.tracer_seconds, size_text(report.tracer_bytes)));
}

std::optional<References> references_of(const PictureFlags& flags, const PictureJob& job, const Scene& scene,
                                        const ColorManager& colors) {
  if (!flags.stage.references) return std::nullopt;
  return make_references(scene.environment, scene.camera, colors, job.display, job.exposure_ev, job.render.threads);
}

void print_references(const References& r) {
  const auto text = [](const Color& c) { return fmt::format("{:.3g} {:.3g} {:.3g}", c.x, c.y, c.z); };
  const auto code = [](const Color& c) {
    return fmt::format("{:.0f} {:.0f} {:.0f}", 255 * c.x, 255 * c.y, 255 * c.z);
  };
  print_note(fmt::format("grey ball of {:.0f} %: mean {}, brightest {}; on the display {}",
                         100 * grey_ball_reflectance, text(r.ball_mean), text(r.ball_brightest), code(r.ball_code)));
  for (const References::Patch& p : r.greys)
    print_note(fmt::format("chart, {} ({:.3g} %): {}; on the display {}", p.name, 100 * p.reflectance, text(p.light),
                           code(p.code)));
}

void write_references(JsonWriter& w, const References& r) {
  const auto list = [&](const char* name, const Color& c) {
    w.key(name).open_list().value(c.x).value(c.y).value(c.z).close();
  };
  w.key("references").open_object().key("grey_ball").open_object();
  w.member("reflectance", grey_ball_reflectance);
  list("mean", r.ball_mean);
  list("brightest", r.ball_brightest);
  list("code", r.ball_code);
  w.close().key("greys").open_list();
  for (const References::Patch& p : r.greys) {
    w.open_object().member("name", p.name).member("reflectance", p.reflectance);
    list("light", p.light);
    list("code", p.code);
    w.close();
  }
  w.close().close();
}

int report_dry_run(const PictureFlags& flags, const PictureJob& job, const SceneReport& report) {
  for (const std::string& output : flags.outputs) print_note(fmt::format("would write {}", output));
  JsonWriter w;
  w.open_object().member("dry_run", true);
  write_job(w, flags, job, report);
  w.key("files").open_list();
  for (const std::string& output : flags.outputs) w.value(output);
  w.close().close();
  write_stats(flags, w.text());
  return 0;
}

void write_result(JsonWriter& w, const RenderResult& result, const WrittenPictures& pictures) {
  w.member("spp", result.samples).member("stopped_by", stop_reason_text(result.reason)).key("error");
  if (result.error.known)
    w.open_object()
        .member("value", result.error.error)
        .member("low", result.error.low)
        .member("high", result.error.high)
        .member("rests_on_rare_samples", result.error.rests_on_rare_samples)
        .close();
  else
    w.null();
  if (result.error.known) w.member("deviation_95", result.deviation);
  if (const Promise& p = result.promise; p.made) {
    const auto forecast = [&](const char* name, const Forecast& f) {
      w.key(name).open_object().member("value", f.value).member("low", f.low).member("high", f.high).close();
    };
    w.key("promise").open_object().member("made_at_seconds", p.made_at_seconds);
    forecast("error", p.error);
    forecast("samples", p.samples);
    forecast("seconds", p.seconds);
    forecast("cpu_seconds", p.cpu_seconds);
    w.close();
  }
  w.member("seconds", result.seconds).member("cpu_seconds", result.cpu_seconds);
  w.member("first_pass_seconds", result.first_pass_seconds).member("peak_memory_bytes", peak_memory_bytes());
  w.key("rays").open_object().member("camera", result.rays.camera).member("shadow", result.rays.shadow);
  w.member("bounce", result.rays.bounce).close().member("non_finite", result.rays.non_finite);
  w.key("files").open_list();
  for (const WrittenPicture& file : pictures.written)
    w.open_object()
        .member("path", file.path.string())
        .member("bytes", file.bytes)
        .member("layers", file.layers)
        .close();
  w.close();
  if (pictures.failures.empty()) return;
  w.key("not_written").open_list();
  for (const std::string& failure : pictures.failures) w.value(failure);
  w.close();
}

void warn_of_half_floats(const std::string& file, const HalfRange& range, const std::string& remedy) {
  if (range.held > 0)
    print_warning(
        fmt::format("{}: {} values were beyond the range of half and were held at 65504", file, range.held));
  if (range.is_dim())
    print_warning(fmt::format("{}: its brightest value is {:.2g}, half floats step by 6e-8 there{}", file,
                              range.brightest, remedy));
}

void print_written(const PictureJob& job, const WrittenPicture& file) {
  const std::string content = file.layers > 0
                                  ? fmt::format("{}, {}", counted(file.layers, "layer"), job.working_space)
                                  : fmt::format("{}, {}", job.display.display, job.display.view);
  print_note(fmt::format("wrote {}  {} x {}, {}, {}", file.path.string(), file.width, file.height, content,
                         size_text(file.bytes)));
  warn_of_half_floats(file.path.string(), file.range, "; --env-exposure brightens the light");
}

void print_result_line(const PictureJob& job, const RenderResult& result) {
  print_note(fmt::format("{} in {}, {}; {}", samples_text(result.samples), seconds_text(result.seconds),
                         error_text(result.error), reason_text(job.render.stop, result)));
  if (result.error.known && result.error.error > 0)
    print_note(
        fmt::format("95 % of the cloth's pixels are within {} of their final value", percent_text(result.deviation)));
  if (result.reason == StopReason::time && !result.error.known)
    print_warning(fmt::format("{} were over before every pixel had two samples: setting up and writing count",
                              seconds_text(job.render.stop.seconds)));
  if (const Promise& p = result.promise; p.made && result.reason != StopReason::interrupted)
    print_note(fmt::format("promised: {}, {:.1f} CPU-s; it took {}, {:.1f} CPU-s", forecast_text(p.seconds),
                           p.cpu_seconds.value, seconds_text(result.total_seconds), result.total_cpu_seconds));
  print_detail(fmt::format(
      "first complete pass after {:.2f} s; {:.1f} CPU-s; rays: {} camera, {} shadow, {} bounce; peak memory {}",
      result.first_pass_seconds, result.cpu_seconds, count_text(result.rays.camera), count_text(result.rays.shadow),
      count_text(result.rays.bounce), size_text(peak_memory_bytes())));
  if (result.rays.non_finite > 0)
    print_warning(
        fmt::format("{} samples were not finite and were left out: please report this with its command line",
                    result.rays.non_finite));
}

void print_promise(const PictureJob& job, const Promise& promise) {
  const bool asked = job.render.stop.error > 0 && promise.error.low == promise.error.high;
  print_note(fmt::format(
      "E {}{} in {}, {:.1f} CPU-s", percent_text(promise.error.value),
      asked ? "" : fmt::format(" ({} to {})", percent_text(promise.error.low), percent_text(promise.error.high)),
      forecast_text(promise.seconds), promise.cpu_seconds.value));
}

int picture_code(const PictureFlags& flags, const RenderResult& result) {
  const StopRules& stop = flags.render.stop;
  if (result.reason == StopReason::interrupted) return 128 + signal_received();
  if (flags.strict && result.rays.non_finite > 0) return not_finite;
  const bool error_missed = stop.error > 0 && result.reason != StopReason::error;
  const bool samples_missed = stop.error <= 0 && stop.spp > 0 && result.reason == StopReason::time;
  return error_missed || samples_missed ? quality_not_reached : done;
}

std::function<void(std::string_view)> progress_writer(ProgressStyle style) {
  const bool farm = style == ProgressStyle::alf || style == ProgressStyle::openjd;
  if (farm && !voice.json) return [](std::string_view text) { print_result(text); };
  return [](std::string_view text) { print_progress(text); };
}

}  // namespace sateen::app
