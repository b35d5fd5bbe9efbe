#pragma once
#include <string>

#include "base/files.h"
#include "film/film.h"
#include "render/assemble.h"
#include "render/render.h"

// Scenes and film as the program makes them, for the tests of rendering.

namespace sateen_test {

inline std::string look_path(const std::string& name) {
  return SATEEN_SOURCE_DIR "/looks/" + name + ".json";
}
inline std::string map_path(const std::string& name) {
  return SATEEN_SOURCE_DIR "/envmaps/" + name + ".exr";
}

inline sateen::SceneSettings scene_settings(const std::string& look, int width, int height) {
  sateen::SceneSettings settings;
  settings.look = look_path(look);
  settings.environment = map_path("studio_softboxes");
  settings.level = 1;
  settings.width = width;
  settings.height = height;
  settings.threads = 2;
  return settings;
}

inline sateen::Scene scene_of(const sateen::SceneSettings& settings) {
  static const sateen::ColorManager colors("built-in");
  sateen::SceneReport report;
  return sateen::assemble_scene(settings, colors, report);
}

inline sateen::RenderSettings samples(int spp, std::uint32_t seed = 1) {
  sateen::RenderSettings settings;
  settings.stop.spp = spp;
  settings.seed = seed;
  settings.threads = 2;
  return settings;
}

/// Every bit of a film: neither struct has padding.
inline std::string film_hash(const sateen::Film& film) {
  static_assert(sizeof(sateen::FilmPixel) == (4 * sateen::replicates + 1) * 8);
  static_assert(sizeof(sateen::LayerPixel) == (30 + 3 + 9 + 2 + 1) * 4);
  return sateen::Hash()
      .add_bytes(film.pixels.data(), film.pixels.size() * sizeof(sateen::FilmPixel))
      .add_bytes(film.layers.data(), film.layers.size() * sizeof(sateen::LayerPixel))
      .hex();
}

}  // namespace sateen_test
