#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sateen::test {

double chi_square_tail(double value, double freedom) {
  // Regularised incomplete gamma: series below the mean, continued fraction above it.
  const double a = freedom / 2, x = value / 2;
  if (!(x > 0)) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 100000 && term > sum * 1e-15; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int n = 1; n < 100000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (an * d + b);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-14) break;
  }
  return front * h;
}

ChiSquare chi_square(const std::vector<double>& observed, const std::vector<double>& expected) {
  std::vector<size_t> order(expected.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](size_t i, size_t j) { return expected[i] < expected[j]; });
  ChiSquare result;
  double o = 0, e = 0;
  int pools = 0;
  const auto close = [&] {
    result.value += (o - e) * (o - e) / e;
    ++pools;
    o = e = 0;
  };
  for (const size_t i : order) {
    if (!(expected[i] > 0) && observed[i] > 0) result.impossible = true;
    o += observed[i];
    e += expected[i];
    if (e >= 5) close();
  }
  if (e > 0.5) close();
  result.freedom = pools - 1;
  result.tail = chi_square_tail(result.value, result.freedom);
  return result;
}

double sidak_level(double alpha, double tests) {
  return -std::expm1(std::log1p(-alpha) / tests);
}

double sidak_deviate(double alpha, double tests) {
  const double tail = sidak_level(alpha, tests) / 2;
  double low = 0, high = 40;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) / 2 > tail ? low : high) = middle;
  }
  return high;
}

double integrate(const std::function<double(double, double)>& f, double x0, double x1, double y0, double y1,
                 double tolerance, int depth) {
  const auto rule = [&](double a0, double a1, double b0, double b1) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += f(a0 + (a1 - a0) * (i + 0.5) / 3, b0 + (b1 - b0) * (j + 0.5) / 3);
    return sum / 9 * (a1 - a0) * (b1 - b0);
  };
  const double xm = (x0 + x1) / 2, ym = (y0 + y1) / 2;
  const double whole = rule(x0, x1, y0, y1);
  const double parts = rule(x0, xm, y0, ym) + rule(xm, x1, y0, ym) + rule(x0, xm, ym, y1) + rule(xm, x1, ym, y1);
  if (depth == 0 || std::abs(whole - parts) < tolerance) return parts + (parts - whole) / 3;
  return integrate(f, x0, xm, y0, ym, tolerance / 2, depth - 1) +
         integrate(f, xm, x1, y0, ym, tolerance / 2, depth - 1) +
         integrate(f, x0, xm, ym, y1, tolerance / 2, depth - 1) +
         integrate(f, xm, x1, ym, y1, tolerance / 2, depth - 1);
}

}  // namespace sateen::test
