#include "report/page.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/files.h"
#include "report/page_style.h"

namespace sateen {

namespace {
std::string base64(const std::string& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t left = std::min<size_t>(bytes.size() - i, 3);
    unsigned bits = 0;
    for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) out += k <= left ? digits[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return out;
}
}  // namespace

std::string data_uri(const std::string& kind, const std::string& bytes) {
  return "data:" + kind + ";base64," + base64(bytes);
}

std::string picture_uri(const std::filesystem::path& path) {
  constexpr std::uint64_t largest = 64u << 20;
  const std::string extension = path.extension().string();
  const std::string kind = extension == ".png"   ? "image/png"
                           : extension == ".svg" ? "image/svg+xml"
                           : extension == ".jpg" ? "image/jpeg"
                                                 : "";
  if (kind.empty())
    throw InputError(fmt::format("{}: a page holds pictures of kind png, jpg and svg", path.string()));
  return data_uri(kind, read_text_file(path, largest));
}

Page::Page(std::string title, std::string lead) : title_(std::move(title)) {
  body_ = fmt::format("<h1>{}</h1>\n<p class=\"lead\">{}</p>\n", html_text(title_), html_text(lead));
}

void Page::section(const std::string& title) {
  body_ += fmt::format("<h2>{}</h2>\n", html_text(title));
}
void Page::paragraph(const std::string& text) {
  body_ += fmt::format("<p>{}</p>\n", html_text(text));
}
void Page::note(const std::string& text) {
  body_ += fmt::format("<p class=\"note\">{}</p>\n", html_text(text));
}
void Page::table(const Table& table) {
  body_ += table_html(table);
}

void Page::plot(const PlotSheet& sheet, const std::string& caption) {
  // At the page's width; the SVG with its outlined letters is twice as large, and lies beside most pages.
  picture(caption, data_uri("image/png", plot_png(sheet, 1)));
}

void Page::picture(const std::string& caption, const std::string& uri) {
  body_ += fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n", html_text(uri),
                       html_text(caption), html_text(caption));
}

void Page::slider(const std::string& caption, const std::vector<SliderPicture>& pictures, int width) {
  if (pictures.size() < 2)
    throw InputError(fmt::format("a slider compares pictures and has {}, expected 2 or more", pictures.size()));
  std::string sources;
  for (const SliderPicture& picture : pictures)
    sources += fmt::format("<img alt=\"{}\" src=\"{}\">\n", html_text(picture.label), html_text(picture.uri));
  const auto choice = [&](size_t chosen) {
    std::string options;
    for (size_t i = 0; i < pictures.size(); ++i)
      options += fmt::format("<option{}>{}</option>", i == chosen ? " selected" : "", html_text(pictures[i].label));
    return "<select>" + options + "</select>";
  };
  // Pictures are held once, in the template; the script puts two of them on the stage.
  body_ += fmt::format(
      "<figure class=\"compare\" style=\"max-width:{0}px\"><template>\n{1}</template>\n"
      "<div class=\"slider\"><img class=\"under\" src=\"{2}\" alt=\"{3}\"><img class=\"over\" src=\"{4}\" "
      "alt=\"{5}\">"
      "<div class=\"rule\"><div class=\"knob\">&harr;</div></div>"
      "<span class=\"tag l\">{5}</span><span class=\"tag r\">{3}</span></div>\n"
      "<div class=\"choices\"><label>left{6}</label><label>right{7}</label>"
      "<label>divider <input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" "
      "id=\"divider{8}\"></label></div>"
      "<figcaption>{9}</figcaption></figure>\n",
      width, sources, "data:,", html_text(pictures.back().label), "data:,", html_text(pictures.front().label),
      choice(0), choice(pictures.size() - 1), ++sliders_, html_text(caption));
}

std::string Page::html() const {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<main>\n{}</main>\n<script>{}</script>\n</body>\n</html>\n",
      html_text(title_), page_style, body_, sliders_ > 0 ? page_script : "");
}

}  // namespace sateen
