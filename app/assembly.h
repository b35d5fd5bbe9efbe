#pragma once
#include <string>
#include <vector>

#include "picture_flags.h"
#include "render/checkpoint.h"

namespace sateen::app {

/// What a subcommand works on: the scene as it is planned, and the job that says how.
struct Assembly {
  ColorManager colors;
  SceneReport report;
  Scene scene;
  PictureJob job;
};

/// Reads, compiles, joins and plans what the flags describe. `flags.display` is settled on the way. `begun`: another
/// render of the picture, whose plan is taken over.
Assembly assemble_picture(PictureFlags& flags, const std::string& command_line, const Checkpoint* begun = nullptr);

/// The second half: plans a scene that has everything, takes out of it what the plan has off, and chooses how many
/// directions what is left wants to be lit from.
PictureJob plan_picture(const PictureFlags& flags, const SceneReport& report, Scene& scene,
                        const ColorManager& colors, const std::string& command_line,
                        const Checkpoint* begun = nullptr);

/// Holds the flags to the strategy that another render of the picture began with, unless they name one.
void keep_strategy(PictureFlags& flags, const std::vector<Fact>& facts);

}  // namespace sateen::app
