#pragma once
#include <functional>
#include <stdexcept>

#include "image/exr_layers.h"
#include "image/light_file.h"

namespace sateen {

bool is_exr_file(const std::filesystem::path& path);

/// One layer of an open OpenEXR file, placed in its display window, black outside. Scanline and tiled files, of
/// several levels the largest; luminance and chroma become RGB by the file's chromaticities.
class ExrPicture : public LightFile {
 public:
  ExrLayer layer;
  bool cube = false;    ///< says of itself that it is the faces of a cube
  std::string outside;  ///< what data and display window do to one another, a sentence; empty where they are the same
};

/// Which layer is read; refuses the file by refuse_picture() where there is none.
using ChooseLayer = std::function<ExrLayer(const std::vector<ExrPart>& parts)>;

/// InputError for a file without flat pixels, a damaged one, one of more than a million pixels a side.
std::unique_ptr<ExrPicture> open_exr_picture(const std::filesystem::path& path, const ChooseLayer& choose);

}  // namespace sateen
