#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/color.h"
#include "image/limits.h"

namespace sateen {

/// What a picture of light says of itself, and what was made of it.
struct LightFileInfo {
  int width = 0, height = 0;  ///< as seen: turned as the file asks
  std::string format;         ///< "openexr", "hdr", "tiff" ...
  std::string pixel_type;     ///< "half", "float", "uint8" ...
  std::string color_space;    ///< as the file states it; empty where it does not
  std::optional<ColorManager::Chromaticities> chromaticities;
  int first_row = 0;                ///< rows above this one are black, and
  int end_row = 1 << 30;            ///< from this one on
  bool xyz = false;                 ///< the numbers are CIE XYZ, D65 being white
  bool whole = false;               ///< held in memory as a whole: reading a band of it saves nothing
  std::vector<std::string> notes;   ///< what was chosen or done beyond the usual, a sentence each without full stop
  std::vector<std::string> doubts;  ///< what was assumed and may be wrong
};

/// An open picture of light: three numbers a pixel, top row first, in the space that `info` tells. One may be read a
/// band at a time, so that a map which is made smaller never lies in memory whole.
class LightFile {
 public:
  virtual ~LightFile() = default;
  /// Rows [y, y + count) into `rgb`, 3 * width * count floats, as the file has them: not a number, infinite and
  /// negative too. Bands are asked for downwards; a band further up begins anew. InputError where the file is
  /// damaged.
  virtual void read_rows(int y, int count, float* rgb) = 0;

  LightFileInfo info;
};

/// Opens by content: OpenEXR (image/exr_light.h), Radiance (image/radiance.h), else whatever the picture library
/// reads; a one-channel picture is grey. `layer` names the channels of an OpenEXR file (image/exr_layers.h); empty:
/// chosen. A picture that has to be held whole keeps to `limits`; the caller looks to what it makes of bands.
/// InputError.
std::unique_ptr<LightFile> open_light_file(const std::filesystem::path& path, const std::string& layer = {},
                                           const ImageLimits& limits = image_limits());

/// The first bytes of a regular file, at most `count`; empty where there is none.
std::string first_bytes(const std::filesystem::path& path, size_t count);

/// How every complaint of a reader about its file begins.
[[noreturn]] void refuse_picture(const std::filesystem::path& path, const std::string& message,
                                 const std::string& help = {});

}  // namespace sateen
