#pragma once
#include <array>

#include "image/color.h"
#include "render/picture.h"
#include "scene/scene.h"

namespace sateen {

/// What people hold into a plate before the cloth comes: a matte grey ball, a chrome ball and a colour chart, lit by
/// the scene's map from where the camera stands, in the lower left corner. Laid over the finished picture: they
/// neither shade the cloth nor are shaded by it.
struct References {
  Image overlay;                                      ///< of the picture's size: premultiplied RGBA, working space
  Color ball_brightest{0, 0, 0}, ball_mean{0, 0, 0};  ///< of the grey ball's pixels, working space
  struct Patch {
    const char* name;
    float reflectance;                    ///< nominal
    Color light{0, 0, 0}, code{0, 0, 0};  ///< in the picture: working space, and code values of the display
  };
  std::array<Patch, 6> greys;  ///< the chart's lowest row
  Color ball_code{0, 0, 0};    ///< code values of ball_mean
};

inline constexpr float grey_ball_reflectance = 0.18f;
inline constexpr int least_reference_side = 96;  ///< pixels of the picture's shorter side; below, a patch is no pixel

/// InputError for a picture that is too small.
References make_references(const Environment& environment, const Camera& camera, const ColorManager& colors,
                           const DisplaySettings& display, float exposure_ev, int threads = 0);

}  // namespace sateen
