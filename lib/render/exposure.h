#pragma once
#include "scene/environment.h"

namespace sateen {

/// Turns the light: radians about +Y, positive to the right as the default camera sees it.
void set_rotation(Environment& environment, double radians);

/// metered_exposure_ev() with the meter held towards a camera at `azimuth_deg` (CameraSettings), and as if the map
/// had been read at 0 EV where it was read at `environment_ev`: a light made brighter shall look brighter. The
/// environment is turned while the meter looks and turned back.
float metered_towards(Environment& environment, float azimuth_deg, float environment_ev);

}  // namespace sateen
