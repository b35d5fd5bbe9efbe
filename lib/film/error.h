#pragma once
#include <cmath>

#include "film/film.h"

namespace sateen {

/// Below this value, as the picture is shown, errors count as absolute and no longer as relative ones.
inline constexpr double default_error_floor = 0.1;

/// The same in the light of a scene that is shown at this exposure.
inline double error_floor_at(double exposure_ev) {
  return default_error_floor * std::exp2(-exposure_ev);
}

/// A value with the ends of its 95 % interval.
struct Interval {
  double value = 0, low = 0, high = 0;
};

/// Mid grey, 0.18 on the display, in the light of a scene with that floor.
inline double mid_grey_of(double error_floor) {
  return 0.18 / default_error_floor * error_floor;
}

/// In what a picture's errors are counted.
struct ErrorScale {
  double floor = default_error_floor;  ///< scene light
  int threads = 1;
};

/// What a picture is judged over, as light in all channels: black, and where alpha is not 1 everywhere mid grey, 0.18
/// on the display, too.
std::vector<double> backings(const Film& film, const ErrorScale& scale);

/// The pixel as it lies over a backing.
FilmPixel laid_over(const FilmPixel& pixel, double backing);

/// What a pixel adds to E squared.
struct PixelError {
  double relative = 0;  ///< variance of its mean over value^2 + floor^2, mean over channels
  double weighted = 0;  ///< the same, times its coverage
  double at_most = 0;   ///< `weighted` if what is unsure of the value were no part of it
  float coverage = 0;   ///< its weight: 0 where nothing is rendered
  bool known = false;   ///< it has two samples and more
};

/// Relative variances of all pixels. What a variance is divided by and weighed with is taken from samples that have
/// no part in it: from the replicates that are not being compared, and from the neighbours; a pixel that is too
/// bright by chance would excuse itself. Both tell of the value; they are joined by how sure they are, and what stays
/// unsure is part of its square. Over the backing that is worse.
std::vector<PixelError> pixel_errors(const Film& film, const ErrorScale& scale);

/// Error of a picture: E = sqrt(mean over pixels and channels of variance / (value^2 + floor^2)), pixels weighed by
/// their coverage. The interval holds, with 95 % confidence, what the picture's own pixels really are off by, root
/// mean square and relative in the same way. Pixels with fewer than 2 samples do not count; `known` is false where
/// there are no others.
struct PictureError {
  bool known = false;
  double error = 0, low = 0, high = 0;
  /// Few pixels carry much of it: a longer render may meet what this one has not, and E then grows.
  bool rests_on_rare_samples = false;
};
PictureError picture_error(const Film& film, const std::vector<PixelError>& errors);
PictureError picture_error(const Film& film, const ErrorScale& scale);

/// Variance of every pixel's mean as its 95 % interval wants it: half the pixel's own, half the mean of its up to
/// eight neighbours. Four replicates know a variance with 3 degrees of freedom, this knows it with about 11.
std::vector<Vec3d> pooled_variances(const Film& film);

/// A pixel's 95 % interval is its value +- this times the root of its pooled variance. Student's t at 11 degrees of
/// freedom is 2.2 and covered 96 % and more of real pictures; this covers 95 to 96 % in 26 scenes (docs/error.md).
inline constexpr double interval_factor = 2.1;

/// The relative deviation that `share` of what is covered keeps within: root mean square over channels, relative as
/// in E.
double deviation_of_share(const Film& film, const std::vector<PixelError>& errors, double share = 0.95);

}  // namespace sateen
