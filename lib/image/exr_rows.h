#pragma once
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <filesystem>
#include <memory>

#include "image/exr_layers.h"

namespace sateen {

/// Rows of a layer's data window given as absolute rows of the file.
class ExrRows {
 public:
  virtual ~ExrRows() = default;
  /// `rgb` is the pixel at the window's left end of row `y`; 3 floats a pixel, `stride` floats a row. Grey is given
  /// three times; XYZ as it is.
  virtual void read(int y, int count, float* rgb, size_t stride) = 0;
};

/// Throws OpenEXR's exceptions, and std::runtime_error where the layer's channels have not the same pixels.
std::unique_ptr<ExrRows> exr_rows(const std::filesystem::path& path, Imf::MultiPartInputFile& file,
                                  const ExrLayer& layer);

}  // namespace sateen
