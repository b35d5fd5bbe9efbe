#pragma once
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "image/file.h"
#include "image/image.h"
#include "math/vector.h"

namespace sateen {

/// A drawing: shapes in the order in which they cover each other. Places in pixels from the top left, colours as code
/// values in [0, 1]. Drawn as pixels and written as SVG from the same list.
struct FigureLine {
  std::vector<Vec2> points;
  Color color{0, 0, 0};
  float width = 1;
  bool closed = false;
};
struct FigureBox {
  Vec2 from, to;
  Color color{0, 0, 0};
};
struct FigureText {
  enum class Anchor { left, middle, right };
  Vec2 at;  ///< top of the letters
  std::string text;
  Color color{0, 0, 0};
  int dots = 1;  ///< pixels a dot of the font: letters are 7 dots high
  Anchor anchor = Anchor::left;
};
struct FigurePicture {
  Vec2 at;
  Image image;    ///< 3 channels, or 4: alpha 0 is left out
  int scale = 1;  ///< pixels a pixel
};
using FigureShape = std::variant<FigureLine, FigureBox, FigureText, FigurePicture>;

struct Figure {
  int width = 0, height = 0;
  Color background{1, 1, 1};
  std::vector<FigureShape> shapes;
};

Image draw_figure(const Figure& figure);  ///< 3 channels, smooth lines
std::string figure_svg(const Figure& figure);

/// By extension: svg, or a display format of write_display_image.
void write_figure(const std::filesystem::path& path, const Figure& figure, const Attributes& attributes = {});

}  // namespace sateen
