#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/color.h"
#include "image/limits.h"
#include "scene/environment.h"

namespace sateen {

struct EnvironmentFileOptions {
  std::string color_space;  ///< wins over what the file says; empty: see read_environment
  float rotation_deg = 0;
  float exposure_ev = 0;
  std::string layer;                    ///< of an OpenEXR file of several (image/exr_layers.h); empty: chosen
  int width = 0;                        ///< a wider map is made so many texels wide while it is read; 0: as it is
  ImageLimits limits = image_limits();  ///< for what is held in memory: with `width` the small map
};

/// Folders searched for a map by name, in order: ".", each of $SATEEN_PATH (colon-separated) and its envmaps/, the
/// project's envmaps/, studiolights/world of every Blender installed under /usr/share/blender. Those that exist.
std::vector<std::filesystem::path> environment_folders();

/// A path as given, or a name with or without extension (exr, hdr, tif, tiff, png, jpg) in environment_folders().
/// InputError (unreadable) with the places searched and the nearest known name.
std::filesystem::path find_environment(const std::string& path_or_name);

/// Names that find_environment knows without a path, sorted, each once.
std::vector<std::string> environment_names();

/// Reads, mends, converts to the working space and compiles a map, band by band: beside the map itself little is
/// held. Colour space: `color_space`, else the file's own chromaticities, else the space its metadata names, else a
/// file rule of the config (not the default one), else lin_rec709 for float and half, srgb_texture for integer
/// pixels. `used_space`, where given, receives what was used and why, for `env inspect`.
Environment read_environment(const std::string& path_or_name, const ColorManager& colors,
                             const EnvironmentFileOptions& options = {}, std::string* used_space = nullptr);

}  // namespace sateen
