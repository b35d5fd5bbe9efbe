#include "image/file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/file_identity.h"
#include "base/memory.h"
#include "image/exr_header.h"
#include "image/oiio/functions.h"
#include "image/picture_file.h"
#include "image/plain_exr.h"
#include "image/png_chunks.h"
#include "image/radiance.h"

namespace sateen {

namespace {

namespace fs = std::filesystem;

// Beside the installed program or one of the build tree; for another program that uses the library, where that was
// installed or built.
std::vector<fs::path> module_places() {
  std::vector<fs::path> places;
  std::error_code code;
  if (const fs::path program = fs::read_symlink("/proc/self/exe", code); !code)
    places.push_back(program.parent_path().parent_path() / "lib" / "sateen" / SATEEN_OIIO_MODULE);
  for (const char* folder : {SATEEN_OIIO_INSTALL_FOLDER, SATEEN_OIIO_MODULE_FOLDER})
    places.push_back(fs::path(folder) / SATEEN_OIIO_MODULE);
  return places;
}

}  // namespace

const ImageFileFunctions& image_file_functions() {
  static const ImageFileFunctions* const loaded = [] {
    std::string tried;
    for (const fs::path& place : module_places()) {
      if (void* module = dlopen(place.c_str(), RTLD_LAZY | RTLD_LOCAL))
        if (void* entry = dlsym(module, "sateen_image_file_functions"))
          return reinterpret_cast<decltype(&sateen_image_file_functions)>(entry)();
      tried += fmt::format("\n  {}", dlerror());
    }
    throw OperationError("the part that reads and writes pictures could not be loaded:" + tried);
  }();
  return *loaded;
}

namespace {

/// A Radiance picture as any other: three channels, top row first.
Image read_radiance(const fs::path& path, const ImageLimits& limits, ImageFileInfo* info) {
  const std::unique_ptr<LightFile> file = open_radiance(path, limits);
  check_image_size(path, "data window", file->info.width, file->info.height, 3, limits);
  if (file->info.xyz)
    refuse_picture(path, "holds CIE XYZ pixels, expected red, green and blue", "convert it to 32-bit_rle_rgbe");
  Image image(file->info.width, file->info.height, 3);
  file->read_rows(0, image.height, image.pixels.data());
  if (!info) return image;
  *info = {image.width, image.height, 3, {"R", "G", "B"}, file->info.format, file->info.pixel_type, {}, {}};
  info->chromaticities = file->info.chromaticities;
  return image;
}

}  // namespace

ImageFileInfo read_image_info(const fs::path& path) {
  check_picture_file(path);
  check_exr_header(path);
  return image_file_functions().read_info(path);
}

Image read_image(const fs::path& path, const ImageLimits& limits, ImageFileInfo* info) {
  note_file_read(path);
  check_picture_file(path);
  return name_where_memory_ends(path, [&] {
    check_exr_header(path);
    if (std::optional<Image> plain = read_plain_exr(path, limits, info)) return std::move(*plain);
    if (is_radiance(path)) return read_radiance(path, limits, info);
    check_png_chunks(path);
    return image_file_functions().read_pixels(path, limits, info);
  });
}

void load_display_writer() {
  image_file_functions();
}

bool image_decodes(const fs::path& path) {
  check_picture_file(path);
  try {
    check_png_chunks(path);
  } catch (const InputError&) {
    return false;
  }
  return image_file_functions().decodes(path);
}

Attributes read_attributes(const fs::path& path) {
  check_picture_file(path);
  return image_file_functions().read_texts(path);
}

namespace {
Image rows_of(const Image& image, int y0, int y1) {
  Image rows(image.width, y1 - y0, image.channels);
  std::copy(image.at(0, y0), image.at(0, y0) + rows.pixels.size(), rows.pixels.begin());
  return rows;
}
}  // namespace

void write_display_image(const fs::path& path, const Image& image, const Attributes& attributes, int bits,
                         bool srgb) {
  write_display_image(
      path, image.width, image.height, image.channels, [&](int y0, int y1) { return rows_of(image, y0, y1); },
      attributes, bits, srgb);
}

void write_display_image(const fs::path& path, int width, int height, int channels, const DisplayRows& rows,
                         const Attributes& attributes, int bits, bool srgb) {
  image_file_functions().write_display(path, {width, height, channels, rows}, attributes, bits, srgb);
}

HalfRange write_exr(const fs::path& path, const std::vector<ImageLayer>& layers, const Attributes& attributes,
                    const std::optional<ColorManager::Chromaticities>& chromaticities) {
  const auto fail = [&](const std::string& what) {
    throw OperationError(fmt::format("{}: not written: {}", path.string(), what));
  };
  if (layers.empty()) fail("there are no layers");
  const Image& first = layers[0].image;
  for (const ImageLayer& layer : layers)
    if (layer.image.width != first.width || layer.image.height != first.height)
      fail(fmt::format("layer \"{}\" is {} x {}, expected {} x {}", layer.name, layer.image.width, layer.image.height,
                       first.width, first.height));
  const auto rows = [&](int y0, int y1) {
    std::vector<ImageLayer> band;
    for (const ImageLayer& layer : layers)
      band.push_back({layer.name, layer.channels, layer.half, rows_of(layer.image, y0, y1)});
    return band;
  };
  return write_exr(path, first.width, first.height, rows, attributes, chromaticities);
}

}  // namespace sateen
