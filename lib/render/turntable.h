#pragma once
#include <string>
#include <vector>

#include "render/stage.h"
#include "scene/scene.h"

namespace sateen {

/// What turns; the others stand still.
enum class Turn { object, camera, light };
const std::vector<std::string>& turn_names();  ///< "object", "camera", "light"

/// Where everything stands at the first frame.
struct TurntableStart {
  Turn turn = Turn::object;
  Camera camera;              ///< one distance and one aim for all frames, so that the object does not pump
  Vec3 pivot{0, 0, 0};        ///< the vertical axis goes through it
  double light_rotation = 0;  ///< radians
  Vec3 away{0, 0, -1};        ///< Ground::away
};

/// Frames the whole body of revolution that the mesh sweeps about the vertical axis through the middle of its bounds;
/// for a turning light the scene's own camera stays.
TurntableStart start_turntable(const Scene& scene, const CameraSettings& camera, Turn turn);

/// Compiles the stage for the turntable's camera: a shutter blurs what turns, the object or the camera.
void set_turning_stage(Scene& scene, TurntableStart& start, const StageSettings& settings);

/// Sets camera and light of the scene for an angle [degrees]: to the right as the default camera sees what turns. The
/// mesh stays where it is: a turning object is a camera and a light that turn together the other way.
void pose_turntable(Scene& scene, const TurntableStart& start, double angle_deg);

/// Exposure for all frames: the mean of the light that meets the side that the camera sees, over the orbit.
float turntable_exposure(Environment& environment, Turn turn, float azimuth_deg, float environment_ev,
                         double degrees);

}  // namespace sateen
