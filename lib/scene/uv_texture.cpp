#include "scene/uv_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/file.h"

namespace sateen {

namespace {

// A pixel's samples lie beside one another: what each filters may be narrower than the pixel.
constexpr float share_of_footprint = 0.5f;

const UvTexture::Tile* tile_at(const UvTexture& t, const Vec2& uv) {
  if (!t.udim) return &t.tiles.front();
  const float u = std::floor(uv.x), v = std::floor(uv.y);
  for (const UvTexture::Tile& tile : t.tiles)
    if (float(tile.u) == u && float(tile.v) == v) return &tile;
  return nullptr;
}

/// The picture as colours or numbers, scaled, with whatever is not finite replaced by 0 and counted.
Image read_pixels(const std::filesystem::path& path, const TextureValue& value, const ColorManager& colors,
                  bool is_color, PixelCounts& counts) {
  const Image file = read_image(path);
  const int channels = is_color ? 3 : 1;
  Image image(file.width, file.height, channels);
  const size_t pixels = image.pixels.size() / size_t(channels);
  for (size_t i = 0; i < pixels; ++i) {
    bool finite = true;
    for (int c = 0; c < channels; ++c) {
      // A grey picture is a colour of three equal channels.
      const int from = file.channels < 3 ? 0 : c;
      const float code = file.pixels[i * size_t(file.channels) + size_t(from)];
      finite = finite && std::isfinite(code);
      image.pixels[i * size_t(channels) + size_t(c)] = std::isfinite(code) ? code : 0;
    }
    counts.not_finite += finite ? 0 : 1;
  }
  if (is_color) colors.to_working(image, value.space);
  for (float& pixel : image.pixels) pixel = pixel * value.scale + value.offset;
  counts.pixels += std::int64_t(pixels);
  return image;
}

struct Sums {
  std::array<double, 3> sum{0, 0, 0};
  std::array<float, 3> low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};
};

Image convert(const Image& pixels, const PixelUse& use, PixelCounts& counts, Sums& sums) {
  Image values(pixels.width, pixels.height, use.channels);
  for (size_t i = 0; i < values.pixels.size() / size_t(use.channels); ++i) {
    float* to = &values.pixels[i * size_t(use.channels)];
    if (!use.convert(&pixels.pixels[i * size_t(pixels.channels)], to)) ++counts.clamped;
    for (size_t c = 0; c < size_t(use.channels); ++c) {
      sums.sum[c] += double(to[c]);
      sums.low[c] = std::min(sums.low[c], to[c]);
      sums.high[c] = std::max(sums.high[c], to[c]);
    }
  }
  return values;
}

}  // namespace

bool UvTexture::covers(const Vec2& uv) const {
  return tile_at(*this, uv) != nullptr;
}

void UvTexture::look_up(const Vec2& uv, const Footprint& footprint, float* values) const {
  const Tile* tile = tile_at(*this, uv);
  if (!tile) {
    std::copy_n(mean.begin(), channels, values);
    return;
  }
  const auto scaled = [&](const Vec2& v, float by) { return Vec2(v.x * repeat[0] * by, v.y * repeat[1] * by); };
  TexturePoint point;
  point.uv = scaled(uv, 1) - Vec2(float(tile->u), float(tile->v));
  point.dx = scaled(footprint.dx, share_of_footprint);
  point.dy = scaled(footprint.dy, share_of_footprint);
  tile->texture.look_up(point, values);
}

UvTexture read_uv_texture(const TextureValue& value, const std::string& field, const ColorManager& colors,
                          const PixelUse& use, float metres_per_uv, PixelCounts& counts) {
  UvTexture texture;
  texture.udim = is_udim(value.path);
  texture.channels = use.channels;
  texture.repeat = value.repeat;
  if (is_sized(value))
    for (size_t i = 0; i < 2; ++i) texture.repeat[i] = metres_per_uv * 100 / value.repeat_cm[i];
  Sums sums;
  const PixelCounts before = counts;
  try {
    for (const TextureFile& file : texture_files(value.path)) {
      const Image pixels = read_pixels(file.path, value, colors, use.is_color, counts);
      const TextureWrap wrap = texture.udim ? TextureWrap::clamp : value.wrap;
      texture.tiles.push_back({file.u, file.v, Texture(convert(pixels, use, counts, sums), wrap, use.is_color)});
    }
    if (texture.tiles.empty()) throw InputError(value.path + ": no such file", {}, InputError::Kind::unreadable);
  } catch (const InputError& error) {
    Diagnostic d = error.diagnostics.front();
    d.message = fmt::format("the texture of {}: {}{}", field, d.file.empty() ? "" : d.file + ": ", d.message);
    d.file = value.origin;
    throw InputError(error.kind, {d});
  }
  for (size_t c = 0; c < size_t(use.channels); ++c) {
    texture.mean[c] = float(sums.sum[c] / double(counts.pixels - before.pixels));
    texture.low[c] = sums.low[c];
    texture.high[c] = sums.high[c];
  }
  return texture;
}

}  // namespace sateen
