#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "image/texture_wrap.h"

namespace sateen {

/// A texture that stands in place of a value of a look:
///     {"texture": "print.png", "space": "srgb_texture", "repeat_cm": [12, 12]}
/// The value at a point is pixel * scale + offset, after a colour's pixels have been brought from `space` into the
/// working space; numbers are the pixels' first channel. `layer` says which one of an OpenEXR file. Where the picture
/// has an alpha below 1, the value that the field has without the texture shows through. `<UDIM>` in the path stands
/// for 1001 + u + 10 v: one file for each unit square of the UVs.
struct TextureValue {
  std::string path;   ///< absolute
  std::string space;  ///< of a colour's pixels, never empty; of numbers: empty
  std::string layer;  ///< of an OpenEXR file; empty: chosen (image/exr_layers.h)
  float scale = 1, offset = 0;
  std::array<float, 2> repeat{1, 1};  ///< how often it is repeated over one unit of u and of v, 0.001 to 10000
  /// Size of one repeat along u and v on the cloth [centimetres], 0.001 to 100000; 0, 0: `repeat` says it.
  std::array<float, 2> repeat_cm{0, 0};
  TextureWrap wrap = TextureWrap::repeat;
  std::string origin;  ///< "looks/silk.json:14" or "--set", for messages alone
};

/// Whether its size is in centimetres: it takes a cloth of a known size.
inline bool is_sized(const TextureValue& texture) {
  return texture.repeat_cm[0] > 0;
}

bool is_udim(const std::string& path);

/// The files behind a path: one, or those of a UDIM set that are there, by number. u and v are those of the lower
/// left corner of the unit square.
struct TextureFile {
  int u = 0, v = 0;
  std::filesystem::path path;
};
std::vector<TextureFile> texture_files(const std::string& path);

/// As it stands in the look file `look_file`, from whose folder the path is written.
std::string texture_text(const TextureValue& texture, const std::string& look_file);

/// Equal for textures that give equal values: with a hash of the files' contents in place of the path. InputError
/// where they cannot be read.
std::string texture_identity(const TextureValue& texture);

/// "repeat", "clamp", "mirror", in the order of the enum.
const std::vector<std::string>& wrap_names();

}  // namespace sateen
