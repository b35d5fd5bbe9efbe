#pragma once
#include <vector>

#include "image/file.h"

namespace sateen {

/// The alpha of every pixel, 0 to 1 (what is not finite counts as 0), and the colours beside it freed of it where the
/// file holds them multiplied. Empty where there is none or the picture is opaque everywhere: its pixels stay as they
/// are.
std::vector<float> take_alpha(Image& image, const ImageFileInfo& info);

}  // namespace sateen
