#include "render/metadata.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/files.h"
#include "look/describe.h"

namespace sateen {

namespace {
const char* const finished_by_samples = "samples";

std::string backdrop_text(const PictureJob& job) {
  const Color& c = job.scene.backdrop_color;
  switch (job.scene.backdrop) {
    case Backdrop::environment:
      return "environment";
    case Backdrop::plain:
      return fmt::format("{} {} {}", c.x, c.y, c.z);
    case Backdrop::blurred:
      return fmt::format("blurred {}", job.scene.stage.backdrop_blur_deg);
    case Backdrop::none:
      break;
  }
  return "none";
}
}  // namespace

std::string stop_reason_text(StopReason reason) {
  switch (reason) {
    case StopReason::samples:
      return finished_by_samples;
    case StopReason::error:
      return "error";
    case StopReason::time:
      return "time";
    case StopReason::rare:
      return "rare samples";
    case StopReason::interrupted:
      break;
  }
  return "interrupted";
}

std::string underscored(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

std::vector<Fact> sampling_facts(const PictureJob& job, const SceneReport& report) {
  const SceneSettings& s = job.scene;
  const CameraSettings& c = s.camera;
  const RenderSettings& r = job.render;
  const auto number = [](const auto& v) { return fmt::format("{}", v); };
  const auto named = [](const std::string& name, const std::string& hash) { return name + " (" + hash + ")"; };
  std::vector<Fact> facts{
      {"version", job.version, {}},
      {"look", report.look_hash, named(report.look.name, report.look_hash)},
      {"mesh", report.mesh_hash, named(s.mesh, report.mesh_hash)},
      {"map", report.environment_hash, named(s.environment, report.environment_hash)},
      {"level", number(report.level), {}},
      {"warp angle", number(s.warp_angle_deg), {}},
      {"uv metres", number(s.uv_metres), {}},
      {"map space", s.environment_space, {}},
      {"map rotation", number(s.environment_rotation_deg), {}},
      {"map exposure", number(s.environment_ev), {}},
      {"backdrop", backdrop_text(job), {}},
      {"ground", ground_text(s.stage), {}},
      {"lens", lens_text(s.stage), {}},
      {"shutter", number(s.stage.shutter_deg), {}},
      {"turn", job.turn, {}},
      {"azimuth", number(c.azimuth_deg), {}},
      {"elevation", number(c.elevation_deg), {}},
      {"fov", number(c.fov_deg), {}},
      {"margin", number(c.margin), {}},
      {"zoom", number(c.zoom), {}},
      {"size", fmt::format("{} x {}", s.width, s.height), {}},
      {"crop", fmt::format("{} {} {} {}", r.crop.x0, r.crop.y0, r.crop.x1, r.crop.y1), {}},
      {"strategy", strategy_name(r.light.strategy), {}},
      {"candidates", candidates_text(r.light.candidates), {}},
      {"bounces", number(r.light.bounces), {}},
      {"bounce share", number(r.light.bounce_share), {}},
      {"seed", number(r.seed), {}},
      {"adaptive", r.adaptive ? "yes" : "no", {}},
      {"layer albedo", r.albedo_layer ? "yes" : "no", {}},
      {"effects", job.effects, {}},
      {"colour config", job.color_config, {}},
      {"working space", job.working_space, {}},
  };
  for (const Approximation& each : approximation_list())
    facts.push_back({each.name, each.text(s.approximations), {}});
  return facts;
}

std::string job_hash(const PictureJob& job, const SceneReport& report) {
  const RenderSettings& r = job.render;
  Hash hash;
  const auto add = [&](const auto&... values) {
    // A separator between all parts, so that "a" "bc" is not "ab" "c".
    (hash.add(fmt::format("{}", values)).add("\n"), ...);
  };
  for (const Fact& fact : sampling_facts(job, report)) add(fact.value);
  add(r.stop.spp, r.stop.error, r.stop.seconds, job.first_sample);
  add(job.display.display, job.display.view, job.exposure_ev);
  if (job.references) add("references");
  add(job.display.transparent, job.display.ground.has_value());
  if (job.display.ground) add(job.display.ground->x, job.display.ground->y, job.display.ground->z);
  for (const std::string& layer : job.layers) add(layer);
  return hash.hex();
}

Attributes picture_attributes(const PictureJob& job, const SceneReport& report, const RenderResult& result) {
  const SceneSettings& s = job.scene;
  const RenderSettings& r = job.render;
  Attributes a;
  const auto real = [&](const char* name, double value) { a[std::string("sateen:") + name] = value; };
  const auto whole = [&](const char* name, long long value) {
    // EXR's integers have 32 bits.
    a[std::string("sateen:") + name] = int(std::min<long long>(value, 0x7fffffff));
  };
  const auto text = [&](const char* name, const std::string& value) { a[std::string("sateen:") + name] = value; };
  a["Software"] = "sateen " + job.version;
  text("version", job.version);
  text("command", job.command_line);
  text("job", job_hash(job, report));
  text("look", write_look(report.look));
  text("look_name", report.look.name);
  text("look_hash", report.look_hash);
  text("mesh", s.mesh);
  text("mesh_hash", report.mesh_hash);
  whole("level", report.level);
  text("map", s.environment);
  text("map_hash", report.environment_hash);
  real("map_rotation", double(s.environment_rotation_deg));
  real("map_exposure", double(s.environment_ev));
  real("azimuth", double(s.camera.azimuth_deg));
  real("elevation", double(s.camera.elevation_deg));
  real("fov", double(s.camera.fov_deg));
  real("zoom", double(s.camera.zoom));
  text("backdrop", backdrop_text(job));
  if (job.references) text("references", "yes");
  if (s.stage.ground) text("ground", ground_text(s.stage));
  if (s.stage.lens) text("lens", lens_text(s.stage));
  if (s.stage.shutter_deg != 0) real("shutter_deg", double(s.stage.shutter_deg));
  if (!job.turn.empty()) text("turn", job.turn);
  if (r.crop.x1 > r.crop.x0)
    text("crop", fmt::format("{} {} {} {} of {} {}", r.crop.x0, r.crop.y0, r.crop.x1, r.crop.y1, s.width, s.height));
  text("strategy", strategy_name(r.light.strategy));
  text("candidates", candidates_text(r.light.candidates));
  if (!job.candidates_reason.empty()) text("candidates_reason", job.candidates_reason);
  whole("bounces", r.light.bounces);
  for (const Approximation& each : approximation_list())
    text(underscored(each.name).c_str(), each.text(s.approximations));
  real("bounce_share", double(r.light.bounce_share));
  text("effects", job.effects);
  text("plan", plan_json(job.plan));
  whole("seed", r.seed);
  text("adaptive", r.adaptive ? "yes" : "no");
  if (job.first_sample > 0) whole("samples_from", job.first_sample);
  whole("spp", result.samples);
  if (r.stop.spp > 0) whole("spp_asked", r.stop.spp);
  if (r.stop.error > 0) real("error_asked", r.stop.error);
  if (r.stop.seconds > 0) real("seconds_asked", r.stop.seconds);
  if (result.error.known) {
    real("error", result.error.error);
    real("error_low", result.error.low);
    real("error_high", result.error.high);
    real("deviation_95", result.deviation);
  }
  // Which of several rules will be met first is a question of time, and so is what is promised of the others.
  if (const Promise& p = result.promise; p.made && job.timings) {
    const auto forecast = [&](const std::string& name, const Forecast& f) {
      real(("promised_" + name).c_str(), f.value);
      real(("promised_" + name + "_low").c_str(), f.low);
      real(("promised_" + name + "_high").c_str(), f.high);
    };
    forecast("error", p.error);
    forecast("seconds", p.seconds);
    forecast("cpu_seconds", p.cpu_seconds);
  }
  text("stopped_by", stop_reason_text(result.reason));
  if (job.timings) {
    real("seconds", result.seconds);
    real("cpu_seconds", result.cpu_seconds);
  }
  whole("non_finite", result.rays.non_finite);
  text("working_space", job.working_space);
  text("color_config", job.color_config);
  text("display", job.display.display);
  text("view", job.display.view);
  real("exposure", double(job.exposure_ev));
  return a;
}

namespace {
bool may_give_way(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::exists(path, code) || std::filesystem::file_size(path, code) == 0) return true;
  try {
    const Attributes a = read_attributes(path);
    const auto reason = a.find("sateen:stopped_by");
    const auto* by = reason == a.end() ? nullptr : std::get_if<std::string>(&reason->second);
    return by && *by == stop_reason_text(StopReason::interrupted);
  } catch (const std::exception&) {
    return false;
  }
}
}  // namespace

std::vector<std::string> partial_names(const std::vector<std::string>& paths, bool always) {
  std::vector<std::string> names;
  for (const std::string& path : paths) {
    std::filesystem::path name = path;
    const auto taken = [&] {
      return name != path && (std::find(paths.begin(), paths.end(), name.string()) != paths.end() ||
                              std::find(names.begin(), names.end(), name.string()) != names.end());
    };
    while (taken() || (always && name == path) || !may_give_way(name))
      name.replace_filename(name.stem().string() + ".partial" + name.extension().string());
    names.push_back(name.string());
  }
  return names;
}

bool is_finished_picture(const std::filesystem::path& path, const std::string& hash, const StopRules& stop) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return false;
  try {
    const Attributes a = read_attributes(path);
    const auto job = a.find("sateen:job"), reason = a.find("sateen:stopped_by"), spp = a.find("sateen:spp");
    if (job == a.end() || reason == a.end() || spp == a.end()) return false;
    const auto* text = std::get_if<std::string>(&job->second);
    const auto* by = std::get_if<std::string>(&reason->second);
    const int* samples = std::get_if<int>(&spp->second);
    if (!text || !by || !samples || *text != hash || *by == stop_reason_text(StopReason::interrupted)) return false;
    if (*by == finished_by_samples && *samples != stop.spp) return false;
    return *samples > 0 && image_decodes(path);
  } catch (const std::exception&) {
    return false;  // a file that cannot be read is simply made again
  }
}

}  // namespace sateen
