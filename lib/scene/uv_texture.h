#pragma once
#include <functional>
#include <string>
#include <vector>

#include "image/color.h"
#include "image/texture.h"
#include "look/texture_value.h"
#include "scene/footprint.h"

namespace sateen {

/// A texture over the cloth's UVs: one picture, repeated over them, or one for each unit square (UDIM).
struct UvTexture {
  struct Tile {
    int u = 0, v = 0;
    Texture texture;
  };
  std::vector<Tile> tiles;
  bool udim = false;
  int channels = 1;
  std::array<float, 2> repeat{1, 1};                                ///< over one unit of u and of v
  std::array<float, 3> mean{0, 0, 0}, low{0, 0, 0}, high{0, 0, 0};  ///< over all pixels, by channel
  /// What lies under all tiles; they hold what is added to it.
  std::array<float, 3> under{0, 0, 0};

  bool covers(const Vec2& uv) const;  ///< false where a UDIM set has no tile
  /// As many values as channels; where there is no tile, the mean.
  void look_up(const Vec2& uv, const Footprint& footprint, float* values) const;
};

/// What a pixel becomes before the picture is filtered. `pixel`: a colour in the working space or one number, after
/// scale and offset, finite; `values` are the texture's channels. False where it had to be brought into range.
struct PixelUse {
  bool is_color = false;
  int channels = 1;
  std::function<bool(const float* pixel, float* values)> convert;
  std::array<float, 3> under{0, 0, 0};  ///< the values where the picture is transparent
};

/// How many pixels were not as they should be, and what was guessed of their files.
struct PixelCounts {
  long long pixels = 0, clamped = 0, not_finite = 0, transparent = 0;
  std::vector<std::string> doubts;
};

/// Reads the picture, or the tiles, of a look's texture. Colours are brought into the working space pixel by pixel,
/// before any filtering: encoded spaces must not be averaged as they are. InputError where a file cannot be read or
/// the space is not known, with the texture's origin and `field`. Where the picture is transparent the cloth's own
/// value, `under`, shows, in the share of alpha; pixels without any count as neither clamped nor not finite.
/// `metres_per_uv`: the size of the cloth, for textures that have one.
UvTexture read_uv_texture(const TextureValue& value, const std::string& field, const ColorManager& colors,
                          const PixelUse& use, float metres_per_uv, PixelCounts& counts);

}  // namespace sateen
