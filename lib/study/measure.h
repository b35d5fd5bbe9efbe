#pragma once
#include <functional>
#include <vector>

#include "film/error.h"

namespace sateen {

/// How far a picture is from another, mean over pixels and channels of the working space at exposure 0.
struct PictureMse {
  double absolute = 0;  ///< mean of (x - r)^2
  double relative = 0;  ///< mean of (x - r)^2 / (r^2 + 0.01): the square of E (film/film.h) where the truth is known
};

/// A picture of many samples that others are measured against.
struct Reference {
  int samples = 0;
  std::vector<Color> values;
  PictureMse own;  ///< its own error squared, from the scatter of its replicates
};
Reference make_reference(const Film& film, int samples);

/// Of a film to the truth: what lies between it and the reference less the reference's own error, and at least half
/// of what lies between them. Films of the reference's size and independent of it.
PictureMse mse_against(const Film& film, const Reference& reference);

/// 97.5 % point of Student's t. `degrees` at least 1.
double student_t(int degrees);

/// A positive quantity that comes out of `count` independent repetitions together, such as a ratio of mean errors.
/// `log_value(k)` is its logarithm without repetition k, from 1; 0 leaves none out. The interval is the jackknife's
/// with Student's t, in logarithms: means stay means, so that a rare bright sample counts as it should. One
/// repetition: low and high are the value.
Interval jackknife_interval(int count, const std::function<double(int without)>& log_value);

}  // namespace sateen
