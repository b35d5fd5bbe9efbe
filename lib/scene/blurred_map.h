#pragma once
#include "image/image.h"
#include "scene/environment.h"

namespace sateen {

/// The environment as a wide soft kernel sees it, for a backdrop that keeps the light's place and colour and none of
/// its detail. A small lat-long image laid out as the map before its rotation.
struct BlurredMap {
  Image radiance;  ///< 3 channels, working space
};

/// `width_deg`: the kernel's full width at half its height on the sphere, 2 to 180 (von Mises and Fisher's
/// distribution). The map is first averaged down to 8 texels a width. Same bits for any number of threads.
BlurredMap blur_environment(const Environment& environment, float width_deg, int threads = 0);

/// Look-up by a cubic B-spline, smooth to its second derivative, turned with the environment.
Color blurred_radiance(const BlurredMap& map, const Environment& environment, const Vec3& direction);

/// The map's radiance averaged by solid angle over a grid of `width` x `width` / 2; where the map is coarser its
/// texels are repeated.
Image average_environment(const Environment& environment, int width);

}  // namespace sateen
