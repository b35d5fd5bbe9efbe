#pragma once
#include "image/light_file.h"

namespace sateen {

/// Header of a Radiance picture (.hdr, .pic): lines of text up to an empty one, then the resolution string.
struct RadianceHeader {
  bool xyz = false;                ///< FORMAT=32-bit_rle_xyze; no FORMAT line means rgbe
  double exposure[3] = {1, 1, 1};  ///< all EXPOSURE and COLORCORR lines multiplied: the pixels have it in them
  double gamma = 1;                ///< GAMMA: pixels are light to the power of 1 / gamma
  std::optional<ColorManager::Chromaticities> primaries;
  int scanlines = 0, length = 0;  ///< stored rows or columns, and pixels in each
  bool columns = false;           ///< a scanline is a column of the picture
  bool right_to_left = false, bottom_up = false;
  long long pixels_at = 0;  ///< byte where the first scanline begins
};

/// Whether a file begins as all Radiance pictures do, with "#?" and any program's name.
bool is_radiance(const std::filesystem::path& path);

/// Reads the header. Lines may end with a carriage return. InputError for a format other than rgbe and xyze, numbers
/// that are none, or a missing or impossible resolution string.
RadianceHeader read_radiance_header(const std::filesystem::path& path);

/// Opens a Radiance picture whose scanlines are flat, run-length encoded in the old way (before 1991) or in the new
/// one, and stored in any of the eight orders; all but the usual one (-Y +X) hold it in memory, 4 bytes a pixel.
/// Values are mantissa * 2^(exponent - 136), divided by what EXPOSURE and COLORCORR say was multiplied in, gamma
/// undone before. `info.xyz` is set for XYZE; PRIMARIES become `info.chromaticities`.
std::unique_ptr<LightFile> open_radiance(const std::filesystem::path& path,
                                         const ImageLimits& limits = image_limits());

}  // namespace sateen
