#pragma once
#include "integrator/direct.h"

namespace sateen {

/// What one camera sample brings to its pixel, working space. Light reaches the eye through `opacity` of the cloth
/// in front; where there are no gaps that is 1 on the cloth and 0 beside it.
struct CameraSample {
  LobeLight direct;          ///< environment light after one meeting with the cloth
  Color indirect{0, 0, 0};   ///< after two and more
  Color backdrop{0, 0, 0};
  float alpha = 0;           ///< 1 where the backdrop is seen, else the cloth's opacity
  bool hit = false;          ///< the values below are those of the first surface met
  Vec3 position, normal, warp;
  Vec2 uv;
  Vec3 wo;                   ///< cloth frame
  bool back = false;         ///< the cloth's back is seen

  Color total() const { return direct.total() + indirect + backdrop; }
};

/// What a thread needs to trace; large, so one is kept a thread.
struct PathScratch {
  FabricView view;
  RayCounts counts;
};

/// One sample of the pixel (x, y), `index`-th of its replicate. Pixel filter: see film/filter.h.
CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed, int x, int y,
                          int replicate, std::uint32_t index, PathScratch& scratch);

}  // namespace sateen
