#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sateen {

/// Angle of the vector (x, y) from the x axis, [-pi, pi]; absolute error below 4e-9, a fifteenth of what rounding a
/// direction to float costs. 0 for (0, 0). Several times faster than std::atan2. Polynomial: Chebyshev fit of
/// atan(r) / r in r^2 over [0, 1], 10 terms. NaN in, NaN out.
inline double fast_atan2(double y, double x) {
  const double a = std::abs(y), b = std::abs(x);
  const double low = std::min(a, b), high = std::max(a, b);
  const double r = low / (high > 0 ? high : 1.0);
  const double t = r * r, t2 = t * t, t4 = t2 * t2;
  const double p01 = 0.999999997160545465 + t * -0.333332762919825514;
  const double p23 = 0.199980752811487136 + t * -0.142600160828209048;
  const double p45 = 0.109323415013030928 + t * -0.0834972496830160175;
  const double p67 = 0.05708955593030619 + t * -0.0303518647857811706;
  const double p89 = 0.0104876492549493056 + t * -0.00170117006406859723;
  double angle = r * ((p01 + t2 * p23) + t4 * ((p45 + t2 * p67) + t4 * p89));
  angle = a > b ? std::numbers::pi / 2 - angle : angle;
  angle = std::signbit(x) ? std::numbers::pi - angle : angle;
  return std::copysign(angle, y);
}

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine of an angle in turns, any finite number below 2^31; absolute error below 1e-10. Chebyshev fits in
/// the square over an eighth of a turn, 5 terms each.
inline SineCosine fast_sincos_turns(double turns) {
  const double quarters = turns * 4;
  const double nearest = std::nearbyint(quarters);
  const double x = (quarters - nearest) * (std::numbers::pi / 2), t = x * x, t2 = t * t;
  const double s = x * ((0.999999999995673076 + t * -0.166666666315911646) +
                        t2 * ((0.00833332878245888032 + t * -0.000198392022122310998) + t2 * 2.71734568410899529e-6));
  const double c = (0.999999999952489417 + t * -0.499999996148576084) +
                   t2 * ((0.0416666166925328261 + t * -0.00138866179996470757) + t2 * 0.0000243798312511753657);
  // Looked up, since no branch foresees a quadrant.
  constexpr double sign[] = {1, 1, -1, -1};
  const double either[] = {s, c};
  const auto quadrant = std::size_t(static_cast<long long>(nearest) & 3);
  return {sign[quadrant] * either[quadrant & 1], sign[(quadrant + 1) & 3] * either[(quadrant + 1) & 1]};
}

}  // namespace sateen
