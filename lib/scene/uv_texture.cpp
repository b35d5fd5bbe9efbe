#include "scene/uv_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/error.h"
#include "base/memory.h"
#include "image/alpha.h"
#include "image/exr_picture.h"
#include "image/exr_texture.h"
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

struct Picture {
  Image image;
  std::vector<float> alpha;  ///< empty: opaque
};

bool names_xyz(std::string space) {
  for (char& c : space) c = char(std::tolower(static_cast<unsigned char>(c)));
  return space.find("xyz") != std::string::npos;
}

Image read_file(const std::filesystem::path& path, const TextureValue& value, bool is_color, ImageFileInfo& info,
                PixelCounts& counts) {
  if (!is_exr_file(path)) {
    if (!value.layer.empty())
      refuse_picture(path, fmt::format("has no layers, and \"{:.60}\" was asked for", value.layer),
                     "\"layer\" is for OpenEXR files");
    return read_image(path, image_limits(), &info);
  }
  ExrTexture texture = read_exr_texture(path, value.layer, !is_color);
  if (texture.xyz && !names_xyz(value.space))
    refuse_picture(path, fmt::format("holds CIE XYZ pixels, and its space is said to be {:.60}", value.space),
                   "say \"space\": \"cie_xyz_d65\" where D65 is its white, or write it as R, G, B");
  if (!texture.doubt.empty() &&
      std::find(counts.doubts.begin(), counts.doubts.end(), texture.doubt) == counts.doubts.end())
    counts.doubts.push_back(texture.doubt);
  info = texture.info;
  return std::move(texture.image);
}

/// The picture as colours or numbers, scaled, with whatever is not finite replaced by 0 and counted.
Picture read_picture(const std::filesystem::path& path, const TextureValue& value, const ColorManager& colors,
                     bool is_color, PixelCounts& counts) {
  ImageFileInfo info;
  Image file = read_file(path, value, is_color, info, counts);
  Picture picture;
  picture.alpha = take_alpha(file, info);
  const int channels = is_color ? 3 : 1;
  picture.image = Image(file.width, file.height, channels);
  Image& image = picture.image;
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
    const bool seen = picture.alpha.empty() || picture.alpha[i] > 0;
    counts.not_finite += finite || !seen ? 0 : 1;
    counts.transparent += seen ? 0 : 1;
  }
  if (is_color) colors.to_working(image, value.space);
  for (float& pixel : image.pixels) pixel = pixel * value.scale + value.offset;
  counts.pixels += std::int64_t(pixels);
  return picture;
}

struct Sums {
  std::array<double, 3> sum{0, 0, 0};
  std::array<float, 3> low{3e38f, 3e38f, 3e38f}, high{-3e38f, -3e38f, -3e38f};
};

// The cloth's own value is mixed in before anything is filtered: the mean of mixtures is the mixture by the mean
// alpha, and what colour transparent pixels have is seen by nobody.
Image convert(const Picture& picture, const PixelUse& use, PixelCounts& counts, Sums& sums) {
  const Image& pixels = picture.image;
  Image values(pixels.width, pixels.height, use.channels);
  for (size_t i = 0; i < values.pixels.size() / size_t(use.channels); ++i) {
    float* to = &values.pixels[i * size_t(use.channels)];
    const float alpha = picture.alpha.empty() ? 1 : picture.alpha[i];
    if (!use.convert(&pixels.pixels[i * size_t(pixels.channels)], to) && alpha > 0) ++counts.clamped;
    for (size_t c = 0; c < size_t(use.channels); ++c) {
      if (alpha < 1) to[c] = alpha > 0 ? use.under[c] + (to[c] - use.under[c]) * alpha : use.under[c];
      sums.sum[c] += double(to[c]);
      sums.low[c] = std::min(sums.low[c], to[c]);
      sums.high[c] = std::max(sums.high[c], to[c]);
    }
  }
  return values;
}

bool has_clear_border(const Picture& picture) {
  if (picture.alpha.empty()) return false;
  const int width = picture.image.width, height = picture.image.height;
  const auto clear = [&](int x, int y) { return picture.alpha[size_t(y) * size_t(width) + size_t(x)] == 0; };
  for (int x = 0; x < width; ++x)
    if (!clear(x, 0) || !clear(x, height - 1)) return false;
  for (int y = 0; y < height; ++y)
    if (!clear(0, y) || !clear(width - 1, y)) return false;
  return true;
}

/// A motif that is there once: what is clamped around it is the cloth. Kept as what is added to that, so that its
/// smaller pictures, at whose borders it is no longer clear, do not run on in streaks.
Texture motif(Image values, const std::array<float, 3>& under, bool as_half) {
  for (size_t i = 0; i < values.pixels.size(); ++i) values.pixels[i] -= under[i % size_t(values.channels)];
  return Texture(values, TextureWrap::zero, as_half);
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
  for (size_t c = 0; c < size_t(channels); ++c) values[c] += under[c];
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
      const Picture picture = name_where_memory_ends(
          file.path, [&] { return read_picture(file.path, value, colors, use.is_color, counts); });
      const TextureWrap wrap = texture.udim ? TextureWrap::clamp : value.wrap;
      const bool once = !texture.udim && wrap == TextureWrap::clamp && has_clear_border(picture);
      if (once) texture.under = use.under;
      Image values = convert(picture, use, counts, sums);
      texture.tiles.push_back(
          {file.u, file.v,
           once ? motif(std::move(values), use.under, use.is_color) : Texture(values, wrap, use.is_color)});
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
