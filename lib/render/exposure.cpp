#include "render/exposure.h"

#include <cmath>
#include <numbers>

namespace sateen {

void set_rotation(Environment& environment, double radians) {
  const double turns = radians / (2 * std::numbers::pi);
  environment.rotation = float(radians);
  environment.rotation_turns = turns - std::floor(turns);
  if (!(environment.rotation_turns < 1)) environment.rotation_turns = 0;
}

float metered_towards(Environment& environment, float azimuth_deg, float environment_ev) {
  const float rotation = environment.rotation;
  const double turns = environment.rotation_turns;
  // A camera that walks by an angle sees the light turn the other way round it.
  set_rotation(environment, 2 * std::numbers::pi * (turns + double(azimuth_deg) / 360));
  const float ev = metered_exposure_ev(environment) + environment_ev;
  environment.rotation = rotation;
  environment.rotation_turns = turns;
  return ev;
}

}  // namespace sateen
