#include "image/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/files.h"
#include "image/bitmap_font.h"

namespace sateen {

namespace {
void mix(Image& image, int x, int y, const Color& color, float share) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || share <= 0) return;
  float* p = image.at(x, y);
  for (int c = 0; c < 3; ++c) p[c] += (color[c] - p[c]) * share;
}

float distance_to_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a, ap = p - a;
  const float squared = ab.dot(ab), t = squared > 0 ? std::clamp(ap.dot(ab) / squared, 0.0f, 1.0f) : 0;
  return (ap - ab * t).length();
}

// The cover of a whole line is collected before it is mixed in, so that joints are not drawn twice.
void draw(Image& image, const FigureLine& line) {
  if (line.points.empty()) return;
  const float reach = line.width / 2 + 1;
  Vec2 low = line.points[0], high = low;
  for (const Vec2& p : line.points) {
    low = Vec2(std::min(low.x, p.x), std::min(low.y, p.y));
    high = Vec2(std::max(high.x, p.x), std::max(high.y, p.y));
  }
  const int x0 = std::max(int(std::floor(low.x - reach)), 0), y0 = std::max(int(std::floor(low.y - reach)), 0);
  const int x1 = std::min(int(std::ceil(high.x + reach)), image.width);
  const int y1 = std::min(int(std::ceil(high.y + reach)), image.height);
  if (x1 <= x0 || y1 <= y0) return;
  std::vector<float> cover(size_t(x1 - x0) * size_t(y1 - y0));
  const size_t count = line.points.size();
  for (size_t i = 0; i + 1 < count + (line.closed ? 1 : 0) || (count == 1 && i == 0); ++i) {
    const Vec2 a = line.points[i], b = line.points[(i + 1) % count];
    for (int y = std::max(y0, int(std::min(a.y, b.y) - reach)); y < std::min(y1, int(std::max(a.y, b.y) + reach) + 1);
         ++y)
      for (int x = std::max(x0, int(std::min(a.x, b.x) - reach));
           x < std::min(x1, int(std::max(a.x, b.x) + reach) + 1); ++x) {
        const float d = distance_to_segment(Vec2(float(x) + 0.5f, float(y) + 0.5f), a, b);
        float& c = cover[size_t(y - y0) * size_t(x1 - x0) + size_t(x - x0)];
        c = std::max(c, std::clamp(line.width / 2 + 0.5f - d, 0.0f, std::min(line.width, 1.0f)));
      }
  }
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      mix(image, x, y, line.color, cover[size_t(y - y0) * size_t(x1 - x0) + size_t(x - x0)]);
}

void draw(Image& image, const FigureBox& box) {
  for (int y = std::max(int(std::lround(box.from.y)), 0); y < std::min(int(std::lround(box.to.y)), image.height); ++y)
    for (int x = std::max(int(std::lround(box.from.x)), 0); x < std::min(int(std::lround(box.to.x)), image.width);
         ++x)
      mix(image, x, y, box.color, 1);
}

float left_of(const FigureText& text, float width) {
  return text.at.x - (text.anchor == FigureText::Anchor::left     ? 0
                      : text.anchor == FigureText::Anchor::middle ? width / 2
                                                                  : width);
}

void draw(Image& image, const FigureText& text) {
  const int dots = std::max(text.dots, 1);
  int x = int(std::lround(left_of(text, float((shown_length(text.text) * font_advance - 1) * dots))));
  const int y = int(std::lround(text.at.y));
  for (const char c : text.text) {
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;
    for (int j = 0; j < font_height * dots; ++j)
      for (int i = 0; i < font_width * dots; ++i)
        if (font_ink(c, i / dots, j / dots)) mix(image, x + i, y + j, text.color, 1);
    x += font_advance * dots;
  }
}

void draw(Image& image, const FigurePicture& picture) {
  const Image& from = picture.image;
  const int x0 = int(std::lround(picture.at.x)), y0 = int(std::lround(picture.at.y));
  for (int y = 0; y < from.height * picture.scale; ++y)
    for (int x = 0; x < from.width * picture.scale; ++x) {
      const float* p = from.at(x / picture.scale, y / picture.scale);
      mix(image, x0 + x, y0 + y, Color(p[0], p[1], p[2]), from.channels > 3 ? std::clamp(p[3], 0.0f, 1.0f) : 1);
    }
}

std::string hex(const Color& c) {
  const auto code = [](float v) { return int(std::lround(std::clamp(v, 0.0f, 1.0f) * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", code(c.x), code(c.y), code(c.z));
}

std::string svg(const FigureLine& line) {
  std::string points;
  for (const Vec2& p : line.points) points += fmt::format("{:.2f},{:.2f} ", p.x, p.y);
  return fmt::format(
      "<{} points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>\n",
      line.closed ? "polygon" : "polyline", points, hex(line.color), line.width);
}

std::string svg(const FigureBox& box) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n", box.from.x,
                     box.from.y, box.to.x - box.from.x, box.to.y - box.from.y, hex(box.color));
}

std::string svg(const FigureText& text) {
  std::string escaped;
  for (const char c : text.text) {
    if (static_cast<unsigned char>(c) < 0x20) continue;
    escaped += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  const char* anchor = text.anchor == FigureText::Anchor::left     ? "start"
                       : text.anchor == FigureText::Anchor::middle ? "middle"
                                                                   : "end";
  return fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"{}\" "
      "fill=\"{}\">{}</text>\n",
      text.at.x, text.at.y + 7 * float(text.dots), 5 + 5 * text.dots, anchor, hex(text.color), escaped);
}

// Rows as runs of equal colour, one path a colour: plain SVG without an embedded file.
std::string svg(const FigurePicture& picture) {
  const Image& from = picture.image;
  std::map<std::string, std::string> runs;
  for (int y = 0; y < from.height; ++y)
    for (int x = 0, end = 0; x < from.width; x = end) {
      const auto color_at = [&](int i) {
        const float* p = from.at(i, y);
        return from.channels > 3 && p[3] <= 0 ? std::string() : hex(Color(p[0], p[1], p[2]));
      };
      const std::string color = color_at(x);
      for (end = x + 1; end < from.width && color_at(end) == color;) ++end;
      if (!color.empty()) runs[color] += fmt::format("M{} {}.5h{}", x, y, end - x);
    }
  std::string text =
      fmt::format("<g transform=\"translate({:.2f} {:.2f}) scale({})\" shape-rendering=\"crispEdges\">\n",
                  picture.at.x, picture.at.y, picture.scale);
  for (const auto& [color, path] : runs) text += fmt::format("<path stroke=\"{}\" d=\"{}\"/>\n", color, path);
  return text + "</g>\n";
}
}  // namespace

Image draw_figure(const Figure& figure) {
  Image image(figure.width, figure.height, 3);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = figure.background[int(i % 3)];
  for (const FigureShape& shape : figure.shapes) std::visit([&](const auto& s) { draw(image, s); }, shape);
  return image;
}

std::string figure_svg(const Figure& figure) {
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"{2}\"/>\n",
      figure.width, figure.height, hex(figure.background));
  for (const FigureShape& shape : figure.shapes) text += std::visit([](const auto& s) { return svg(s); }, shape);
  return text + "</svg>\n";
}

void write_figure(const std::filesystem::path& path, const Figure& figure, const Attributes& attributes) {
  if (path.extension() == ".svg")
    write_text_whole(path, figure_svg(figure));
  else
    write_display_image(path, draw_figure(figure), attributes);
}

}  // namespace sateen
