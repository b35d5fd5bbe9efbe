#pragma once
#include <string>
#include <vector>

#include "integrator/path.h"
#include "statistics/z_test.h"

// Small pictures in independent batches, and the test that two ways to render them agree.

namespace sateen_test {

/// Batches of one scene, rendered one way: a seed each. Values are [batch][pixel][channel].
struct PictureBatches {
  int width = 0, height = 0;
  std::vector<std::vector<float>> values;
  std::int64_t non_finite = 0;
};

/// `samples` a batch and pixel, dealt out to replicates as render() does.
PictureBatches render_batches(const sateen::Scene& scene, const sateen::LightSettings& light, int batches,
                              int samples, std::uint32_t first_seed);

/// What two pictures are compared by. Pixels see local faults, means over blocks of 4 x 4 pixels and over the picture
/// small ones.
enum class Scale { pixel, block, picture, nothing };

/// Number of comparisons that `largest_deviate` makes from that scale up.
double comparisons(const PictureBatches& picture, Scale finest);

struct Disagreement {
  double deviate = 0;
  std::string place;  ///< what differs most, in words
};

/// The largest deviate of any pixel, block and channel. A finer scale is left out where its means cannot be normal.
Disagreement largest_deviate(const PictureBatches& a, const PictureBatches& b, Scale finest);

}  // namespace sateen_test
