#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "image/color.h"
#include "image/image.h"
#include "image/limits.h"

namespace sateen {

/// What a picture file says of itself before its pixels are read; sizes as it is to be shown.
struct ImageFileInfo {
  int width = 0, height = 0, channels = 0;
  std::vector<std::string> channel_names;
  std::string format;       ///< "openexr", "hdr", "tiff" ...
  std::string pixel_type;   ///< "half", "float", "uint8" ...
  std::string color_space;  ///< as the file states it; empty where it does not
  std::optional<ColorManager::Chromaticities> chromaticities;
  int alpha_channel = -1;  ///< -1: there is none
  bool colors_times_alpha =
      false;  ///< the colours of the pixels are multiplied by it (EXR, TIFF with associated alpha)
};

ImageFileInfo read_image_info(const std::filesystem::path& path);

/// All channels as float. Only regular files within `limits`; InputError says what was found and expected.
/// Deep, tiled, mip-mapped and multi-part files: the first flat part's full resolution; data windows are placed
/// in their display window (black outside). Colours beside an alpha are as the file has them; an orientation tag is
/// obeyed (see apply_orientation).
Image read_image(const std::filesystem::path& path, const ImageLimits& limits = image_limits(),
                 ImageFileInfo* info = nullptr);

/// The picture as it is to be shown, from the one that is stored. `orientation`: 1 to 8 as TIFF and EXIF count them;
/// any other is taken as 1, upright. 5 to 8 swap width and height.
Image apply_orientation(Image image, int orientation);

/// One named group of channels of an OpenEXR file.
struct ImageLayer {
  std::string name;                   ///< empty for the beauty; else channels become "name.R" ...
  std::vector<std::string> channels;  ///< "R","G","B","A" or "X","Y","Z" or "U","V" ...
  bool half = false;
  Image image;
};

/// What half floats made of the colours of an OpenEXR file's half layers, alpha left out.
struct HalfRange {
  long long held = 0;   ///< finite values beyond +-65504, written as these
  float brightest = 0;  ///< the largest finite magnitude that was asked for

  /// Below 2^-14 half floats lose a bit with every stop, and below 2^-24 all: a sixteenth of the brightest lies
  /// there.
  bool is_dim() const { return brightest > 0 && brightest < 0x1p-10f; }
};

using Attribute = std::variant<int, double, std::string>;
using Attributes = std::map<std::string, Attribute>;  ///< "sateen:spp" ...

/// Threads that OpenEXR packs and unpacks pixels with, in the whole program; to be said before files are worked on.
/// Without it whoever calls does it alone.
void set_exr_threads(int threads);

/// Writes an OpenEXR file whole or not at all (base/files), reads it back and compares before it takes its name.
/// Half layers hold finite values at +-65504. No timestamp goes into the header, and no chromaticities where they are
/// not known.
HalfRange write_exr(const std::filesystem::path& path, const std::vector<ImageLayer>& layers,
                    const Attributes& attributes, const std::optional<ColorManager::Chromaticities>& chromaticities);

/// The same bytes of a picture that never lies in memory whole: `rows` makes the rows from y0 to y1 of all layers,
/// always the same ones, from the top downwards, once to write them and once more to compare.
using LayerRows = std::function<std::vector<ImageLayer>(int y0, int y1)>;
HalfRange write_exr(const std::filesystem::path& path, int width, int height, const LayerRows& rows,
                    const Attributes& attributes, const std::optional<ColorManager::Chromaticities>& chromaticities);

/// R, G, B and A of an OpenEXR file, 0 where it has none, without the memory of its other layers. InputError where
/// they cannot be read.
Image read_exr_beauty(const std::filesystem::path& path);

/// Display-referred picture (values in [0, 1], 3 or 4 channels) by extension: png (8 or 16 bit), jpg, tif.
/// Dithered to 8 bit (png, tif) with a fixed blue-noise pattern so that smooth satin does not band. Verified like
/// write_exr. Colours are written as they are, beside alpha and not multiplied by it, as PNG wants; JPEG drops alpha.
/// `srgb`: the codes are sRGB's, and a PNG says so; else they are Rec.1886 Rec.709's.
void write_display_image(const std::filesystem::path& path, const Image& image, const Attributes& attributes = {},
                         int bits = 8, bool srgb = true);

/// The same bytes of a picture of which `rows` makes the rows from y0 to y1, from the top downwards, once to write
/// them and once more to compare. All have `channels`, 3 or 4.
using DisplayRows = std::function<Image(int y0, int y1)>;
void write_display_image(const std::filesystem::path& path, int width, int height, int channels,
                         const DisplayRows& rows, const Attributes& attributes = {}, int bits = 8, bool srgb = true);

/// Loads what other pictures than EXRs are written with, if it is not loaded yet: it takes 110 MB, which are then
/// known to be there. OperationError where it cannot be.
void load_display_writer();

/// Whether all pixels of a picture file can be decoded, whatever its size; never more than a band of them is held.
bool image_decodes(const std::filesystem::path& path);

/// Attributes of a picture that the program wrote, "sateen:..." keys and Software; empty when there are none.
Attributes read_attributes(const std::filesystem::path& path);

}  // namespace sateen
