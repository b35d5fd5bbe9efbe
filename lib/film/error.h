#pragma once
#include "film/film.h"

namespace sateen {

/// A value with the ends of its 95 % interval.
struct Interval {
  double value = 0, low = 0, high = 0;
};

inline constexpr double default_error_floor = 0.1;  ///< at exposure 0

/// Error of a picture: E = sqrt(mean over pixels and channels of variance / (value^2 + 0.01)), values at exposure 0.
/// The interval holds, with 95 % confidence, what the picture's own pixels really are off by, root mean square and
/// relative in the same way. Pixels with fewer than 2 samples do not count; `known` is false where there are no
/// others.
struct PictureError {
  bool known = false;
  double error = 0, low = 0, high = 0;
};
PictureError picture_error(const Film& film);

/// Variance of every pixel's mean as its 95 % interval wants it: half the pixel's own, half the mean of its up to
/// eight neighbours. Four replicates know a variance with 3 degrees of freedom, this knows it with about 11.
std::vector<Color> pooled_variances(const Film& film);

/// A pixel's 95 % interval is its value +- this times the root of its pooled variance. Student's t at 11 degrees of
/// freedom is 2.2 and covered 96 % and more of real pictures; this covers 95 to 96 % in 26 scenes (docs/error.md).
inline constexpr double interval_factor = 2.1;

/// The relative deviation that `share` of the pixels keep within: root mean square over channels, relative as in E.
double deviation_of_share(const Film& film, double share = 0.95);

}  // namespace sateen
