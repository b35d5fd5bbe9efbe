#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

// PNG, TIFF and JPEG files of the kinds that people have and the program does not write.

namespace sateen_test {

/// Rows of samples as the file holds them: colours, then alpha where the kind has one.
struct Samples {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint16_t> values;
};

/// `bits` 8 or 16; 1 to 4 channels (grey, grey and alpha, colour, colour and alpha). `transparent_code`: the one grey
/// or colour of a picture without alpha that is transparent.
void write_png(const std::filesystem::path& path, const Samples& samples, int bits,
               const std::vector<std::uint16_t>& transparent_code = {});

/// Indices into a palette of 8-bit colours, each with its alpha.
void write_palette_png(const std::filesystem::path& path, int width, int height,
                       const std::vector<std::uint8_t>& indices,
                       const std::vector<std::array<std::uint8_t, 4>>& palette);

/// What a TIFF says of a channel beyond the colours.
enum class TiffAlpha { none, associated, unassociated };

/// 8 bits, one strip, not packed. `orientation` 0: the file does not say.
void write_tiff(const std::filesystem::path& path, const Samples& samples, TiffAlpha alpha, int orientation = 0);

/// Gives a JPEG file the EXIF tag that says how it is to be turned.
void set_jpeg_orientation(const std::filesystem::path& path, int orientation);

}  // namespace sateen_test
