#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace sateen {

/// What a random number is for. Every name owns an independent Owen-scrambled Sobol sequence in every pixel, so that
/// adding a use never disturbs another. Candidates of resampling take consecutive points of theirs.
enum class Dimension : std::uint32_t {
  film,         ///< position in the pixel filter, 2D
  table,        ///< theta and phi of a direction from the fabric's table, 2D
  table_view,   ///< which of the four neighbouring views, 1D
  talk,         ///< inclination and azimuth of the talk's lobes, 2D
  talk_thread,  ///< thread tangent and lobe of the talk's sampler, 2D
  uniform,      ///< direction in the hemisphere, 2D
  environment,  ///< direction to the environment, 2D
  choice,       ///< for which candidates of resampling F is evaluated, 1D
  gap,          ///< whether a ray passes between the threads, 1D
  roulette,     ///< whether a path goes on, 1D
  bounces,      ///< whether a sample follows light that meets cloth again, 1D
  lens,         ///< reserved for depth of field, 2D
  time,         ///< reserved for motion blur, 1D
  pattern,      ///< which look of a pattern is met, 1D
  shadows       ///< which candidates of resampling get a shadow ray, 1D
};

/// The sequence of one pixel in one independent replicate of the picture.
struct Sequence {
  std::uint32_t seed;  ///< from pixel_sequence
};

/// Hash of (seed, pixel, replicate, bounce): independent scramblings.
Sequence pixel_sequence(std::uint32_t seed, int x, int y, int replicate, int bounce = 0);

/// Point `index` of a one- or two-dimensional sequence: doubles in [0, 1) with 32 bits. Sobol's first two dimensions,
/// indices shuffled and digits scrambled by hashed nested uniform scrambling (Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020). Every block of 2^k consecutive points from a multiple of 2^k is a (0, k, 2)-net.
double draw(Sequence sequence, Dimension dimension, std::uint32_t index);
std::array<double, 2> draw2(Sequence sequence, Dimension dimension, std::uint32_t index);

/// Samples that are computed side by side, measured: four packets of camera rays, and shadow rays enough for a
/// stream.
inline constexpr int batch_size = 64;

/// At most batch_size consecutive points of one sequence from `first` on, the same bits as one by one.
void draw(Sequence sequence, Dimension dimension, std::uint32_t first, std::span<double> out);
void draw2(Sequence sequence, Dimension dimension, std::uint32_t first, std::span<std::array<double, 2>> out);

/// One sample of a pixel: the `index`-th of a replicate.
struct SampleId {
  int x = 0, y = 0, replicate = 0;
  std::uint32_t index = 0;
};

/// `count` (at most batch_size) sequences or points at once, the same bits as one by one in a fraction of the time:
/// the hashes of neighbours do not wait for one another.
struct SequenceBatch {
  int count = 0;
  std::array<std::uint32_t, batch_size> seed{}, index{};

  Sequence sequence(int k) const { return {seed[std::size_t(k)]}; }
};
SequenceBatch pixel_sequences(std::uint32_t seed, std::span<const SampleId> samples, int bounce = 0);
using Batch1 = std::array<double, batch_size>;
using Batch2 = std::array<std::array<double, 2>, batch_size>;
Batch1 draw(const SequenceBatch& batch, Dimension dimension);
Batch2 draw2(const SequenceBatch& batch, Dimension dimension);

}  // namespace sateen
