#pragma once
#include "math/lanes.h"

// Elementary functions on Lanes: minimax polynomials found by Remez exchange (coefficients rounded to float). The
// errors stated are checked by tests/math. The double versions are libm's and serve as the oracle.

namespace sateen {

/// exp(x) for x <= 0; 0 below -87.3. Relative error below 2.5e-7.
inline Lanes exp_negative(Lanes x) {
  const Lanes lowest(-87.3f);
  const Lanes y = max(x, lowest);
  const Lanes n = round_nearest(y * Lanes(1.44269504f));
  // ln 2 in two parts, the first short enough that its product with n is exact.
  const Lanes f = fnma(n, Lanes(-2.12194440e-4f), fnma(n, Lanes(0.693359375f), y));
  Lanes p(0.00138368461f);
  p = fma(p, f, Lanes(0.0083748158f));
  p = fma(p, f, Lanes(0.0416682256f));
  p = fma(p, f, Lanes(0.166664202f));
  p = fma(p, f, Lanes(0.499999921f));
  p = fma(p, f, Lanes(1.00000004f));
  p = fma(p, f, Lanes(1.0f));
  return select_less(x, lowest, Lanes(0.0f), p * exp2_whole(n));
}
inline double exp_negative(double x) { return std::exp(x); }

/// atan(|y| / x) for x > 0; x may be 0 where y is not. Absolute and relative error below 1.8e-7.
inline Lanes atan_magnitude(Lanes y, Lanes x) {
  const Lanes a = abs(y);
  const Lanes r = min(a, x) / max(a, x);
  const Lanes t = r * r;
  Lanes p(0.00290355463f);
  p = fma(p, t, Lanes(-0.0162830161f));
  p = fma(p, t, Lanes(0.0430393804f));
  p = fma(p, t, Lanes(-0.0753367705f));
  p = fma(p, t, Lanes(0.106546778f));
  p = fma(p, t, Lanes(-0.142071337f));
  p = fma(p, t, Lanes(0.199930541f));
  p = fma(p, t, Lanes(-0.33333094f));
  p = fma(p, t, Lanes(0.999999986f));
  const Lanes small = p * r;
  return select_less(x, a, Lanes(1.57079633f) - small, small);
}
inline double atan_magnitude(double y, double x) { return std::atan2(std::fabs(y), x); }

/// atan(y / x)^2 for x > 0; the square is what a Gaussian wants.
template <class V>
V atan_squared(V y, V x) {
  const V angle = atan_magnitude(y, x);
  return angle * angle;
}

/// asin(sqrt(q))^2, that is (delta / 2)^2 for q = sin^2(delta / 2), h2 = cos^2(delta / 2) and h = cos(delta / 2):
/// all three are at hand without cancellation. Relative error below 1e-6.
inline Lanes half_angle_squared(Lanes q, Lanes h2, Lanes h) {
  const Lanes x = min(q, h2);
  Lanes p(0.114298379f);
  p = fma(p, x, Lanes(-0.098136109f));
  p = fma(p, x, Lanes(0.0810400753f));
  p = fma(p, x, Lanes(0.0148697972f));
  p = fma(p, x, Lanes(0.0468038342f));
  p = fma(p, x, Lanes(0.0748545078f));
  p = fma(p, x, Lanes(0.166670369f));
  p = fma(p, x, Lanes(0.999999985f));
  const Lanes far = fnma(h, p, Lanes(1.57079633f));
  return select_less(h2, q, far * far, x * p * p);
}
inline double half_angle_squared(double q, double h2, double) {
  const double angle = std::atan2(std::sqrt(q), std::sqrt(h2));
  return angle * angle;
}

/// sin(x) and cos(x) for |x| <= pi/2 (a little more does no harm). Absolute error below 1.2e-7.
inline Lanes sin_quarter(Lanes x) {
  const Lanes t = x * x;
  Lanes p(-2.38896652e-08f);
  p = fma(p, t, Lanes(2.75252981e-06f));
  p = fma(p, t, Lanes(-0.000198408618f));
  p = fma(p, t, Lanes(0.00833333098f));
  p = fma(p, t, Lanes(-0.166666666f));
  return fma(p * t, x, x);
}
inline double sin_quarter(double x) { return std::sin(x); }

inline Lanes cos_quarter(Lanes x) {
  const Lanes t = x * x;
  Lanes p(1.990776e-09f);
  p = fma(p, t, Lanes(-2.75246898e-07f));
  p = fma(p, t, Lanes(2.48010405e-05f));
  p = fma(p, t, Lanes(-0.00138888842f));
  p = fma(p, t, Lanes(0.0416666665f));
  p = fma(p, t, Lanes(-0.5f));
  return fma(p, t, Lanes(1.0f));
}
inline double cos_quarter(double x) { return std::cos(x); }

}  // namespace sateen
