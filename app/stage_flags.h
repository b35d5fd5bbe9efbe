#pragma once
#include "command.h"
#include "render/assemble.h"

namespace sateen::app {

/// Flags of the stage around the cloth: ground, lens, shutter.
struct StageFlags {
  std::string ground = "none", focus = "auto";
  std::optional<float> height;
  Color color = GroundSettings().color;
  LensSettings lens;
  float f_stop = 0;  ///< 0: a pinhole
  bool references = false;
};

/// A still turns its object by --shutter; a turntable has a flag of its own.
void add_stage_flags(Command& command, StageFlags& flags);
void add_shutter_flag(Command& command, StageSettings& stage);

/// Joins what was given into `stage`. InputError for a part of something that is off.
void settle_stage_flags(const Command& command, const StageFlags& flags, StageSettings& stage);

/// "none", "environment", "blurred[:DEG]", "#rrggbb" or "r,g,b".
void read_backdrop(const std::string& text, SceneSettings& scene, std::optional<Color>& display_ground);

/// "r,g,b", each from `low` to `high`.
Color read_color(const std::string& what, const std::string& text, double low, double high);

}  // namespace sateen::app
