#pragma once
#include <algorithm>
#include <cmath>
#include <fstream>

#include "image/file.h"
#include "render/candidates.h"
#include "render/error_scenes.h"

// Claimed errors held against real ones: references of many samples from another seed, and scenes with heavy tails.

namespace sateen_test {

/// A scene with its reference.
struct JudgedScene {
  std::string name;
  sateen::Scene scene;
  sateen::RenderSettings settings;  ///< with the pilot's candidates and the floor of E
  sateen::Film reference;
  bool heavy_tails = false;
};

inline sateen::ErrorScale scale_of(const sateen::RenderSettings& settings) {
  return {settings.error_floor, settings.threads};
}

/// What a picture is off by, relative as E is and weighed by the reference's coverage, without the reference's own
/// share; over the backing that is worse.
inline double real_error(const sateen::Film& film, const sateen::Film& reference, const sateen::ErrorScale& scale) {
  double worst = 0;
  for (const double backing : sateen::backings(reference, scale)) {
    double sum = 0, weight = 0;
    for (size_t i = 0; i < film.pixels.size(); ++i) {
      if (film.pixels[i].samples == 0) continue;
      const sateen::FilmPixel truth = sateen::laid_over(reference.pixels[i], backing);
      const sateen::Color a = sateen::pixel_mean(sateen::laid_over(film.pixels[i], backing));
      const sateen::Color b = sateen::pixel_mean(truth);
      const sateen::Vec3d own = sateen::pixel_variance(truth);
      const double coverage = sateen::pixel_coverage(reference.pixels[i]);
      for (int c = 0; c < 3; ++c) {
        const double off = double(a[c]) - double(b[c]);
        sum += coverage * (off * off - own[c]) / (double(b[c]) * double(b[c]) + scale.floor * scale.floor) / 3;
      }
      weight += coverage;
    }
    if (weight > 0) worst = std::max(worst, std::sqrt(std::max(sum, 0.0) / weight));
  }
  return worst;
}

inline JudgedScene judged_scene(const std::string& name, sateen::SceneSettings settings, int bounces,
                                int reference_samples) {
  static const sateen::ColorManager colors("built-in");
  sateen::SceneReport report;
  settings.level = 2;
  JudgedScene judged{name, sateen::assemble_scene(settings, colors, report), {}, {}};
  judged.settings.threads = 2;
  judged.settings.light.bounces = bounces;
  judged.settings.error_floor = sateen::error_floor_at(double(report.metered_ev));
  judged.settings.light.candidates =
      sateen::choose_candidates(judged.scene, judged.settings.light, judged.settings.error_floor, 1, 0).candidates;
  judged.settings.seed = 777;
  judged.settings.stop.spp = reference_samples;
  judged.reference = sateen::Film(settings.width, settings.height, false);
  render(judged.scene, judged.settings, judged.reference);
  return judged;
}

inline JudgedScene judged_scene(const ErrorScene& s, int width, int height, int reference_samples) {
  sateen::SceneSettings settings = scene_settings(s.look, width, height);
  settings.mesh = s.mesh;
  settings.environment = map_path(s.map);
  return judged_scene(name_of(s), settings, s.bounces, reference_samples);
}

/// A crumpled sheet, 27 x 27 quads: ridges in all directions, so that folds see each other.
inline void write_crumpled_sheet(const std::filesystem::path& path, int seed) {
  constexpr int n = 28;
  std::ofstream out(path);
  const auto wave = [&](int k) { return std::fmod(std::abs(std::sin(12.9898 * (k + 17 * seed)) * 43758.5453), 1.0); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double u = double(i) / (n - 1), v = double(j) / (n - 1);
      double z = -0.5;
      for (int k = 0; k < 60; ++k) {
        const double fu = 24 * (wave(3 * k) - 0.5), fv = 24 * (wave(3 * k + 1) - 0.5);
        z += 0.09 * std::abs(std::sin(fu * u + fv * v + 6.28 * wave(3 * k + 2))) / std::sqrt(1 + std::hypot(fu, fv));
      }
      out << "v " << 2 * u - 1 << " " << 2 * v - 1 << " " << z << "\nvt " << u << " " << v << "\n";
    }
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i + 1;
      for (const int k : {a, a + 1, a + n + 1, a + n}) out << (k == a ? "f " : " ") << k << "/" << k;
      out << "\n";
    }
}

/// A sun of one texel of a map of 128 x 64 that is dark elsewhere.
inline void write_small_sun(const std::filesystem::path& path, int x, int y, float light) {
  sateen::ImageLayer layer;
  layer.channels = {"R", "G", "B"};
  layer.image = sateen::Image(128, 64, 3);
  std::fill(layer.image.pixels.begin(), layer.image.pixels.end(), 0.05f);
  for (int c = 0; c < 3; ++c) layer.image.at(x, y)[c] = light * (1 - 0.1f * float(c));
  sateen::write_exr(path, {layer}, {}, {});
}

/// Light that few samples carry: narrow lobes of threads, a sun of one texel before or behind, light by way of other
/// cloth. 12 of them.
struct HeavyScene {
  const char *name, *look;
  std::vector<const char*> overrides;
  bool from_behind;
  int bounces;
};
inline const std::vector<HeavyScene>& heavy_scenes() {
  const std::vector<const char*> sharp{"warp.eta=3", "weft.eta=3", "warp.gamma_s_deg=0.5", "weft.gamma_s_deg=0.5"};
  std::vector<const char*> sheer = sharp;
  for (const char* gap : {"warp.coverage=0.3", "weft.coverage=0.3"}) sheer.push_back(gap);
  static const std::vector<HeavyScene> all{
      {"sharp satin, sun behind", "polyester_satin_charmeuse", sharp, true, 2},
      {"sharp satin, sun before", "polyester_satin_charmeuse", sharp, false, 2},
      {"sharp sheer, sun behind", "polyester_satin_charmeuse", sheer, true, 2},
      {"sharp sheer, sun before", "polyester_satin_charmeuse", sheer, false, 2},
      {"champagne, sun behind", "champagne_silk_satin", {}, true, 2},
      {"champagne, sun before", "champagne_silk_satin", {}, false, 2},
      {"black charmeuse, sun behind", "black_charmeuse", {}, true, 3},
      {"ivory, sun behind", "ivory_duchess_satin", {}, true, 3},
      {"emerald, sun before", "emerald_satin", {}, false, 3},
      {"organza, sun behind", "silk_organza", {}, true, 2},
      {"shot taffeta, sun behind", "shot_taffeta", {}, true, 2},
      {"sharp crepe, sun behind", "silk_crepe_de_chine", {"warp.gamma_s_deg=0.5", "weft.gamma_s_deg=0.5"}, true, 3},
  };
  return all;
}

inline JudgedScene judged_scene(const HeavyScene& s, const std::filesystem::path& folder, int width, int height,
                                int reference_samples) {
  write_crumpled_sheet(folder / "sheet.obj", 1);
  write_small_sun(folder / "sun.exr", s.from_behind ? 64 : 0, 20, 20000);
  sateen::SceneSettings settings = scene_settings(s.look, width, height);
  for (const char* each : s.overrides) settings.look_overrides.push_back(each);
  settings.mesh = (folder / "sheet.obj").string();
  settings.environment = (folder / "sun.exr").string();
  JudgedScene judged = judged_scene(s.name, settings, s.bounces, reference_samples);
  judged.heavy_tails = true;
  return judged;
}

}  // namespace sateen_test
