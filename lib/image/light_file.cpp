#include "image/light_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "base/error.h"
#include "base/file_identity.h"
#include "image/exr_header.h"
#include "image/exr_light.h"
#include "image/exr_picture.h"
#include "image/file.h"
#include "image/oiio/functions.h"
#include "image/picture_file.h"
#include "image/png_chunks.h"
#include "image/radiance.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
/// What the picture library reads, held whole.
class WholeLight : public LightFile {
 public:
  WholeLight(const fs::path& path, const ImageLimits& limits) {
    ImageFileInfo file;
    image_ = image_file_functions().read_pixels(path, limits, &file);
    info.width = image_.width;
    info.height = image_.height;
    info.format = file.format;
    info.pixel_type = file.pixel_type;
    info.color_space = file.color_space;
    info.chromaticities = file.chromaticities;
    info.whole = true;
  }

  void read_rows(int y, int count, float* rgb) override {
    const size_t channels = size_t(image_.channels);
    for (int row = y; row < y + count; ++row)
      for (int x = 0; x < image_.width; ++x, rgb += 3) {
        const float* p = image_.at(x, row);
        for (size_t c = 0; c < 3; ++c) rgb[c] = p[channels < 3 ? 0 : c];
      }
  }

 private:
  Image image_;
};
}  // namespace

void refuse_picture(const fs::path& path, const std::string& message, const std::string& help) {
  Diagnostic d;
  d.file = path.string();
  d.message = message;
  d.help = help;
  throw InputError(InputError::Kind::unreadable, {d});
}

std::string first_bytes(const fs::path& path, size_t count) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return {};  // a pipe would be waited for
  std::ifstream in(path, std::ios::binary);
  std::string bytes(count, '\0');
  in.read(bytes.data(), std::streamsize(count));
  bytes.resize(size_t(in.gcount()));
  return bytes;
}

std::unique_ptr<LightFile> open_light_file(const fs::path& path, const std::string& layer,
                                           const ImageLimits& limits) {
  note_file_read(path);
  check_picture_file(path);
  if (is_exr_file(path)) {
    check_exr_header(path);
    return open_exr_light(path, layer, limits);
  }
  if (!layer.empty())
    refuse_picture(path, fmt::format("has no layers, and \"{:.60}\" was asked for", layer),
                   "--env-layer is for OpenEXR files");
  if (is_radiance(path)) return open_radiance(path, limits);
  check_png_chunks(path);
  return std::make_unique<WholeLight>(path, limits);
}

}  // namespace sateen
