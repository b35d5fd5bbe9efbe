#pragma once
#include <cairo/cairo.h>

#include <string>

namespace sateen {

/// Colours of series, told apart by people who do not see red or green as well (blue, orange, green, red, purple,
/// cyan, brown, grey).
struct Ink {
  double red = 0, green = 0, blue = 0;
};
Ink series_ink(int place);
inline constexpr Ink text_ink{0.13, 0.14, 0.16}, quiet_ink{0.40, 0.42, 0.45}, grid_ink{0.89, 0.90, 0.91},
    frame_ink{0.62, 0.64, 0.66};

enum class Anchor { left, middle, right };

/// Few words to draw with on a cairo context.
void set_ink(cairo_t* to, const Ink& ink, double alpha = 1);
double text_width(cairo_t* to, const std::string& text, double size, bool bold = false);
/// `y` is the base line.
void draw_text(cairo_t* to, double x, double y, const std::string& text, double size, Anchor anchor, const Ink& ink,
               bool bold = false);
/// Read from bottom to top, centred at x, y.
void draw_upright_text(cairo_t* to, double x, double y, const std::string& text, double size, const Ink& ink);
void draw_segment(cairo_t* to, double x0, double y0, double x1, double y1, double width, const Ink& ink);
/// Circle, square, triangle, diamond and so on by place, so that series differ in more than colour.
void draw_marker(cairo_t* to, double x, double y, int place, double radius);

}  // namespace sateen
