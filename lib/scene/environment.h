#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "image/color.h"
#include "image/image.h"
#include "math/vector.h"

namespace sateen {

/// What had to be mended in a map, with the first place of each kind (pixel x, y from the top left).
struct EnvironmentRepairs {
  struct Kind { std::int64_t count = 0; int first_x = -1, first_y = -1; };
  Kind not_a_number, infinite, negative;
  bool any() const { return not_a_number.count || infinite.count || negative.count; }
};

enum class EnvironmentDensity {
  radiance,    ///< proportional to luminance
  compensated  ///< proportional to max(0, L - mean L), Karlik et al. 2019; the plain one where that is all zero
};

/// A lat-long map as a light at infinity. Row 0 is up (+Y). Direction d has longitude u = atan2(d.x, -d.z)/(2 pi) + 1/2
/// (so -Z, the way the default camera looks, is the middle of the map) and colatitude v = acos(d.y)/pi. Radiance is constant in a texel,
/// so that look-up and density agree exactly. Compiled: working space, rotated by `rotation`, scaled by 2^ev.
struct Environment {
  int width = 0, height = 0;
  struct Texel { Color radiance; float pad; };
  std::vector<Texel> texels;
  float rotation = 0;  ///< radians about +Y; positive turns the light to the right as the default camera sees it
  EnvironmentRepairs repairs;
  std::string name;
  Color mean_radiance{0, 0, 0};  ///< over the sphere
  bool black = true;
  // ... distributions: see environment.cpp
};

struct EnvironmentSample {
  Vec3 direction;
  Color radiance;
  float pdf;  ///< solid angle [1/sr]; 0 when the map is black
};

}  // namespace sateen
