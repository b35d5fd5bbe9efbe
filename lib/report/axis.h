#pragma once
#include <string>
#include <vector>

namespace sateen {

/// Values along one axis of a plot and where they lie: at() is 0 at the low end and 1 at the high one.
struct Axis {
  double low = 0, high = 1;
  bool logarithmic = false;

  double at(double value) const;
};

/// An axis that holds all values with a little room; `values` that cannot be shown (not finite, or not positive on a
/// logarithmic axis) do not count. Without any: 0 to 1, or 0.1 to 1.
Axis axis_for(const std::vector<double>& values, bool logarithmic);

struct Tick {
  double value = 0;
  std::string label;  ///< empty: a small line alone
};

/// About `most` labelled ticks. Logarithmic: powers of ten with 2 and 5 between where there is room and unlabelled
/// lines at the rest; linear: steps of 1, 2 or 5 times a power of ten.
std::vector<Tick> axis_ticks(const Axis& axis, int most);

}  // namespace sateen
