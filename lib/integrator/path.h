#pragma once
#include "film/film.h"
#include "integrator/direct.h"

namespace sateen {

/// What one camera sample brings to its pixel, working space, in parts that add up to it.
struct CameraSample {
  LobeLight direct;             ///< environment light after one meeting with the first layer
  BounceLight indirect;         ///< by way of it after two, three, ... meetings with cloth or ground
  Color through_gaps{0, 0, 0};  ///< light of the layers behind the first, seen through its gaps
  BounceLight bounced_behind;   ///< what of `through_gaps` came after two, three, ... meetings
  Color backdrop{0, 0, 0};      ///< and the direct light of the ground
  float coverage = 0;           ///< by cloth, ground and caught shadow
  float alpha = 0;              ///< 1 where a backdrop is seen, else the coverage
  bool hit = false;             ///< the values below are those of the first surface met
  Vec3 position{0, 0, 0}, normal{0, 0, 0}, warp{0, 0, 0};
  Vec2 uv{0, 0};
  Vec3 wo{0, 0, 1};   ///< cloth frame
  bool back = false;  ///< the cloth's back is seen
  const Fabric* fabric = nullptr;
  /// A of warp and weft there, and how much of their light there is for each part of the fabric's mean: not 1 where
  /// textures give a coverage, and all of one family where its yarn is seen from near.
  std::array<Color, 2> A{Color(0), Color(0)};
  std::array<float, 2> presence{1, 1};

  Color total() const { return direct.total() + indirect.total() + through_gaps + backdrop; }
};

/// Up to batch_size samples of one picture, side by side; those that run close together, as in one pixel, gain most.
/// A sample has the same bits in any batch. Pixel filter: see scene/filter.h.
void trace_samples(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                   std::span<const SampleId> samples, PathScratch& scratch, CameraSample* out);

/// One sample alone, several times as slow as in a batch.
CameraSample trace_sample(const Scene& scene, const LightSettings& settings, std::uint32_t seed,
                          const SampleId& sample, PathScratch& scratch);

}  // namespace sateen
