#pragma once
#include <functional>
#include <string>
#include <vector>

#include "integrator/path.h"
#include "scene/scene.h"

// Scenes for the tests of light: looks of the project, built-in and made meshes, made maps.

namespace sateen_test {

/// A look of looks/ or any other, compiled once a process in its own colour space.
const sateen::Look& shipped_look(const std::string& name);
sateen::Fabric fabric_of(const sateen::Look& look);
/// A shipped look with volume colours so bright that much light bounces.
sateen::Look bright(const std::string& name);

/// A built-in shape at a subdivision level.
sateen::Mesh shape(const std::string& name, int level);

/// A parallelogram with its normal along along x across; u runs along `along`, v along `across`, flipped on request.
void add_quad(sateen::Mesh& mesh, const sateen::Vec3& middle, const sateen::Vec3& along, const sateen::Vec3& across,
              bool mirrored = false);
/// A square of that size around the origin that looks to +Y (warp along +X).
sateen::Mesh floor_quad(float size = 1);

/// In-memory maps.
sateen::Environment map_of(int width, int height, const std::function<sateen::Color(int, int)>& color,
                           float rotation = 0);
sateen::Environment constant_map(float value = 1);
/// Coloured, brighter above, without small lights.
sateen::Environment soft_map();

sateen::Scene make_scene(sateen::Mesh mesh, sateen::Fabric front, sateen::Environment environment);

/// A pinhole so far away that the whole picture has one view direction to 1e-6 rad; `towards` leads from the object
/// to the camera. Covers about `extent` around `middle`.
sateen::Camera distant_camera(const sateen::Vec3& middle, const sateen::Vec3& towards, float extent, int width = 1,
                              int height = 1);

/// Every way to estimate light: all strategies, resampling with several numbers of candidates.
struct NamedSettings {
  std::string name;
  sateen::LightSettings light;
};
std::vector<NamedSettings> all_settings(int bounces = 0);

/// True where the strategy draws from the map: it finds lights of any size.
inline bool knows_the_map(const sateen::LightSettings& light) {
  using sateen::Strategy;
  if (light.strategy == Strategy::resampled) return light.candidates.map > 0;
  return light.strategy != Strategy::uniform && light.strategy != Strategy::talk && light.strategy != Strategy::table;
}

}  // namespace sateen_test
