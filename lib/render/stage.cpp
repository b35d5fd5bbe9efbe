#include "render/stage.h"

#include <fmt/format.h>

#include <numbers>

namespace sateen {

const std::vector<std::string>& ground_names() {
  static const std::vector<std::string> names{"none", "catcher", "floor", "cyclorama"};
  return names;
}

std::optional<Shutter> shutter_of(const Mesh& mesh, double degrees, bool camera) {
  if (degrees == 0) return std::nullopt;
  Shutter shutter;
  shutter.pivot = (mesh.bounds_min + mesh.bounds_max) * 0.5f;
  (camera ? shutter.camera_angle : shutter.object_angle) = float(degrees * std::numbers::pi / 180);
  return shutter;
}

void set_stage(Scene& scene, const StageSettings& settings, int threads) {
  scene.ground.reset();
  scene.lens.reset();
  if (settings.ground) scene.ground = compile_ground(*settings.ground, *scene.mesh, scene.camera, scene.environment);
  if (settings.lens) scene.lens = compile_lens(*settings.lens, *scene.mesh, *scene.rays, scene.camera);
  scene.shutter = shutter_of(*scene.mesh, double(settings.shutter_deg), false);
  if (scene.backdrop == Backdrop::blurred && !scene.blurred)
    scene.blurred = blur_environment(scene.environment, settings.backdrop_blur_deg, threads);
  renew_openness(scene);
}

std::string ground_text(const StageSettings& settings) {
  if (!settings.ground) return ground_names()[0];
  const GroundSettings& g = *settings.ground;
  const std::string height = g.height ? fmt::format("{}", *g.height) : "auto";
  return fmt::format("{}, height {}, colour {} {} {}", ground_names()[size_t(g.kind) + 1], height, g.color.x,
                     g.color.y, g.color.z);
}

std::string lens_text(const StageSettings& settings) {
  if (!settings.lens) return "none";
  const LensSettings& l = *settings.lens;
  const std::string focus = l.focus ? fmt::format("{} m", *l.focus) : "auto";
  return fmt::format("f/{}, focus {}, {} blades, {} m a unit", l.f_stop, focus, l.blades, l.metres_per_unit);
}

}  // namespace sateen
