#pragma once
#include <functional>
#include <vector>

namespace sateen::test {

/// Probability that a chi-square deviate of `freedom` degrees exceeds `value`.
double chi_square_tail(double value, double freedom);

struct ChiSquare {
  double value = 0, freedom = 0, tail = 1;
  bool impossible = false;  ///< something was drawn where the density is 0
};

/// Pearson's test; bins are pooled in order of their expectation until each holds at least 5.
ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected);

/// Level for each of `tests` independent tests so that all pass with probability 1 - alpha (Sidak).
double sidak_level(double alpha, double tests);

/// The largest deviate that `tests` independent standard normal deviates stay below with probability 1 - alpha.
double sidak_deviate(double alpha, double tests);

/// Integral over a rectangle, halved until the midpoint rule of 3 x 3 agrees with its four quarters to `tolerance`.
double integrate(const std::function<double(double, double)>& f, double x0, double x1, double y0, double y1,
                 double tolerance, int depth = 7);

}  // namespace sateen::test
