#pragma once
#include "image/light_file.h"

namespace sateen {

/// A picture of the six faces of a cube below one another, as OpenEXR lays them out, as a lat-long map of 4 N x 2 N
/// for faces of N x N: each pixel the mean of 2 x 2 bilinear look-ups within a face. Both are held in memory, within
/// `limits`. InputError unless the height is six times the width.
std::unique_ptr<LightFile> unfold_cube(const std::filesystem::path& path, std::unique_ptr<LightFile> faces,
                                       const ImageLimits& limits);

}  // namespace sateen
