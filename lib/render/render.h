#pragma once
#include <atomic>
#include <functional>

#include "film/error.h"
#include "film/film.h"
#include "integrator/path.h"
#include "render/allocation.h"
#include "render/prediction.h"
#include "scene/scene.h"

namespace sateen {

/// When to stop: whichever of the three is met first. 0: not asked.
struct StopRules {
  int spp = 0;       ///< samples per pixel; their mean where samples are dealt out by error
  double error = 0;  ///< upper end of the interval of E (film/error.h), looked at at barriers (render/allocation.h),
                     ///< a coarse one before the first, too
  double seconds = 0;  ///< wall clock, from the start of render(); a first complete pass is taken however long it is

  bool operator==(const StopRules&) const = default;
};

struct RenderSettings {
  LightSettings light;
  StopRules stop;
  double seconds_spent = 0;  ///< of stop.seconds, on what comes before and after render()
  std::uint32_t seed = 1;
  int threads = 0;                           ///< 0: all that this process may use
  Crop crop;                                 ///< all zero: the whole picture
  bool adaptive = false;                     ///< samples go where the error is
  double error_floor = default_error_floor;  ///< of E: ErrorScale
  bool albedo_layer = true;  ///< false: the layer `albedo` stays black and its table, half a second, is not made
};

/// What a render knows beside its film, and needs to go on as if it had never stopped.
struct Course {
  int samples = 0;                     ///< mean a pixel; a pass that was interrupted does not count
  int barrier = 0;                     ///< where the samples go that are being added; 0 before the first
  std::vector<std::uint32_t> targets;  ///< of every pixel at that barrier
  std::vector<ErrorPoint> past;        ///< one a barrier
  Promise promise;
  StopRules promised_for;               ///< another promise is made once these change
  double seconds = 0, cpu_seconds = 0;  ///< of all runs so far
  RayCounts rays;
};

/// Told after every pass, and about ten times a second within one; never by two threads at once.
struct RenderState {
  int samples = 0;                        ///< mean per pixel, whole passes so far
  double seconds = 0, seconds_left = -1;  ///< left: -1 while unknown
  double fraction = 0;                    ///< 0 to 1, never falls
  double target = 0;                      ///< error asked for; 0: none
  PictureError error;                     ///< at the last barrier
  Promise promise;                        ///< once it is made
};

enum class StopReason { samples, error, time, interrupted, rare };
// rare: the error asked for rests on rare samples and does not fall

struct RenderResult {
  StopReason reason = StopReason::samples;
  int samples = 0;  ///< mean a pixel
  PictureError error;
  double deviation = 0;                             ///< 95 % of the pixels are within this of their final value
  double seconds = 0, cpu_seconds = 0;              ///< of this run
  double total_seconds = 0, total_cpu_seconds = 0;  ///< with the runs that it went on from
  double first_pass_seconds = 0;
  Promise promise;
  RayCounts rays;
};

/// Ears and eyes of a render. All may be left out.
struct RenderHooks {
  std::function<void(const RenderState&)> observe;
  const std::atomic<bool>* interrupt = nullptr;  ///< looked at between rows of pixels; ends the render
  /// Looked at between rows: once true it is made false and `snapshot` is called while nobody writes into the film.
  std::atomic<bool>* snapshot_wanted = nullptr;
  double snapshot_every = 0;  ///< seconds between calls of `snapshot` that nobody asked for; 0: none
  std::function<void(const RenderResult&, bool asked)> snapshot;
};

/// Renders into `film` pass by pass, on from where `course` is. Same scene, settings and film give the same bits on
/// any number of threads and however often the render was stopped and gone on with, to whatever error, time or
/// samples: these only say where it ends. After an interrupt the film holds whole samples, some pixels more.
RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film, Course& course,
                    const RenderHooks& hooks);

/// From the beginning.
RenderResult render(const Scene& scene, const RenderSettings& settings, Film& film,
                    const std::function<void(const RenderState&)>& observe = {},
                    const std::atomic<bool>* interrupt = nullptr);

}  // namespace sateen
