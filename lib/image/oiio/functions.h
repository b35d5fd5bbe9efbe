#pragma once
#include "image/file.h"

namespace sateen {

/// What the OpenImageIO module offers to image/file.cpp, which opens it when a picture file is first touched:
/// OpenImageIO brings 250 shared libraries and 0.3 s of linking, which `--help` and look checks do not owe.
struct ImageFileFunctions {
  ImageFileInfo (*read_info)(const std::filesystem::path&);
  Image (*read_pixels)(const std::filesystem::path&, const ImageLimits&, ImageFileInfo*);
  Attributes (*read_texts)(const std::filesystem::path&);
  void (*write_display)(const std::filesystem::path&, const Image&, const Attributes&, int bits, bool srgb);
};

}  // namespace sateen

/// The module's one exported name.
extern "C" __attribute__((visibility("default"))) const sateen::ImageFileFunctions* sateen_image_file_functions();
