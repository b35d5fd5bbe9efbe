#include <utility>

#include "image/file.h"

namespace sateen {

Image apply_orientation(Image image, int orientation) {
  if (orientation < 2 || orientation > 8) return image;
  // Where the stored picture's first row and first column are to be shown: 2 and 3 have the first column at the
  // right, 3 and 4 the first row at the bottom; from 5 on rows are shown as columns.
  const bool turned = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 6;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  Image shown(turned ? image.height : image.width, turned ? image.width : image.height, image.channels);
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      int column = from_right ? shown.width - 1 - x : x, row = from_below ? shown.height - 1 - y : y;
      if (turned) std::swap(column, row);
      std::copy_n(image.at(column, row), size_t(image.channels), shown.at(x, y));
    }
  return shown;
}

}  // namespace sateen
