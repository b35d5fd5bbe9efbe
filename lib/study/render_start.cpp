#include "study/render_start.h"

#include <fmt/format.h>

#include <atomic>
#include <filesystem>

#include <unistd.h>

#include "base/parallel.h"
#include "render/albedo_map.h"
#include "render/candidates.h"

namespace sateen {

RenderStart start_render(const SceneSettings& settings, const EffectSwitches& effects, const LightSettings& light,
                         double error_floor, std::uint32_t seed, int threads, const ColorManager& colors) {
  RenderStart made;
  made.light = light;
  const double start = cpu_seconds();
  made.scene = assemble_scene(settings, colors, made.report);
  const double assembled = cpu_seconds();
  made.plan = make_plan(made.scene, made.report.look, {effects, 0, error_floor, light, seed, threads});
  apply_plan(made.plan, made.scene, made.light);
  settle_candidates(made.scene, effects.candidates, made.light, error_floor, seed, threads);
  made.assembly_seconds = assembled - start;
  made.pilot_seconds = cpu_seconds() - assembled;
  return made;
}

double albedo_table_seconds(const Scene& scene, int threads) {
  const double start = cpu_seconds();
  map_albedos(scene, threads);
  return cpu_seconds() - start;
}

namespace {
double writing_seconds(const Film& film, const DisplaySettings& display, float exposure_ev,
                       const ColorManager& colors, int threads) {
  static std::atomic<int> folders = 0;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("sateen_cost_{}_{}", getpid(), folders++);
  std::filesystem::create_directories(folder);
  PictureContent content;
  content.film = &film;
  content.layers = film.layers.empty() ? std::vector<std::string>() : layer_names();
  content.display = display;
  content.exposure_ev = exposure_ev;
  const double start = cpu_seconds();
  std::exception_ptr failure;
  try {
    write_pictures({(folder / "a.png").string(), (folder / "a.exr").string()}, content, colors, threads);
  } catch (...) {
    failure = std::current_exception();
  }
  const double seconds = cpu_seconds() - start;
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (failure) std::rethrow_exception(failure);
  return seconds;
}

}  // namespace

Interval writing_interval(const Film& film, double scale, int repetitions, const DisplaySettings& display,
                          float exposure_ev, const ColorManager& colors, int threads) {
  const auto seconds = [&] { return writing_seconds(film, display, exposure_ev, colors, threads); };
  const double first = seconds();
  std::vector<double> all;
  for (int k = 0; k < repetitions; ++k) all.push_back(seconds());
  const double once = std::max(first - repeated_interval(all).value, 0.0);
  for (double& each : all) each = once + each * scale;
  return repeated_interval(all);
}

}  // namespace sateen
