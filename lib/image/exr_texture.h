#pragma once
#include "image/file.h"

namespace sateen {

/// A picture of an OpenEXR file for a texture: the channels that it is, and alpha last where it has one.
struct ExrTexture {
  Image image;         ///< 3 channels, of grey pictures and numbers 1; one more with alpha
  ImageFileInfo info;  ///< of `image`
  bool xyz = false;    ///< the numbers are CIE XYZ
  std::string doubt;   ///< what was guessed; empty where nothing was
};

/// Chooses a layer as for light (image/exr_layers.h), or the one named; `number`: one number a pixel is wanted and
/// not a colour. InputError where there is none, with a list of them, where the layer holds names of objects and was
/// not asked for, and as open_exr_picture().
ExrTexture read_exr_texture(const std::filesystem::path& path, const std::string& layer, bool number,
                            const ImageLimits& limits = image_limits());

}  // namespace sateen
