#pragma once
#include <vector>

#include "scene/environment.h"

namespace sateen {

/// A bright, connected part of a map.
struct LightRegion {
  Vec3 direction;           ///< its middle by energy, unit, rotation included
  float azimuth_deg = 0;    ///< 0: the camera's side (+Z), 90: right (+X), 180 or -180: behind; (-180, 180]
  float elevation_deg = 0;  ///< -90 to 90
  float solid_angle = 0;    ///< [sr]
  float share = 0;          ///< of the map's luminous energy, 0 to 1
  float peak = 0;           ///< largest luminance in it
};

/// What `env inspect` prints. Luminances in the working space's Y.
struct EnvironmentReport {
  int width = 0, height = 0;
  float smallest = 0, largest = 0, mean = 0;  ///< luminance; mean over the sphere
  float largest_over_mean = 0;                ///< 0 for a black map
  float stops = 0;  ///< log2 of the largest luminance over the one that 1 % of the lit texels stay below
  float metered_ev = 0;
  EnvironmentRepairs repairs;
  std::vector<std::string> notes, notices;  ///< of the map's reading; environment_notices
  std::vector<LightRegion> regions;         ///< up to 5, most energy first; see inspect_environment
};

/// Regions are connected texels (eight neighbours, across the seam) of more than 3 times the mean luminance; where
/// there are none, as under an overcast sky, of more than 1.2 times. A constant map has no regions.
EnvironmentReport inspect_environment(const Environment& environment);

/// What had to be mended, a sentence a kind, with the first place.
std::vector<std::string> repair_texts(const EnvironmentRepairs& repairs);

/// Everything that makes a map doubtful as a light: repairs, what its reading assumed, black, not twice as wide as
/// high.
std::vector<std::string> environment_notices(const Environment& environment);

}  // namespace sateen
