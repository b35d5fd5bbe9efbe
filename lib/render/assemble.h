#pragma once
#include <functional>
#include <string>
#include <vector>

#include "image/color.h"
#include "render/approximations.h"
#include "render/stage.h"
#include "scene/scene.h"

namespace sateen {

inline constexpr const char* default_look = "champagne_silk_satin";
inline constexpr const char* default_mesh = "drape";
inline constexpr const char* default_environment = "studio_softboxes";

/// What a quad takes while rendering, in the mesh and in Embree, as measured (docs/numbers.md).
inline constexpr std::int64_t bytes_per_quad = 150;

/// A scene as a user asks for it: names, paths and human units, a default on everything.
struct SceneSettings {
  std::string look = default_look;
  std::vector<std::string> look_overrides;  ///< "warp.gamma_s_deg=4"
  std::string mesh = default_mesh;          ///< a built-in shape or the path of an OBJ
  std::string up = "y";                     ///< or "z": the axis of the mesh that points upwards
  bool weld = false;                        ///< joins borders of the mesh that coincide (mesh/weld.h)
  int level = -1;                           ///< subdivision, 0 to 6; -1: what the view asks for (mesh/detail.h)
  bool from_all_around = false;             ///< object or camera turn: the level suits every side
  float warp_angle_deg = 0;                 ///< added to the look's own
  float uv_metres = 0;                      ///< cloth that one UV unit spans; 0: as the mesh says
  std::string environment = default_environment;
  std::string environment_space;  ///< colour space of the map; empty: as the file says
  std::string environment_layer;  ///< of an OpenEXR map; empty: chosen (image/exr_layers.h)
  float environment_rotation_deg = 0;
  float environment_ev = 0;
  CameraSettings camera;
  int width = 960, height = 540;
  Backdrop backdrop = Backdrop::none;
  Color backdrop_color{0, 0, 0};
  StageSettings stage;
  Approximations approximations;
  int threads = 0;
};

/// What the assembly found out, for people and for the picture's metadata.
struct SceneReport {
  Look look;
  std::string look_hash, mesh_hash, environment_hash;
  std::int64_t cage_faces = 0, triangles = 0, tracer_bytes = 0;
  int level = 0;
  float metres_per_uv = 0;  ///< the cloth's size, asked for or as the mesh says; 0: nothing says it
  float metered_ev = 0;     ///< display exposure that the light asks for (render/exposure.h)
  double look_seconds = 0, mesh_seconds = 0, environment_seconds = 0, tracer_seconds = 0;  ///< wall clock
  std::vector<std::string> warnings;
};

/// Reads, compiles and joins everything that a picture needs. Look, mesh and map are worked on side by side.
Scene assemble_scene(const SceneSettings& settings, const ColorManager& colors, SceneReport& report);

/// Compiles the look, and the one of its back, into a scene; textures of a stated size go by `metres_per_uv`. Returns
/// warnings.
std::vector<std::string> compile_looks(const Look& look, const SceneSettings& settings, const ColorManager& colors,
                                       float metres_per_uv, Scene& scene);

/// Reads the light that the settings name, at the size that they ask for.
Environment read_light(const SceneSettings& settings, const ColorManager& colors);

}  // namespace sateen
