#include "image/contact_sheet.h"

#include <algorithm>
#include <cmath>

#include "image/bitmap_font.h"
#include "image/figure.h"

namespace sateen {

Image shrink_image(const Image& image, int side) {
  const int longer = std::max(image.width, image.height);
  if (longer <= side || longer == 0) return image;
  const int width = std::max(1, int((long long)(image.width) * side / longer));
  const int height = std::max(1, int((long long)(image.height) * side / longer));
  Image out(width, height, image.channels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = int((long long)(x)*image.width / width), x1 = int((long long)(x + 1) * image.width / width);
      const int y0 = int((long long)(y)*image.height / height), y1 = int((long long)(y + 1) * image.height / height);
      for (int c = 0; c < image.channels; ++c) {
        double sum = 0;
        for (int j = y0; j < y1; ++j)
          for (int i = x0; i < x1; ++i) sum += double(image.at(i, j)[c]);
        out.at(x, y)[c] = float(sum / (double(x1 - x0) * (y1 - y0)));
      }
    }
  return out;
}

Image contact_sheet(const std::vector<SheetPicture>& pictures, bool labelled) {
  int cell_width = 1, cell_height = 1;
  for (const SheetPicture& p : pictures) {
    cell_width = std::max(cell_width, p.image.width);
    cell_height = std::max(cell_height, p.image.height);
  }
  const int count = std::max(int(pictures.size()), 1), gap = 8, band = labelled ? 18 : 0;
  const double wanted = 1.5 * double(cell_height + band + gap) / double(cell_width + gap);
  const int columns = std::clamp(int(std::lround(std::sqrt(count * wanted))), 1, count);
  const int rows = (count + columns - 1) / columns;
  Figure sheet;
  sheet.width = gap + columns * (cell_width + gap);
  sheet.height = gap + rows * (cell_height + band + gap);
  sheet.background = Color(0.13f, 0.13f, 0.13f);
  for (size_t i = 0; i < pictures.size(); ++i) {
    const float x = float(gap + int(i) % columns * (cell_width + gap));
    const float y = float(gap + int(i) / columns * (cell_height + band + gap));
    const Image& image = pictures[i].image;
    sheet.shapes.push_back(FigurePicture{Vec2(x + float((cell_width - image.width) / 2), y), image, 1});
    if (labelled && shown_length(pictures[i].label) * font_advance <= cell_width + gap)
      sheet.shapes.push_back(FigureText{Vec2(x + float(cell_width) / 2, y + float(cell_height) + 6),
                                        pictures[i].label, Color(0.8f, 0.8f, 0.8f), 1, FigureText::Anchor::middle});
  }
  return draw_figure(sheet);
}

}  // namespace sateen
