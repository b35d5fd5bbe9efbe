#pragma once
#include <algorithm>
#include <cmath>

#include "math/vector.h"

namespace sateen {

/// The smallest box along the axes about some points; without any, nothing lies in it.
struct Box {
  Vec3d low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  void add(const Vec3d& p) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  Vec3d middle() const { return (low + high) * 0.5; }
  double diagonal() const { return (high - low).length(); }
};

}  // namespace sateen
