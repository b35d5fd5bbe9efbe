#pragma once
#include <atomic>
#include <functional>

#include "film/film.h"
#include "integrator/path.h"
#include "scene/scene.h"

namespace sateen {

/// When to stop: whichever of the three is met first. 0: not asked.
struct StopRules {
  int spp = 0;         ///< samples per pixel
  double error = 0;    ///< upper end of the interval of E (film/film.h)
  double seconds = 0;  ///< wall clock, from the start of render()
};

/// A window of the picture in pixels, x0 <= x < x1.
struct Crop {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

struct RenderSettings {
  LightSettings light;
  StopRules stop;
  std::uint32_t seed = 1;
  int threads = 0;   ///< 0: all that this process may use
  Crop crop;         ///< all zero: the whole picture
  bool albedo_layer = true;  ///< false: the layer `albedo` stays black and its table, half a second, is not made
};

/// Told after every pass, and about ten times a second within one; never by two threads at once.
struct RenderState {
  int samples = 0;          ///< per pixel, whole passes so far
  double seconds = 0, seconds_left = -1;  ///< left: -1 while unknown
  double fraction = 0;      ///< 0 to 1, never falls
  PictureError error;
};

enum class StopReason { samples, error, time, interrupted };

struct RenderResult {
  StopReason reason = StopReason::samples;
  int samples = 0;
  PictureError error;
  double seconds = 0, cpu_seconds = 0;
  double first_pass_seconds = 0;
  RayCounts rays;
};

/// Renders into `film` pass by pass. Same scene, settings and film give the same bits on any number of threads. `interrupt`, where given, is looked at
/// between rows of pixels: the film then holds whole samples, some pixels more than others.
RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film,
                    const std::function<void(const RenderState&)>& observe = {},
                    const std::atomic<bool>* interrupt = nullptr);

}  // namespace sateen
