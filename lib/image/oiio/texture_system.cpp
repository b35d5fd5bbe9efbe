#include "image/oiio/functions.h"  // before OpenImageIO, which declares Imath's types without defining them

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/texture.h>
#include <fmt/format.h>

#include <atomic>
#include <cstring>

#include "base/error.h"

namespace sateen::oiio {

namespace {

constexpr int tile_side = 64;
constexpr int most_anisotropic = 16;  // probes along a long footprint

/// One size of a picture in the bytes that its tiles are cut from.
struct Level {
  int width, height;
  std::vector<unsigned char> bytes;
};

struct MadeTexture {
  OIIO::ustring name;
  OIIO::TypeDesc type;
  int channels;
  std::vector<Level> levels;
  OIIO::TextureOpt options;
  OIIO::TextureSystem::TextureHandle* handle = nullptr;

  OIIO::ImageSpec spec(int level) const {
    const Level& one = levels[size_t(level)];
    OIIO::ImageSpec spec(one.width, one.height, channels, type);
    spec.tile_width = spec.tile_height = tile_side;
    spec.tile_depth = 1;
    return spec;
  }
};

/// Left to the end of the program: its threads may outlive everything else.
OIIO::TextureSystem& textures() {
  static OIIO::TextureSystem* const system = [] {
    OIIO::TextureSystem* own = OIIO::TextureSystem::create(false);
    own->attribute("max_memory_MB", 512.0f);
    return own;
  }();
  return *system;
}

/// Serves the tiles of a MadeTexture as if they came from a file. The texture is handed over as an address in the
/// configuration with which the texture system opens every "file" that was added to it.
class MemoryInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "memory"; }
  bool open(const std::string&, OIIO::ImageSpec&) override { return false; }
  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    const OIIO::ParamValue* address = config.find_attribute("sateen:texture", OIIO::TypeDesc::PTR);
    if (!address) return false;
    std::memcpy(&made_, address->data(), sizeof made_);
    spec = m_spec = made_->spec(0);
    return true;
  }
  bool close() override { return true; }
  int current_miplevel() const override { return level_; }
  bool seek_subimage(int subimage, int level) override {
    if (!made_ || subimage != 0 || level < 0 || size_t(level) >= made_->levels.size()) return false;
    if (level != level_) m_spec = made_->spec(level_ = level);
    return true;
  }
  bool read_native_scanline(int, int, int, int, void*) override { return false; }
  bool read_native_tile(int, int level, int x, int y, int, void* data) override {
    const Level& from = made_->levels[size_t(level)];
    const size_t pixel = size_t(made_->channels) * made_->type.size();
    auto* to = static_cast<unsigned char*>(data);
    std::memset(to, 0, size_t(tile_side) * tile_side * pixel);
    const int columns = std::min(tile_side, from.width - x), rows = std::min(tile_side, from.height - y);
    for (int row = 0; row < rows; ++row)
      std::memcpy(to + size_t(row) * tile_side * pixel,
                  &from.bytes[(size_t(y + row) * size_t(from.width) + size_t(x)) * pixel], size_t(columns) * pixel);
    return true;
  }

 private:
  const MadeTexture* made_ = nullptr;
  int level_ = 0;
};

OIIO::ImageInput* create_input() {
  return new MemoryInput;
}

Level level_of(const Image& image, OIIO::TypeDesc type) {
  Level level{image.width, image.height, std::vector<unsigned char>(image.pixels.size() * type.size())};
  OIIO::convert_types(OIIO::TypeDesc::FLOAT, image.pixels.data(), type, level.bytes.data(), int(image.pixels.size()));
  return level;
}

OIIO::TextureOpt options_for(TextureWrap wrap) {
  OIIO::TextureOpt options;
  options.swrap = options.twrap = wrap == TextureWrap::clamp    ? OIIO::TextureOpt::WrapClamp
                                  : wrap == TextureWrap::mirror ? OIIO::TextureOpt::WrapMirror
                                  : wrap == TextureWrap::zero   ? OIIO::TextureOpt::WrapBlack
                                                                : OIIO::TextureOpt::WrapPeriodic;
  options.mipmode = OIIO::TextureOpt::MipModeAniso;
  // Bicubic leaves the range of the pixels, and blurs.
  options.interpmode = OIIO::TextureOpt::InterpBilinear;
  options.anisotropic = most_anisotropic;
  return options;
}

}  // namespace

void* make_texture(const std::vector<Image>& levels, TextureWrap wrap, bool as_half) {
  // No two textures of a process may share a name: the cache would show one for the other.
  static std::atomic<std::uint64_t> made_so_far{0};
  auto made = std::make_unique<MadeTexture>();
  made->name = OIIO::ustring(fmt::format("sateen texture {}", ++made_so_far));
  made->type = as_half ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
  made->channels = levels.front().channels;
  made->options = options_for(wrap);
  for (const Image& level : levels) made->levels.push_back(level_of(level, made->type));
  OIIO::ImageSpec config;
  const MadeTexture* address = made.get();
  config.attribute("sateen:texture", OIIO::TypeDesc::PTR, &address);
  OIIO::ImageCache* cache = textures().imagecache();
  if (cache->add_file(made->name, create_input, &config)) made->handle = textures().get_texture_handle(made->name);
  if (!made->handle || !textures().good(made->handle))
    throw OperationError("the texture system did not take a picture: " + textures().geterror());
  return made.release();
}

void look_up(const void* texture, const TexturePoint& p, float* values) {
  const auto& made = *static_cast<const MadeTexture*>(texture);
  OIIO::TextureOpt options = made.options;
  // Rows run downwards.
  const bool found = textures().texture(made.handle, nullptr, options, p.uv.x, 1 - p.uv.y, p.dx.x, -p.dx.y, p.dy.x,
                                        -p.dy.y, made.channels, values);
  if (!found) throw OperationError("a texture look-up failed: " + textures().geterror());
}

void free_texture(void* texture) {
  const std::unique_ptr<MadeTexture> made(static_cast<MadeTexture*>(texture));
  textures().invalidate(made->name, true);
}

}  // namespace sateen::oiio
