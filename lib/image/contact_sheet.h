#pragma once
#include <string>
#include <vector>

#include "image/image.h"

namespace sateen {

/// One picture of a sheet: code values, 3 or 4 channels (over the sheet's ground), and what stands under it.
struct SheetPicture {
  Image image;
  std::string label;
};

/// Mean over boxes of pixels, so that the longer side is at most `side`; never larger than the image.
Image shrink_image(const Image& image, int side);

/// Pictures in rows on dark grey, in a shape near 3 to 2; labels are left out where `labelled` is false or where they
/// do not fit. Pictures may differ in size.
Image contact_sheet(const std::vector<SheetPicture>& pictures, bool labelled);

}  // namespace sateen
