#include "image/file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "base/error.h"
#include "image/oiio/functions.h"
#include "image/plain_exr.h"
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
  return image_file_functions().read_info(path);
}

Image read_image(const fs::path& path, const ImageLimits& limits, ImageFileInfo* info) {
  if (std::optional<Image> plain = read_plain_exr(path, limits, info)) return std::move(*plain);
  if (is_radiance(path)) return read_radiance(path, limits, info);
  return image_file_functions().read_pixels(path, limits, info);
}

Attributes read_attributes(const fs::path& path) {
  return image_file_functions().read_texts(path);
}

void write_display_image(const fs::path& path, const Image& image, const Attributes& attributes, int bits,
                         bool srgb) {
  image_file_functions().write_display(path, image, attributes, bits, srgb);
}

}  // namespace sateen
