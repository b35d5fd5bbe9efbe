#pragma once
#include "render/assemble.h"
#include "render/picture.h"
#include "render/plan.h"
#include "study/measure.h"

namespace sateen {

/// A scene as `sateen render` makes it ready, and the CPU-seconds that this takes: a share of what a picture costs
/// that does not depend on its samples.
struct RenderStart {
  Scene scene;
  LightSettings light;
  Plan plan;
  SceneReport report;
  double assembly_seconds = 0, pilot_seconds = 0;
};

/// `error_floor`: of E, in the light of the scene. No error is asked for, as beside --spp alone.
RenderStart start_render(const SceneSettings& settings, const EffectSwitches& effects, const LightSettings& light,
                         double error_floor, std::uint32_t seed, int threads, const ColorManager& colors);

/// CPU-seconds of the table for the layer `albedo`, which a picture with all layers needs.
double albedo_table_seconds(const Scene& scene, int threads);

/// CPU-seconds of writing a film as the files that `sateen render` writes unless told otherwise, for a picture of
/// `scale` times its pixels. The first file pays once for what all files need.
Interval writing_interval(const Film& film, double scale, int repetitions, const DisplaySettings& display,
                          float exposure_ev, const ColorManager& colors, int threads);

}  // namespace sateen
