#pragma once
#include "image/image.h"
#include "image/texture_wrap.h"

namespace sateen {

/// A place on a texture and the area around it that one look-up stands for. u runs right, v up; (0, 0) is the lower
/// left corner of the picture, (1, 1) the upper right one.
struct TexturePoint {
  Vec2 uv;
  Vec2 dx{0, 0}, dy{0, 0};  ///< edges of the area
};

/// A picture prepared for filtered look-ups by OpenImageIO's texture system: halved again and again by boxes down to
/// one pixel, which is the mean. Look-ups are bilinear within a level and anisotropic over levels, so a value lies
/// between the smallest and the largest pixel, and an area larger than the picture gives its mean. The same bits on
/// any thread and in any order. Pixels are taken as they are: convert colours before.
class Texture {
 public:
  /// `picture`: 1 to 4 channels, finite. `as_half`: kept in half floats, for colours; else in floats.
  Texture(const Image& picture, TextureWrap wrap, bool as_half);
  ~Texture();
  Texture(Texture&&) noexcept;

  void look_up(const TexturePoint& point, float* values) const;  ///< as many values as channels

 private:
  void* state_ = nullptr;  ///< the texture system's, behind image/oiio/functions.h
};

/// The next smaller level: each pixel the mean over its share of the larger picture, so the mean stays the mean for
/// sides that cannot be halved too. Sides are halved and rounded down, 1 at least.
Image halve_image(const Image& image);

}  // namespace sateen
