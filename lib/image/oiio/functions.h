#pragma once
#include "image/file.h"
#include "image/texture.h"

namespace sateen {

/// A picture whose rows are made when they are wanted (image/file.h).
struct DisplayPicture {
  int width = 0, height = 0, channels = 0;
  DisplayRows rows;
};

/// What the OpenImageIO module offers to image/file.cpp and image/texture.cpp, opened when a picture file or a
/// texture is first touched: OpenImageIO brings 250 shared libraries and 0.3 s of linking, which `--help` and look
/// checks do not owe.
struct ImageFileFunctions {
  ImageFileInfo (*read_info)(const std::filesystem::path&);
  Image (*read_pixels)(const std::filesystem::path&, const ImageLimits&, ImageFileInfo*);
  Attributes (*read_texts)(const std::filesystem::path&);
  void (*write_display)(const std::filesystem::path&, const DisplayPicture&, const Attributes&, int bits, bool srgb);
  bool (*decodes)(const std::filesystem::path&);
  void* (*make_texture)(const std::vector<Image>& levels, TextureWrap, bool as_half);
  void (*look_up)(const void* texture, const TexturePoint&, float* values);
  void (*free_texture)(void* texture);
};

/// The module's, loaded on the first call. OperationError where it cannot be.
const ImageFileFunctions& image_file_functions();

/// What the module's files give to its one exported name.
namespace oiio {
void* make_texture(const std::vector<Image>& levels, TextureWrap wrap, bool as_half);
void look_up(const void* texture, const TexturePoint& point, float* values);
void free_texture(void* texture);
}  // namespace oiio

}  // namespace sateen

/// The module's one exported name.
extern "C" __attribute__((visibility("default"))) const sateen::ImageFileFunctions* sateen_image_file_functions();
