#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "image/image.h"
#include "math/vector.h"

namespace sateen {

/// Independent randomised replicates of the picture: sample i of a pixel belongs to replicate i mod this. Their
/// scatter is the error. Measured on seven scenes at 32 and 128 samples a pixel against one sequence, squared error:
/// 4 replicates cost 1.31 and 1.14 times, 8 1.53 and 1.30, 16 1.84 and 1.46. What 8 and 16 know better about a single
/// pixel, four know from its neighbours as well (film/error.h).
inline constexpr int replicates = 4;

/// Sums of one pixel. A pixel owns its sums and its sample sequence, so bits do not depend on who computes.
struct FilmPixel {
  std::array<Vec3d, replicates> beauty{Vec3d(0), Vec3d(0), Vec3d(0), Vec3d(0)};
  /// What cloth, ground and caught shadow cover, whatever is seen behind them.
  std::array<double, replicates> coverage{};
  std::uint64_t samples = 0;
};

/// Light by bounce; the last entry holds that of its own bounce and of all further ones.
inline constexpr int tracked_bounces = 4;
struct BounceLight {
  Color bounce[tracked_bounces] = {Color(0), Color(0), Color(0), Color(0)};

  Color total() const { return bounce[0] + bounce[1] + bounce[2] + bounce[3]; }
};

/// Sums of the layers beside the beauty; kept only where asked for.
struct LayerPixel {
  // Light, in parts that add up to the beauty.
  Color surface[2] = {Color(0), Color(0)}, volume[2] = {Color(0), Color(0)};  ///< direct, of warp and weft
  BounceLight indirect;
  Color through_gaps{0, 0, 0}, backdrop{0, 0, 0};
  Color albedo{0, 0, 0};
  Vec3 normal{0, 0, 0}, position{0, 0, 0}, warp{0, 0, 0};
  Vec2 uv{0, 0};
  std::uint32_t hits = 0;  ///< samples that met cloth: what the geometric layers are averaged over
};

struct Film {
  int width = 0, height = 0;
  /// Number in its sequence of a pixel's first sample: a multiple of `replicates`.
  std::uint32_t first_sample = 0;
  /// Samples enter the sums as multiples of this power of two, so that sums are exact, in any order, while they stay
  /// below 2^53 of it: 2^20 samples at the map's mean light a replicate. What is beyond is rounded as double is.
  double grain = 0x1p-33;
  bool opaque = false;  ///< a backdrop is seen: alpha is 1 everywhere
  std::vector<FilmPixel> pixels;
  std::vector<LayerPixel> layers;  ///< empty, or one a pixel

  Film() = default;
  Film(int w, int h, bool with_layers)
      : width(w), height(h), pixels(size_t(w) * size_t(h)), layers(with_layers ? pixels.size() : 0) {}
};

/// Adds one sample to a pixel's beauty and coverage.
void add_sample(FilmPixel& pixel, const Color& value, float coverage, double grain);

/// Samples of replicate r among the first n of a pixel.
std::uint64_t replicate_count(std::uint64_t n, int r);

/// Mean of all samples of a pixel; black where it has none.
Color pixel_mean(const FilmPixel& pixel);

/// Mean coverage of all samples of a pixel; 0 where it has none.
double pixel_coverage(const FilmPixel& pixel);

/// Variance of the mean in every channel, from the scatter of the replicates; 0 while fewer than two have samples.
/// In double: the square of a sun's light is beyond float.
Vec3d pixel_variance(const FilmPixel& pixel);

/// Adds the samples of `other` to `film`. Beauty, coverage, samples and so the error become what one render of all
/// would have, bit for bit; the layers beside them to float's roundings. Films of one size, with layers or without.
void add_film(Film& film, const Film& other);

}  // namespace sateen
