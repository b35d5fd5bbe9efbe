#pragma once
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "fabric/fabric.h"
#include "look/read.h"
#include "sampling/split_mix.h"

// What the tests of the cloth model share: the looks of the project, compiled once, and plain random numbers.

namespace sateen::test {

inline bool long_tests() {
  return std::getenv("SATEEN_LONG_TESTS") != nullptr;
}

/// Names of the seven presets of Table II.
inline const std::vector<std::string>& presets() {
  static const std::vector<std::string> names{"linen_plain",
                                              "silk_crepe_de_chine",
                                              "polyester_satin_charmeuse",
                                              "polyester_satin_charmeuse_back",
                                              "silk_shot",
                                              "velvet",
                                              "velvet_red"};
  return names;
}

/// Every file in looks/, sorted by name.
const std::vector<Look>& all_looks();
const Look& look_named(const std::string& name);

/// Compiled with its table, in the look's own colour space; once a process.
const Fabric& fabric_of(const Look& look);

/// The renderer's quadrature of warp and weft.
struct Curves {
  std::vector<Tangent> warp, weft;
};
Curves curves_of(const Look& look);

/// A far finer one: panels of at most one gamma and `degrees`, with `nodes` each.
Curves fine_curves_of(const Look& look, double degrees, int nodes);

/// A look with every parameter drawn from its legal range; `adversarial` prefers the ends of the ranges.
struct Random;
Look random_look(Random& random, bool adversarial);

struct Random : SplitMix {
  /// [0, 1) with 32 bits, as the renderer's sequences have.
  double uniform() { return double(bits() >> 32) * 0x1p-32; }
  double between(double a, double b) { return a + (b - a) * uniform(); }
  int below(int n) { return int(bits() % std::uint64_t(n)); }
};

/// A unit direction above the cloth by inclination of z and azimuth [degrees].
inline Vec3 direction(double polar_deg, double azimuth_deg) {
  const double p = polar_deg * M_PI / 180, a = azimuth_deg * M_PI / 180;
  return Vec3(float(std::sin(p) * std::cos(a)), float(std::sin(p) * std::sin(a)), float(std::cos(p)));
}
/// Uniform in the hemisphere.
Vec3 random_direction(Random& random);
/// A third uniform, a third grazing (below 3 degrees of the horizon), a third near a frame axis or plane.
Vec3 torture_direction(Random& random);

/// Mean of the channels: what the samplers are built for and judged by.
inline double brightness(const Fabric& fabric, const ThreadSums<float>& s) {
  return double(s.surface[0]) + s.surface[1] + double(mean_component(fabric.A[0])) * s.volume[0] +
         double(mean_component(fabric.A[1])) * s.volume[1];
}

/// A double direction of unit length from the float one: the oracle's view of the same pair.
inline Vec3d exact(const Vec3& w) {
  const Vec3d v(w.x, w.y, w.z);
  return v / std::sqrt(v.dot(v));
}

}  // namespace sateen::test
