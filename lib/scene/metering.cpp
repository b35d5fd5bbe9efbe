#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/environment.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi;
}

// An incident-light meter's dome gathers light from the whole side that the camera sees, less from the rim than a
// flat receptor does. The dome is taken as the cardioid response (1 + cos t) / 2 about the meter's axis, cut at the
// cloth's plane (nothing from behind lights the face): E = integral over z > 0 of L (1 + z) / 2 [luminance x sr], 1.5
// pi for a constant map of radiance 1. Read against that map, under which a Lambert card of reflectance 0.18 shows
// 0.18, the exposure is -log2(E / 1.5 pi). Cloth falls in folds that face everywhere: a flat receptor would call a
// map dark whose light comes from the side, where satin looks best.
float metered_exposure_ev(const Environment& e) {
  // Texels of a small map span much of the sphere: they are cut until the response is flat within a piece.
  const int across = std::max(1, 256 / e.width), down = std::max(1, 128 / e.height);
  double gathered = 0;
  for (int y = 0; y < e.height * down; ++y) {
    const double half_height = pi_d / (2.0 * e.height * down), colatitude = half_height * (2 * y + 1);
    const double sine = std::sin(colatitude);
    const double solid_angle = 2 * sine * std::sin(half_height) * 2 * pi_d / (double(e.width) * across);
    for (int x = 0; x < e.width * across; ++x) {
      const double longitude = 2 * pi_d * ((x + 0.5) / (double(e.width) * across) + e.rotation_turns);
      const double z = sine * std::cos(longitude);
      if (z <= 0) continue;
      const Color& c = e.radiance_at(x / across, y / down);
      double luminance = 0;
      for (int i = 0; i < 3; ++i) luminance += double(c[i]) * double(e.luminance[i]);
      gathered += luminance * (1 + z) / 2 * solid_angle;
    }
  }
  const double card = gathered / (1.5 * pi_d);  // a constant map of radiance 1 gathers 1.5 pi
  return card > 0 && std::isfinite(card) ? float(-std::log2(card)) : 0.0f;
}

}  // namespace sateen
