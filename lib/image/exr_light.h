#pragma once
#include "image/light_file.h"

namespace sateen {

/// Opens the layer of an OpenEXR file that holds the picture, or the one named (image/exr_layers.h). `envmap = cube`
/// becomes a lat-long map of four faces by two. InputError for deep parts only, for a file without such a layer (all
/// are listed), for a damaged one.
std::unique_ptr<LightFile> open_exr_light(const std::filesystem::path& path, const std::string& layer = {},
                                          const ImageLimits& limits = image_limits());

}  // namespace sateen
