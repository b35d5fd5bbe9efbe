#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "math/lane_functions.h"

// What the kernel of thread_kernel.h and its parts ask of a vector type.

namespace sateen {

namespace {

/// How the kernel sees a vector type.
template <class V>
struct Vector {
  using Real = float;
  static constexpr int width = V::width;
  static V load(const float* p) { return V::load(p); }
  static void store(float* p, V v) { v.store(p); }
  /// Eight numbers of a block of 8 tangents, for each of the blocks that are held.
  static V every_block(const float* p, int) {
    if constexpr (width == 16)
      return V::twice(p);
    else
      return V::load(p);
  }
  /// A pair of numbers, of warp and weft, in the first two lanes.
  static V pair(float warp, float weft, int) { return V::of(warp, weft, 1, 1); }
  /// One number for each of the blocks that are held.
  static V by_block(const float* values) {
    if constexpr (width == 16)
      return V::halves(values[0], values[1]);
    else
      return V(values[0]);
  }
};
template <>
struct Vector<double> {
  using Real = double;
  static constexpr int width = 1;
  static double load(const double* p) { return *p; }
  static void store(double* p, double v) { *p = v; }
  static double every_block(const double* p, int lane) { return p[lane]; }
  static double pair(double warp, double weft, int k) { return k == 0 ? warp : weft; }
  static double by_block(const double* values) { return values[0]; }
};

/// Blocks of 8 tangents that V takes at once.
template <class V>
constexpr int blocks_at_once = Vector<V>::width == 16 ? 2 : 1;

// cos theta below 1e-12 is far below what a unit direction in float can state (6e-8). The floor only keeps end-on
// threads finite until M, which is 0 or finite there, decides the limit.
constexpr float smallest_cos2 = 1e-24f;
constexpr float smallest_projection2 = 1e-30f;
constexpr double quarter_turn = 1.57079632679489662;

/// atan2(across, along) for along >= 0.
template <class V>
V signed_angle(V across, V along) {
  using Real = typename Vector<V>::Real;
  const V magnitude = atan_magnitude(across, max(along, V(Real(1e-30f))));
  return select_less(across, V(Real(0)), V(Real(0)) - magnitude, magnitude);
}

}  // namespace

}  // namespace sateen
