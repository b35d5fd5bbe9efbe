#pragma once
#include <string>
#include <vector>

#include "fabric/fabric.h"
#include "image/figure.h"

namespace sateen {

/// A direction in the plane of the warp or of the weft, `angle` degrees from the normal towards +x or +y.
struct PlaneDirection {
  float angle_deg = 0;
  bool along_weft = false;

  Vec3 direction() const;    ///< cloth frame
  std::string text() const;  ///< "60 warp", "0"
};

/// What a cloth does with light that it is seen under from one side.
struct LobeSummary {
  PlaneDirection view;
  Color albedo{0, 0, 0};  ///< reflectance under light from everywhere
  float peak = 0;         ///< largest F, mean of the channels [1/sr]
  Vec3 peak_direction{0, 0, 1};
};
LobeSummary summarise_lobe(const Fabric& fabric, const PlaneDirection& view);

/// Views that tables of albedo go by: 0, 30, 45, 60, 75, 85 degrees along warp and weft; 0 once.
const std::vector<PlaneDirection>& table_views();

/// F = f cos in the planes of warp and weft for views at 0, 30, 60 and 80 degrees (radius: square root of F), and
/// over the hemisphere from above for four views, brightness by the logarithm of F over four decades.
Figure lobe_figure(const Fabric& fabric, const std::string& title);

}  // namespace sateen
