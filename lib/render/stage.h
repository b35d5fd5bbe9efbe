#pragma once
#include <string>
#include <vector>

#include "scene/scene.h"

namespace sateen {

/// What stands around the cloth and how it is taken, as authored. What is empty or 0 is off and costs nothing.
struct StageSettings {
  std::optional<GroundSettings> ground;
  std::optional<LensSettings> lens;
  float shutter_deg = 0;         ///< that the object turns while the shutter is open, -360 to 360
  float backdrop_blur_deg = 20;  ///< kernel of Backdrop::blurred
};

/// Compiles the stage into a scene whose mesh, camera, environment and backdrop are in place. To be called again
/// where the camera was framed anew. InputError for a focus that is not in front of the camera.
void set_stage(Scene& scene, const StageSettings& settings, int threads = 0);

/// The shutter of a turn by `degrees` about the vertical axis through the middle of the object; `camera`: the camera
/// walks around a standing object. Empty for 0 degrees.
std::optional<Shutter> shutter_of(const Mesh& mesh, double degrees, bool camera);

/// "floor -0.82 0.4 0.4 0.4", "f/2.8 focus auto ..."; "none" for what is off. The words of sampling_facts.
std::string ground_text(const StageSettings& settings);
std::string lens_text(const StageSettings& settings);

const std::vector<std::string>& ground_names();  ///< "none", then in the order of the enum

}  // namespace sateen
