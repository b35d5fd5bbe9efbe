#include "image/exr_picture.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "image/exr_rows.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
// The library's words, on one line, behind ours.
std::string because(const std::exception& error) {
  std::string text = error.what();
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32) c = ' ';
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "" : fmt::format(" ({:.300})", text);
}

std::vector<ExrPart> parts_of(const Imf::MultiPartInputFile& file) {
  std::vector<ExrPart> parts;
  for (int p = 0; p < file.parts(); ++p) {
    const Imf::Header& header = file.header(p);
    ExrPart part;
    part.deep = header.hasType() && !Imf::isImage(header.type());
    if (header.hasName()) part.name = header.name();
    const Imf::ChannelList& list = header.channels();
    for (auto c = list.begin(); c != list.end(); ++c) {
      part.channels.emplace_back(c.name());
      if (c.channel().type == Imf::UINT) part.whole_numbers.emplace_back(c.name());
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string text_attribute(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
  return attribute ? attribute->value() : std::string();
}

std::string size_text(const Imath::Box2i& window) {
  return fmt::format("{} x {}", 1ll + window.max.x - window.min.x, 1ll + window.max.y - window.min.y);
}

std::string outside_text(const Imath::Box2i& data, const Imath::Box2i& display) {
  if (data == display) return {};
  const Imath::Box2i both({std::max(data.min.x, display.min.x), std::max(data.min.y, display.min.y)},
                          {std::min(data.max.x, display.max.x), std::min(data.max.y, display.max.y)});
  if (both.isEmpty())
    return fmt::format("its {} pixels lie outside of the picture of {}: it is black", size_text(data),
                       size_text(display));
  const bool black = both != display, cut = both != data;
  return fmt::format("{} of its {} pixels lie within the picture of {}{}{}", cut ? size_text(both) : "all",
                     size_text(data), size_text(display), cut ? ": the overscan is cut off" : "",
                     !black ? ""
                     : cut  ? ", and what has no pixels is black"
                            : ": the rest is black");
}

class OpenPicture : public ExrPicture {
 public:
  OpenPicture(const fs::path& path, const ChooseLayer& choose)
      : path_(path), file_(path.c_str(), Imf::globalThreadCount()) {
    const std::vector<ExrPart> parts = parts_of(file_);
    if (std::all_of(parts.begin(), parts.end(), [](const ExrPart& p) { return p.deep; }))
      refuse_picture(path_, "holds deep pixels only, expected a part with flat ones", "flatten it first");
    layer = choose(parts);
    const Imf::Header& header = file_.header(layer.part);
    data_ = header.dataWindow();
    display_ = header.displayWindow();
    check_image_size(path, "data window", 1ll + data_.max.x - data_.min.x, 1ll + data_.max.y - data_.min.y, 3,
                     read_in_bands);
    check_image_size(path, "picture", 1ll + display_.max.x - display_.min.x, 1ll + display_.max.y - display_.min.y, 3,
                     read_in_bands);
    describe(header);
    rows_ = exr_rows(path, file_, layer);
  }

  void read_rows(int y, int count, float* rgb) override {
    std::fill_n(rgb, 3 * size_t(count) * size_t(info.width), 0.0f);
    const long long top = (long long)(display_.min.y) + y;
    const int first = int(std::max<long long>(top, data_.min.y)),
              last = int(std::min<long long>(top + count - 1, data_.max.y));
    if (first > last) return;
    const size_t width = size_t(info.width);
    float* const begin = rgb + size_t(first - top) * 3 * width;
    try {
      if (data_.min.x == display_.min.x && data_.max.x == display_.max.x)
        return rows_->read(first, last - first + 1, begin, 3 * width);
      const size_t stored = size_t(1ll + data_.max.x - data_.min.x);
      apart_.resize(3 * stored * size_t(last - first + 1));
      rows_->read(first, last - first + 1, apart_.data(), 3 * stored);
      const long long left = std::max(data_.min.x, display_.min.x), right = std::min(data_.max.x, display_.max.x);
      for (int row = first; left <= right && row <= last; ++row)
        std::copy_n(apart_.data() + 3 * (size_t(row - first) * stored + size_t(left - data_.min.x)),
                    3 * size_t(right - left + 1),
                    begin + 3 * (size_t(row - first) * width + size_t(left - display_.min.x)));
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      refuse_picture(path_, "its pixels cannot be read: the file is damaged or cut short" + because(error));
    }
  }

 private:
  void describe(const Imf::Header& header) {
    info.width = display_.max.x - display_.min.x + 1;
    info.height = display_.max.y - display_.min.y + 1;
    info.format = "openexr";
    const Imf::Channel* channel = header.channels().findChannel(layer.channels[0]);
    info.pixel_type = channel && channel->type == Imf::HALF ? "half" : "float";
    info.color_space = text_attribute(header, "oiio:ColorSpace");
    if (info.color_space.empty()) info.color_space = text_attribute(header, "colorInteropID");
    info.xyz = layer.kind == LayerKind::xyz;
    if (Imf::hasChromaticities(header)) {
      const Imf::Chromaticities& c = Imf::chromaticities(header);
      info.chromaticities = ColorManager::Chromaticities{
          {c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
    }
    const auto row = [&](long long y) { return int(std::clamp(y - display_.min.y, 0ll, (long long)(info.height))); };
    info.first_row = row(data_.min.y);
    info.end_row = row(data_.max.y + 1ll);
    outside = outside_text(data_, display_);
    cube = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
  }

  fs::path path_;
  Imf::MultiPartInputFile file_;
  Imath::Box2i data_, display_;
  std::unique_ptr<ExrRows> rows_;
  std::vector<float> apart_;
};
}  // namespace

bool is_exr_file(const fs::path& path) {
  return first_bytes(path, 4) == "\x76\x2f\x31\x01";
}

std::unique_ptr<ExrPicture> open_exr_picture(const fs::path& path, const ChooseLayer& choose) {
  try {
    return std::make_unique<OpenPicture>(path, choose);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    refuse_picture(path, "is not a picture that can be read" + because(error));
  }
}

}  // namespace sateen
