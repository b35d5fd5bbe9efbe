#pragma once
#include <functional>
#include <span>

#include "integrator/path.h"

namespace sateen {

/// Pixels spread evenly over a picture, each with samples of its own: enough to judge a picture by, at a small part
/// of its price.
struct PixelGrid {
  int columns = 48, rows = 32;
  int first = 0;     ///< number of the first sample, a multiple of `replicates`
  int samples = 64;  ///< of each pixel, a multiple of `replicates`; sample k belongs to replicate k mod replicates
  Vec2 place{0.5f, 0.5f};  ///< of the pixel in its cell, 0 to 1

  int pixels() const { return columns * rows; }
};

/// The usual grid, no finer than the picture: pixels that are taken twice would seem to know more than they do.
PixelGrid grid_of(const Camera& camera);

/// What it took.
struct GridWork {
  RayCounts rays;
  std::int64_t hits = 0;  ///< samples that met cloth
  double cpu_seconds = 0;
};

/// Traces them all. `use(pixel, samples)` is called once for each pixel, from any thread; what it makes of them must
/// not depend on the order. A sample has the same bits as in a render with that seed.
GridWork trace_grid(const Scene& scene, const LightSettings& light, std::uint32_t seed, const PixelGrid& grid,
                    int threads, const std::function<void(int, std::span<const CameraSample>)>& use);

}  // namespace sateen
