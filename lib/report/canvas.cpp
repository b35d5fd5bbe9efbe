#include "report/canvas.h"

#include <array>
#include <cmath>
#include <numbers>

namespace sateen {

namespace {
void set_font(cairo_t* to, double size, bool bold) {
  cairo_select_font_face(to, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(to, size);
}
}  // namespace

Ink series_ink(int place) {
  static constexpr std::array<Ink, 8> all{{{0.10, 0.38, 0.71},
                                           {0.90, 0.49, 0.07},
                                           {0.12, 0.58, 0.40},
                                           {0.80, 0.20, 0.22},
                                           {0.49, 0.31, 0.68},
                                           {0.10, 0.66, 0.76},
                                           {0.55, 0.38, 0.20},
                                           {0.42, 0.44, 0.48}}};
  return all[size_t(place < 0 ? 0 : place) % all.size()];
}

void set_ink(cairo_t* to, const Ink& ink, double alpha) {
  cairo_set_source_rgba(to, ink.red, ink.green, ink.blue, alpha);
}

double text_width(cairo_t* to, const std::string& text, double size, bool bold) {
  set_font(to, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(to, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_text(cairo_t* to, double x, double y, const std::string& text, double size, Anchor anchor, const Ink& ink,
               bool bold) {
  const double width = text_width(to, text, size, bold);
  set_ink(to, ink);
  cairo_move_to(to, x - (anchor == Anchor::left ? 0 : anchor == Anchor::middle ? width / 2 : width), y);
  cairo_show_text(to, text.c_str());
}

void draw_upright_text(cairo_t* to, double x, double y, const std::string& text, double size, const Ink& ink) {
  cairo_save(to);
  cairo_translate(to, x, y);
  cairo_rotate(to, -std::numbers::pi / 2);
  draw_text(to, 0, 0, text, size, Anchor::middle, ink);
  cairo_restore(to);
}

void draw_segment(cairo_t* to, double x0, double y0, double x1, double y1, double width, const Ink& ink) {
  set_ink(to, ink);
  cairo_set_line_width(to, width);
  cairo_move_to(to, x0, y0);
  cairo_line_to(to, x1, y1);
  cairo_stroke(to);
}

void draw_marker(cairo_t* to, double x, double y, int place, double radius) {
  cairo_new_path(to);
  // Corners on a circle by the marker's number of them; none: the circle itself.
  static constexpr struct {
    int corners;
    double turn;
  } shapes[] = {{0, 0}, {4, 0.25}, {3, 0.5}, {4, 0}, {3, 0}, {5, 0.5}, {6, 0}, {8, 0}};
  const auto& shape = shapes[size_t(place < 0 ? 0 : place) % std::size(shapes)];
  if (shape.corners == 0) {
    cairo_arc(to, x, y, radius, 0, 2 * std::numbers::pi);
  } else {
    for (int i = 0; i < shape.corners; ++i) {
      const double angle = 2 * std::numbers::pi * ((i + (shape.turn == 0.25 ? 0.5 : 0.0)) / shape.corners) +
                           (shape.turn == 0.5    ? -std::numbers::pi / 2
                            : shape.corners == 3 ? std::numbers::pi / 2
                                                 : 0);
      cairo_line_to(to, x + 1.22 * radius * std::cos(angle), y + 1.22 * radius * std::sin(angle));
    }
  }
  cairo_close_path(to);
  set_ink(to, series_ink(place));
  cairo_fill_preserve(to);
  cairo_set_source_rgb(to, 1, 1, 1);
  cairo_set_line_width(to, 0.9);
  cairo_stroke(to);
}

}  // namespace sateen
