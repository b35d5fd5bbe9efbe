#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

// Means of independent batches, and how far two of them may lie apart.

namespace sateen_test {

/// The deviate that a standard normal passes, to either side, with probability `p`.
inline double two_sided_deviate(double p) {
  double low = 0, high = 40;
  for (int k = 0; k < 100; ++k) (std::erfc((low + high) / 2 / std::sqrt(2.0)) > p ? low : high) = (low + high) / 2;
  return low;
}

/// The deviate that none of `tests` standard normals passes with probability 1 - alpha (Sidak 1967: exact for
/// independent ones, safe for dependent ones).
inline double sidak_deviate(double alpha, double tests) {
  return two_sided_deviate(-std::expm1(std::log1p(-alpha) / tests));
}

/// The standard normal deviate as improbable as Student's t (Wallace 1959; off by less than 1 % from 8 degrees of
/// freedom on).
inline double normal_deviate(double t, double freedom) {
  const double z = (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(t * t / freedom));
  return std::copysign(z, t);
}

/// Mean and scatter of batches (Welford 1962).
struct Batches {
  int count = 0;
  double mean = 0, squares = 0;

  void add(double value) {
    ++count;
    const double before = value - mean;
    mean += before / count;
    squares += before * (value - mean);
  }
  double variance_of_mean() const { return count > 1 ? squares / (count - 1) / count : 0; }
};

/// What float's roundings may do to a mean: the part of a difference that is not judged.
inline constexpr double rounding = 4e-6;

/// Standard normal deviate of the difference of two means (Welch 1947). No variance is floored: a side whose batches
/// are all alike counts as exact, and where both are, the means must be the same up to rounding.
inline double difference_deviate(const Batches& a, const Batches& b) {
  const double slack = rounding * std::max(std::abs(a.mean), std::abs(b.mean));
  const double difference = std::max(std::abs(a.mean - b.mean) - slack, 0.0);
  if (difference == 0) return 0;
  const double va = a.variance_of_mean(), vb = b.variance_of_mean();
  if (va + vb == 0) return std::numeric_limits<double>::infinity();
  const double freedom = (va + vb) * (va + vb) / (va * va / (a.count - 1) + (vb > 0 ? vb * vb / (b.count - 1) : 0));
  return normal_deviate(std::copysign(difference / std::sqrt(va + vb), a.mean - b.mean), freedom);
}

/// The same against a known value.
inline double difference_deviate(const Batches& a, double expected) {
  Batches exact;
  exact.count = 2;
  exact.mean = expected;
  return difference_deviate(a, exact);
}

}  // namespace sateen_test
