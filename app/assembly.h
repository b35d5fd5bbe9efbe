#pragma once
#include <string>
#include <vector>

#include "picture_flags.h"

namespace sateen::app {

/// What a subcommand works on: the scene as it is planned, and the job that says how.
struct Assembly {
  ColorManager colors;
  SceneReport report;
  Scene scene;
  PictureJob job;
};

/// Reads, compiles, joins and plans what the flags describe. `flags.display` is settled on the way. Without `pilots`
/// nothing is measured: for a picture that is rendered already, whose flags keep_effects() has settled.
Assembly assemble_picture(PictureFlags& flags, const std::string& command_line, bool pilots = true);

/// The second half: plans a scene that has everything, takes out of it what the plan has off, and chooses how many
/// directions what is left wants to be lit from.
PictureJob plan_picture(const PictureFlags& flags, const SceneReport& report, Scene& scene,
                        const ColorManager& colors, const std::string& command_line, bool pilots = true);

/// Holds the flags to the effects and the strategy that another render of the picture began with.
void keep_effects(PictureFlags& flags, const std::vector<Fact>& facts);

}  // namespace sateen::app
