#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/shared_array.h"
#include "image/image.h"
#include "math/vector.h"
#include "sampling/distribution.h"

namespace sateen {

/// What had to be mended in a map, in pixels, with the first place of each kind (x, y from the top left).
struct EnvironmentRepairs {
  struct Kind {
    std::int64_t count = 0;
    int first_x = -1, first_y = -1;
  };
  Kind not_a_number;  ///< made 0
  Kind infinite;      ///< +Inf: made the map's largest finite value, 65504 where it has none; -Inf made 0
  Kind negative;      ///< in the file and in the working space too: made 0 there
  Kind out_of_gamut;  ///< became negative by conversion to the working space: made 0 there
  Kind wide;          ///< NOT changed: negative in the file, but a colour of the working space
  Kind spike;         ///< suspicious, NOT changed: one channel above 100 times the other two and the map's mean
  bool any() const { return not_a_number.count || infinite.count || negative.count || out_of_gamut.count; }
};

enum class EnvironmentDensity {
  radiance,    ///< proportional to luminance
  compensated  ///< proportional to max(0, L - mean L), Karlik et al. 2019; the plain one where that is all zero
};

/// A lat-long map as a light at infinity. Row 0 is up (+Y). Direction d has longitude u = atan2(d.x, -d.z)/(2 pi) +
/// 1/2 (so -Z, the way the default camera looks, is the middle of the map) and colatitude v = acos(d.y)/pi. Radiance
/// is constant in a texel, so that look-up and density agree exactly. Compiled: working space, rotated, scaled by
/// 2^ev. Copies share the map and its tables.
struct Environment {
  /// Of being drawn, by solid angle [1/sr].
  struct Density {
    float pdf_radiance = 0, pdf_compensated = 0;
  };
  /// Radiance and both densities of one texel side by side: a look-up touches one place in memory.
  struct Texel : Density {
    Color radiance;
  };
  int width = 0, height = 0;
  SharedArray<Texel> texels;  ///< empty for a map of more than `most_texels`, which is kept in the next three
  /// A map of 16384 x 8192 in 1.7 GB instead of 4: radiance of every texel, but drawn by blocks of block x block
  /// texels (fewer at the right and the lower edge), in which the density is constant. The estimate stays unbiased; a
  /// light smaller than a block is met less often than its energy asks.
  SharedArray<Color> fine;
  SharedArray<Density> blocks;
  int block = 1;
  float rotation = 0;  ///< radians about +Y; positive turns the light to the right as the default camera sees it
  EnvironmentRepairs repairs;
  std::vector<std::string> notes;   ///< what was chosen and done in reading, for `env inspect`
  std::vector<std::string> doubts;  ///< what was assumed in reading and may be wrong
  std::string name;
  Color mean_radiance{0, 0, 0};  ///< over the sphere
  Color luminance{0, 0, 0};      ///< Y of the working space's unit primaries
  bool black = true;             ///< nothing to draw: every pdf is 0

  double rotation_turns = 0;        ///< rotation / 2 pi, in [0, 1)
  std::vector<double> row_cosines;  ///< cos(pi y / height), height + 1 of them
  Distribution2D by_radiance;       ///< over texels, or over blocks
  Distribution2D by_compensated;    ///< empty where it would be all zero: the plain one stands in
  double edge_x = 0, edge_y = 0;    ///< samples keep this far from a cell's border, as a share of the cell

  const Color& radiance_at(int x, int y) const {
    const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
    return texels.empty() ? fine[i] : texels[i].radiance;
  }
};

/// A texel as look-ups give it; null where there is none.
struct MapTexel {
  const Color* radiance = nullptr;
  const Environment::Density* density = nullptr;
  explicit operator bool() const { return radiance != nullptr; }
  bool operator==(const MapTexel&) const = default;
};

/// Largest map whose texels are drawn one by one, by default: 8192 x 4096.
inline constexpr std::int64_t most_texels = std::int64_t(1) << 25;

struct EnvironmentOptions {
  float rotation = 0;     ///< radians
  float exposure_ev = 0;  ///< radiance is scaled by 2^exposure_ev
  std::string name;
  Color luminance{0.2722287f, 0.6740818f, 0.0536895f};  ///< ColorManager::luminance_weights(); here ACEScg's
  std::int64_t most_texels = sateen::most_texels;       ///< a larger map is drawn by blocks
};

struct EnvironmentSample {
  Vec3 direction{0, 1, 0};
  Color radiance{0, 0, 0};
  float pdf = 0;  ///< solid angle [1/sr]; 0 when the map is black
};

/// cos(t0) - cos(t1) of a row's borders, exact to double: the rows of a map add up to 2.
double environment_row_weight(int y, int height);

/// A one-channel map is grey, a two-channel one grey with alpha; of more the first three count. `map` is in the
/// working space and is repaired first. Luminance for the densities floors each channel's weight at 0.02, so that a
/// colour whose Y is zero or negative (AP0's blue) is drawn too. InputError for an empty map.
Environment build_environment(Image map, const EnvironmentOptions& options = {});

/// Texel that a direction (of any length) falls into; a NaN gives the first.
inline MapTexel environment_texel(const Environment& environment, const Vec3& direction);

inline float texel_pdf(const MapTexel& texel, EnvironmentDensity density) {
  return density == EnvironmentDensity::radiance ? texel.density->pdf_radiance : texel.density->pdf_compensated;
}

inline Color environment_radiance(const Environment& environment, const Vec3& direction) {
  return *environment_texel(environment, direction).radiance;
}

inline float environment_pdf(const Environment& environment, EnvironmentDensity density, const Vec3& direction) {
  return texel_pdf(environment_texel(environment, direction), density);
}

/// Draws a direction by inversion: u1 the row, u0 the column, what is left of both the place in the texel, uniform in
/// solid angle. Looking up the direction returns the texel drawn (tested), hence the same radiance and pdf.
EnvironmentSample sample_environment(const Environment& environment, EnvironmentDensity density, double u0,
                                     double u1);

/// What the map proposes. `texel` is null when the map is black.
struct EnvironmentPick {
  Vec3 direction;
  MapTexel texel;
};
/// The same for many, and without touching the texels: on a large map that read is a cache miss. They are asked for
/// (prefetch_texel), and a caller does something else first.
void pick_environment(const Environment& environment, EnvironmentDensity density,
                      std::span<const std::array<double, 2>> u, EnvironmentPick* picks);

inline void prefetch_texel(const MapTexel& texel) {
  __builtin_prefetch(texel.density);
  __builtin_prefetch(reinterpret_cast<const char*>(texel.radiance) + sizeof(Color) - 1);
}

/// Bilinear look-up between texel centres, across the seam and over the poles, for seeing the map behind the cloth.
Color environment_backdrop(const Environment& environment, const Vec3& direction);

/// Exposure [EV] at which the map lights a grey card of 18 % to a luminance of 0.18, as an incident-light meter with
/// a dome finds it that is held at the cloth towards the default camera (+Z). See metering.cpp for the definition.
float metered_exposure_ev(const Environment& environment);

}  // namespace sateen

#include "scene/environment_texel.h"
