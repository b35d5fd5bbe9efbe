#pragma once
#include <concepts>

#include "math/lanes.h"

// Elementary functions on Lanes: minimax polynomials found by Remez exchange (coefficients rounded to float). The
// errors stated are checked by tests/math. The double versions are libm's and serve as the oracle.

namespace sateen {

/// Lanes of any width.
template <class V>
concept FloatLanes = requires {
  V::width;
};

/// exp(x) for x <= 0; 0 below -87.3. Relative error below 2.5e-7.
template <FloatLanes V>
V exp_negative(V x) {
  const V lowest(-87.3f);
  const V y = max(x, lowest);
  const V n = round_nearest(y * V(1.44269504f));
  // ln 2 in two parts, the first short enough that its product with n is exact.
  const V f = fnma(n, V(-2.12194440e-4f), fnma(n, V(0.693359375f), y));
  V p(0.00138368461f);
  p = fma(p, f, V(0.0083748158f));
  p = fma(p, f, V(0.0416682256f));
  p = fma(p, f, V(0.166664202f));
  p = fma(p, f, V(0.499999921f));
  p = fma(p, f, V(1.00000004f));
  p = fma(p, f, V(1.0f));
  return select_less(x, lowest, V(0.0f), p * exp2_whole(n));
}
inline double exp_negative(double x) {
  return std::exp(x);
}

/// atan(|y| / x) for x > 0; x may be 0 where y is not. Absolute and relative error below 1.8e-7.
template <FloatLanes V>
V atan_magnitude(V y, V x) {
  const V a = abs(y);
  const V r = min(a, x) / max(a, x);
  const V t = r * r;
  V p(0.00290355463f);
  p = fma(p, t, V(-0.0162830161f));
  p = fma(p, t, V(0.0430393804f));
  p = fma(p, t, V(-0.0753367705f));
  p = fma(p, t, V(0.106546778f));
  p = fma(p, t, V(-0.142071337f));
  p = fma(p, t, V(0.199930541f));
  p = fma(p, t, V(-0.33333094f));
  p = fma(p, t, V(0.999999986f));
  const V small = p * r;
  return select_less(x, a, V(1.57079633f) - small, small);
}
inline double atan_magnitude(double y, double x) {
  return std::atan2(std::fabs(y), x);
}

/// atan(y / x)^2 for x > 0; the square is what a Gaussian wants.
template <class V>
V atan_squared(V y, V x) {
  const V angle = atan_magnitude(y, x);
  return angle * angle;
}

/// asin(sqrt(q))^2, that is (delta / 2)^2 for q = sin^2(delta / 2), h2 = cos^2(delta / 2) and h = cos(delta / 2):
/// all three are at hand without cancellation. Relative error below 1e-6.
template <FloatLanes V>
V half_angle_squared(V q, V h2, V h) {
  const V x = min(q, h2);
  V p(0.114298379f);
  p = fma(p, x, V(-0.098136109f));
  p = fma(p, x, V(0.0810400753f));
  p = fma(p, x, V(0.0148697972f));
  p = fma(p, x, V(0.0468038342f));
  p = fma(p, x, V(0.0748545078f));
  p = fma(p, x, V(0.166670369f));
  p = fma(p, x, V(0.999999985f));
  const V far = fnma(h, p, V(1.57079633f));
  return select_less(h2, q, far * far, x * p * p);
}
inline double half_angle_squared(double q, double h2, double) {
  const double angle = std::atan2(std::sqrt(q), std::sqrt(h2));
  return angle * angle;
}

/// sin(x) and cos(x) for |x| <= pi/2 (a little more does no harm). Absolute error below 1.2e-7.
template <FloatLanes V>
V sin_quarter(V x) {
  const V t = x * x;
  V p(-2.38896652e-08f);
  p = fma(p, t, V(2.75252981e-06f));
  p = fma(p, t, V(-0.000198408618f));
  p = fma(p, t, V(0.00833333098f));
  p = fma(p, t, V(-0.166666666f));
  return fma(p * t, x, x);
}
inline double sin_quarter(double x) {
  return std::sin(x);
}

template <FloatLanes V>
V cos_quarter(V x) {
  const V t = x * x;
  V p(1.990776e-09f);
  p = fma(p, t, V(-2.75246898e-07f));
  p = fma(p, t, V(2.48010405e-05f));
  p = fma(p, t, V(-0.00138888842f));
  p = fma(p, t, V(0.0416666665f));
  p = fma(p, t, V(-0.5f));
  return fma(p, t, V(1.0f));
}
inline double cos_quarter(double x) {
  return std::cos(x);
}

}  // namespace sateen
