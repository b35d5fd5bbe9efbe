#pragma once
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "render/metadata.h"
#include "render/progress.h"
#include "stage_flags.h"

namespace sateen::app {

/// What `render` and `turntable` are both told about a picture, as typed.
struct PictureFlags {
  SceneSettings scene;
  RenderSettings render;
  DisplaySettings display;
  StageFlags stage;
  std::optional<float> exposure_ev;  ///< empty: metered
  std::vector<std::string> outputs;
  std::string ocio, working, stats, quality;
  std::string strategy = strategy_name(Strategy::automatic), effects = "auto", layers = "all";
  std::string progress_name = "auto";
  bool verify_plan = false, bill = false, strict = false, adaptive = false, dry_run = false, quiet = false,
       verbose = false, timings = false;
  int seed = 1;

  EffectSwitches switches;                        ///< settled from `effects` and --bounces
  std::vector<std::string> layer_list;            ///< settled from `layers`
  ProgressStyle progress = ProgressStyle::lines;  ///< settled from `progress_name`
};

/// Names the flags in `command`, which writes into `flags` when it parses.
void add_picture_flags(Command& command, PictureFlags& flags);

/// Flags of what the renderer approximates (render/approximations.h), in the group that is open.
void add_approximation_flags(Command& command, Approximations& to);

/// Samples a pixel, dealt out by error, where no stop rule was given: the default picture ends at about the error
/// that the plan works towards (default_plan_error).
inline constexpr int default_samples = 24;

/// Settles what the flags left open once all of them are read: stop rules, strategy, effects, layers, progress,
/// voice. `samples` is what is rendered when no stop rule was given.
void settle_picture_flags(const Command& command, PictureFlags& flags, int samples = default_samples);

/// Layers that `--aov` names. "all" and "none" too.
std::vector<std::string> read_layers(const std::string& list);

/// "#rrggbb" or "#rgb" as code values in [0, 1].
Color read_hex_color(const std::string& what, const std::string& text);

/// The parts of a text between separators; one where there is none.
std::vector<std::string> split(const std::string& text, char separator);

/// The words of a command line, quoted for a shell where needed.
std::string shell_line(const std::vector<std::string>& words);

/// The command line as pictures hold it: without what decides nothing of them, names of outputs, threads, progress,
/// what was gone on from, so that the same picture has the same bytes whatever it is called and however it came
/// about.
std::string recorded_line(const std::string& subcommand, const std::vector<std::string>& words);

}  // namespace sateen::app
