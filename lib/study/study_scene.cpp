#include "study/study_scene.h"

#include <algorithm>
#include <filesystem>

#include "base/files.h"
#include "scene/environment_file.h"

namespace sateen {

const std::vector<std::string>& study_looks() {
  static const std::vector<std::string> all{"polyester_satin_charmeuse", "silk_crepe_de_chine", "velvet"};
  return all;
}

const std::vector<std::string>& study_lights() {
  static const std::vector<std::string> all{white_light, "studio_softboxes", "overcast",
                                            "low_sun",   "three_light_rig",  "interior"};
  return all;
}

std::string study_map(const std::string& light) {
  if (light != "interior") return light;
  const std::vector<std::string> known = environment_names();
  if (std::find(known.begin(), known.end(), light) != known.end()) return light;
  const std::filesystem::path beside = data_folder().parent_path() / "shared" / "hdri" / "interior.exr";
  std::error_code error;
  return std::filesystem::exists(beside, error) ? beside.string() : std::string();
}

std::string light_label(const std::string& map) {
  return std::filesystem::path(map).stem().string();
}

Scene assemble_study_scene(SceneSettings settings, const ColorManager& colors, SceneReport& report) {
  if (settings.environment != white_light) return assemble_scene(settings, colors, report);
  settings.environment = "overcast";  // read and thrown away: a scene is assembled with a map
  Scene scene = assemble_scene(settings, colors, report);
  Image constant(64, 32, 3);
  std::fill(constant.pixels.begin(), constant.pixels.end(), 1.0f);
  EnvironmentOptions options;
  options.name = white_light;
  options.luminance = colors.luminance_weights();
  options.exposure_ev = settings.environment_ev;
  scene.environment = build_environment(std::move(constant), options);
  report.environment_hash = white_light;
  report.metered_ev = metered_exposure_ev(scene.environment);
  return scene;
}

double half_light_share(const Environment& environment) {
  struct Part {
    double luminance, solid_angle;
  };
  std::vector<Part> parts;
  double energy = 0;
  for (int y = 0; y < environment.height; ++y) {
    const double solid_angle =
        environment_row_weight(y, environment.height) / 2 / environment.width;  // of the sphere
    for (int x = 0; x < environment.width; ++x) {
      const Color& c = environment.radiance_at(x, y);
      double luminance = 0;
      for (int i = 0; i < 3; ++i) luminance += double(c[i]) * double(environment.luminance[i]);
      parts.push_back({luminance, solid_angle});
      energy += luminance * solid_angle;
    }
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.luminance > b.luminance; });
  double share = 0, gathered = 0;
  for (const Part& part : parts) {
    if (gathered >= energy / 2) break;
    gathered += part.luminance * part.solid_angle;
    share += part.solid_angle;
  }
  return share;
}

}  // namespace sateen
