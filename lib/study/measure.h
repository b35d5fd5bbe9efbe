#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "film/error.h"

namespace sateen {

/// How far a picture is from another, mean over pixels and channels of the working space.
struct PictureMse {
  double absolute = 0;  ///< mean of (x - r)^2
  /// Mean of (x - r)^2 / (r^2 + floor^2), pixels weighed by coverage: the square of E (film/error.h) where the truth
  /// is known.
  double relative = 0;
};

/// A picture of many samples that others are measured against.
struct Reference {
  int samples = 0;
  double error_floor = default_error_floor;
  std::vector<Color> values;
  std::vector<double> coverage;
  PictureMse own;  ///< its own error squared, from the scatter of its replicates
};
Reference make_reference(const Film& film, int samples, double error_floor);

/// Of a film to the truth: what lies between it and the reference less the reference's own error, and at least half
/// of what lies between them. Films of the reference's size and independent of it.
PictureMse mse_against(const Film& film, const Reference& reference);

/// E of pictures with different seeds from their PictureMse::relative: root mean square, jackknife_interval().
Interval error_interval(const std::vector<double>& squares);

/// Of positive quantities measured again and again, as times are: their median, and Student's interval about it in
/// logarithms. One value: low and high are that value.
Interval repeated_interval(const std::vector<double>& values);

/// The same for several quantities whose scatter is alike, as that of times on one machine: it is pooled, so that few
/// repetitions of each are enough. Sets of one size, 2 or more of each.
std::vector<Interval> pooled_intervals(const std::vector<std::vector<double>>& sets);

/// 97.5 % point of Student's t. `degrees` at least 1.
double student_t(int degrees);

/// A positive quantity that comes out of `count` independent repetitions together, such as a ratio of mean errors.
/// `log_value(k)` is its logarithm without repetition k, from 1; 0 leaves none out. The interval is the jackknife's
/// with Student's t, in logarithms: means stay means, so that a rare bright sample counts as it should. One
/// repetition: low and high are the value.
Interval jackknife_interval(int count, const std::function<double(int without)>& log_value);

}  // namespace sateen
