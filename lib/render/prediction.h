#pragma once
#include <vector>

namespace sateen {

/// E falls about as samples to this power, over looks, maps and meshes (docs/error.md).
inline constexpr double usual_slope = -0.575;

/// What a running render knows of itself at a barrier.
struct ErrorPoint {
  double samples = 0;    ///< mean a pixel
  double useful = 0;     ///< of these, the mean that went to pixels with noise: E follows it, empty pixels stop early
  double work = 0;       ///< of all samples so far; 1: of one that meets cloth, mean over the picture's pixels
  double next_work = 0;  ///< of one more mean sample as samples are dealt out from here on
  double error = 0;      ///< E
  double high = 0;       ///< upper end of its interval
  double seconds = 0;    ///< wall clock so far
  double cpu_seconds = 0;  ///< so far, all threads
};

/// A value with the interval that shall hold it in 90 % of runs.
struct Forecast {
  double value = 0, low = 0, high = 0;
};

/// What was said once, early on, and is held against the truth at the end.
struct Promise {
  bool made = false;
  double made_at_seconds = 0;
  Forecast error;        ///< E when the render stops
  Forecast samples;      ///< mean a pixel
  double work = 0;       ///< of all samples (ErrorPoint)
  Forecast seconds;      ///< wall clock of the whole render
  Forecast cpu_seconds;  ///< of the whole render, all threads
};

/// Where the later half of what was rendered began: by that the cost of what comes is told.
ErrorPoint later_half_of(const std::vector<ErrorPoint>& points);

/// How log E falls with log useful samples on this very run: least squares over the points so far, pulled to what
/// other scenes showed while they are few. `deviation`: standard deviation of the slope.
struct ErrorSlope {
  double slope = 0, deviation = 0;
};
ErrorSlope fit_slope(const std::vector<ErrorPoint>& points);

/// E and time once the mean is `samples`.
Promise promise_at(const std::vector<ErrorPoint>& points, double samples);

/// E at the end of a render that may take `seconds`, wall clock in all.
Promise promise_in_time(const std::vector<ErrorPoint>& points, double seconds);

/// Samples and time until the upper end of E's interval is at `target`: at a barrier, for only there it is looked at.
Promise promise_for_error(const std::vector<ErrorPoint>& points, double target);

}  // namespace sateen
