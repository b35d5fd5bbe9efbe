#include <cmath>

#include "report/plot.h"

namespace sateen {

PowerFit fit_power(const std::vector<PlotPoint>& points) {
  double n = 0, sx = 0, sy = 0;
  for (const PlotPoint& p : points)
    if (p.x > 0 && p.y > 0) ++n, sx += std::log(p.x), sy += std::log(p.y);
  PowerFit fit;
  if (n < 2) return fit;
  const double mx = sx / n, my = sy / n;
  double xx = 0, xy = 0;
  for (const PlotPoint& p : points)
    if (p.x > 0 && p.y > 0) {
      const double dx = std::log(p.x) - mx;
      xx += dx * dx;
      xy += dx * (std::log(p.y) - my);
    }
  if (!(xx > 1e-12)) return fit;
  fit.known = true;
  fit.slope = xy / xx;
  fit.factor = std::exp(my - fit.slope * mx);
  double left = 0;
  for (const PlotPoint& p : points)
    if (p.x > 0 && p.y > 0) left += std::pow(std::log(p.y / fit.factor) - fit.slope * std::log(p.x), 2);
  if (n > 2) fit.slope_error = std::sqrt(left / (n - 2) / xx);
  return fit;
}

}  // namespace sateen
