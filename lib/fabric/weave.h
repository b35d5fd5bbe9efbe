#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fabric/threads.h"
#include "look/look.h"

namespace sateen {

/// Shares of their spacings that warp and weft yarns fill, 0 to 1.
struct YarnWidths {
  double warp = 0, weft = 0;
};

/// A weave compiled for cloth that is seen from so near that its threads have places. Weave coordinates [metres]: x
/// along the warp, y along the weft, as in the cloth's frame. Warp yarns lie side by side along y, weft yarns along
/// x; a yarn is a strip of its spacing's width times `width`, and between the strips the other family, or nothing,
/// shows. Immutable.
///
/// The mean over the cloth is the far model's (cloth-model.md section 3), exactly: the widths are chosen so that each
/// family covers its share a_j, the places along all floats spread evenly over the tangent curve, and what depends on
/// the place across a yarn has the mean 1. What strays is which place has which value, never how much there is of it.
struct Weave {
  int ends = 0, picks = 0;                    ///< of the repeat; 0: no weave, no threads to be seen
  std::vector<std::uint8_t> warp_up;          ///< [pick * ends + end], both in the order of growing y and x
  /// Where each warp end lies under a pick, and each pick under an end, growing; end or pick i has its places from
  /// covered_from[family][i] to covered_from[family][i + 1]. A float's ends are then found without walking along it.
  std::array<std::vector<std::uint16_t>, 2> covered;
  std::array<std::vector<std::uint32_t>, 2> covered_from;
  double warp_spacing = 0, weft_spacing = 0;  ///< [metres]
  double up = 0;                              ///< share of the crossings with the warp on top
  std::array<double, 2> coverage{};           ///< a_j of warp and weft
  YarnWidths widths;
  bool closed = false;                 ///< see close_gaps()
  double irregularity = 0, slubs = 0;  ///< as authored
  /// Tangent curves, as authored [degrees]; the place along a float runs from a curve's end to its start
  std::array<std::vector<float>, 2> offsets_deg, lengths;
  /// Across a yarn: widths of the highlight and of the glow, in half widths of the yarn.
  std::array<double, 2> surface_width{}, volume_width{};
  std::array<double, 2> twist{};  ///< strands that pass under one's finger along a metre of yarn: spun yarns turn

  bool empty() const { return ends == 0; }
};

/// The look's weave; empty where it has no draft. InputError when the draft cannot be read.
Weave compile_weave(const Look& look);

/// Strands of fibres that show side by side on a yarn; few enough to be seen and many enough to look like fibres.
inline constexpr int strands_across = 7;

/// Widths of strips with which warp and weft cover `warp` and `weft` of the cloth's area (their sum at most 1), where
/// the warp is on top in the share `up` of all crossings: there is always exactly one such pair.
YarnWidths yarn_widths(double warp, double weft, double up);

/// Widens the yarns until they cover all of the cloth, in the shares that they had, for a picture in which nothing is
/// seen through gaps. The light stays that of the threads that are there, as in the far model without its gaps.
void close_gaps(Weave& weave);

/// What lies on top at one place of the cloth, and how much the picture makes of it.
struct YarnPlace {
  float near = 0;     ///< share of this one yarn in the picture; what is left of 1 is the threads' mean
  int family = -1;    ///< 0 warp, 1 weft, -1 nothing: a gap
  float offset = 0;   ///< tilt of the thread there [radians]
  float across = 0;   ///< place across the yarn, -1 to 1, growing with y (warp) or x (weft)
  float dark = 0;     ///< light that is missing at the yarn's very edge, 0 to 1: most where a float dives
  float fibre = 0;    ///< place across the strand of fibres that lies there, -1 to 1
  float strands = 0;  ///< share of the strands in the yarn's shading; 0 where they are too fine to be seen
  float light = 1;    ///< of a yarn, as a share: below 1 where it fills what were gaps
};

/// The place at weave coordinates (x, y) [metres], `near` and `strands` left 0. The weave must not be empty.
YarnPlace yarn_at(const Weave& weave, double x, double y);
/// Where the families cover `coverage` of the cloth around there instead of their shares in the weave (a sum above 1
/// counts as 1): over a repeat of constant coverage the mean is that far model's.
YarnPlace yarn_at(const Weave& weave, const std::array<double, 2>& coverage, double x, double y);

/// Mean-1 weight of a place across a yarn, or a strand of it, for light whose half vector has the sine `middle` of
/// its azimuth about the thread: a bump of `width` where the yarn's own normal looks along it, and edges that lack
/// the share `dark` of their light. For every middle in [-1, 1] its mean over `across` in [-1, 1] is 1.
double profile(double across, double middle, double width, double dark);

/// Blends the threads' mean `parts` at (wi, wo) with the yarn at `place`: F = (1 - near) F_far + near F_near, where
/// F_near = (1/Q) f M P cos theta_i of that yarn's one tangent times its profile and light, and Q is the far model's
/// full mean.
/// Unit directions in the cloth's frame. `threads` are those that `parts` came from.
void add_yarn(const Weave& weave, const Threads<float>& threads, const YarnPlace& place, const Vec3& wo,
              const Vec3& wi, ThreadSums<float>& parts);

/// Share of light that passes straight through: that of the far model, `gap`, and at a place that is seen from near 1
/// in a gap and 0 on a yarn.
float passing(float gap, const YarnPlace& place);

}  // namespace sateen
