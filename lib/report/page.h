#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"
#include "report/plot.h"
#include "report/table.h"

namespace sateen {

/// Bytes as a `data:` address of that kind ("image/png").
std::string data_uri(const std::string& kind, const std::string& bytes);

/// A picture file (png, jpg, svg) as a `data:` address. InputError where it is missing or of another kind.
std::string picture_uri(const std::filesystem::path& path);
/// Display code values in [0, 1], of 3 or more channels, as PNG.
std::string picture_uri(const Image& image);

/// A picture that a slider can show: `uri` is its address, a data_uri() for a page that stands alone.
struct SliderPicture {
  std::string label, uri;
};

/// One HTML page that stands alone: style and script are inside, nothing is fetched. Text is given plain; the page
/// escapes it. Readable on light and dark screens, and printed.
class Page {
 public:
  Page(std::string title, std::string lead);

  void section(const std::string& title);
  void paragraph(const std::string& text);
  void note(const std::string& text);  ///< smaller, quieter
  void table(const Table& table);
  void plot(const PlotSheet& sheet, const std::string& caption);  ///< as PNG, in the page
  void picture(const std::string& caption, const std::string& uri);
  /// Two of the pictures under a divider that is dragged, with buttons to choose which two. All of one size; `width`
  /// is the size on the page. At least two pictures, else InputError.
  void slider(const std::string& caption, const std::vector<SliderPicture>& pictures, int width);

  std::string html() const;

 private:
  std::string title_, body_;
  int sliders_ = 0;
};

}  // namespace sateen
