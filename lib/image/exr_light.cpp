#include "image/exr_light.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "image/exr_cube.h"
#include "image/exr_layers.h"

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

[[noreturn]] void damaged(const fs::path& path, const std::exception& error) {
  refuse_picture(path, "its pixels cannot be read: the file is damaged or cut short" + because(error));
}

std::vector<ExrPart> parts_of(const Imf::MultiPartInputFile& file) {
  std::vector<ExrPart> parts;
  for (int p = 0; p < file.parts(); ++p) {
    const Imf::Header& header = file.header(p);
    ExrPart part;
    part.deep = header.hasType() && !Imf::isImage(header.type());
    if (header.hasName()) part.name = header.name();
    const Imf::ChannelList& list = header.channels();
    for (auto c = list.begin(); c != list.end(); ++c) part.channels.emplace_back(c.name());
    parts.push_back(std::move(part));
  }
  return parts;
}

std::string text_attribute(const Imf::Header& header, const char* name) {
  const auto* attribute = header.findTypedAttribute<Imf::StringAttribute>(name);
  return attribute ? attribute->value() : std::string();
}

/// Rows of a data window given as absolute rows of the file.
class DataRows {
 public:
  virtual ~DataRows() = default;
  /// `rgb` is the pixel at the window's left end of row `y`; 3 floats a pixel, `stride` floats a row.
  virtual void read(int y, int count, float* rgb, size_t stride) = 0;
};

class PlainRows : public DataRows {
 public:
  PlainRows(Imf::MultiPartInputFile& file, const ExrLayer& layer) : part_(file, layer.part), layer_(layer) {
    const Imf::ChannelList& list = part_.header().channels();
    for (const std::string& name : layer.channels) {
      const Imf::Channel* channel = name.empty() ? nullptr : list.findChannel(name);
      if (channel && (channel->xSampling != 1 || channel->ySampling != 1))
        throw std::runtime_error(fmt::format("channel {:.60} has fewer pixels than the picture", name));
    }
  }

  void read(int y, int count, float* rgb, size_t stride) override {
    const Imath::Box2i data = part_.header().dataWindow();
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < 3; ++c)
      if (!layer_.channels[c].empty())
        frame.insert(layer_.channels[c],
                     Imf::Slice::Make(Imf::FLOAT, rgb + c, {data.min.x, y}, int64_t(data.max.x) - data.min.x + 1,
                                      count, 3 * sizeof(float), stride * sizeof(float)));
    part_.setFrameBuffer(frame);
    part_.readPixels(y, y + count - 1);
    if (layer_.kind != LayerKind::grey) return;
    for (int row = 0; row < count; ++row)
      for (int x = 0; x <= data.max.x - data.min.x; ++x) {
        float* p = rgb + size_t(row) * stride + 3 * size_t(x);
        p[1] = p[2] = p[0];
      }
  }

 private:
  Imf::InputPart part_;
  ExrLayer layer_;
};

/// OpenEXR's own reading of luminance and chroma: filters the chroma up and makes RGB, in half floats.
class ChromaRows : public DataRows {
 public:
  ChromaRows(const fs::path& path, const std::string& prefix)
      : file_(path.c_str(), prefix, Imf::globalThreadCount()) {}

  void read(int y, int count, float* rgb, size_t stride) override {
    const Imath::Box2i data = file_.dataWindow();
    const size_t width = size_t(int64_t(data.max.x) - data.min.x + 1);
    row_.resize(width);
    for (int row = 0; row < count; ++row) {
      // One row of storage, under whatever row is asked for.
      file_.setFrameBuffer(row_.data() - data.min.x, 1, 0);
      file_.readPixels(y + row);
      for (size_t x = 0; x < width; ++x) {
        float* p = rgb + size_t(row) * stride + 3 * x;
        p[0] = row_[x].r;
        p[1] = row_[x].g;
        p[2] = row_[x].b;
      }
    }
  }

 private:
  Imf::RgbaInputFile file_;
  std::vector<Imf::Rgba> row_;
};

class ExrLight : public LightFile {
 public:
  ExrLight(const fs::path& path, const ImageLimits& limits, const std::string& wanted)
      : path_(path), file_(path.c_str(), Imf::globalThreadCount()) {
    const std::vector<ExrPart> parts = parts_of(file_);
    std::vector<ExrLayer> layers = exr_layers(parts);
    const ExrLayer layer = settle(parts, wanted, layers);
    const Imf::Header& header = file_.header(layer.part);
    data_ = header.dataWindow();
    display_ = header.displayWindow();
    ImageLimits sides = limits;
    sides.decoded_bytes = 1ll << 62;
    check_image_size(path, "data window", 1ll + data_.max.x - data_.min.x, 1ll + data_.max.y - data_.min.y, 3, sides);
    check_image_size(path, "picture", 1ll + display_.max.x - display_.min.x, 1ll + display_.max.y - display_.min.y, 3,
                     sides);
    describe(header, layer);
    if (layer.kind == LayerKind::chroma) {
      if (layer.part != 0)
        refuse_picture(
            path, fmt::format("its layer {} is luminance and chroma in a later part, which is not read", layer.name),
            "write it as R, G, B");
      const size_t dot = layer.channels[0].rfind('.');
      rows_ = std::make_unique<ChromaRows>(path, dot == std::string::npos ? "" : layer.channels[0].substr(0, dot));
    } else {
      rows_ = std::make_unique<PlainRows>(file_, layer);
    }
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
      damaged(path_, error);
    }
  }

  bool cube = false;

 private:
  ExrLayer settle(const std::vector<ExrPart>& parts, const std::string& wanted, std::vector<ExrLayer>& layers) const {
    const int chosen = choose_layer(parts, wanted, layers);
    if (chosen >= 0) return layers[size_t(chosen)];
    if (std::all_of(parts.begin(), parts.end(), [](const ExrPart& p) { return p.deep; }))
      refuse_picture(path_, "holds deep pixels only, expected a part with flat ones", "flatten it first");
    const std::string list = layers_text(parts);
    if (!wanted.empty())
      refuse_picture(path_, fmt::format("has no layer \"{:.60}\"", wanted), "its layers are " + list);
    refuse_picture(path_, "does not say which of its layers is the light: " + list,
                   "choose one with --env-layer NAME; R, G, B without a name, Combined, rgba or beauty go first");
  }

  void describe(const Imf::Header& header, const ExrLayer& layer) {
    info.width = display_.max.x - display_.min.x + 1;
    info.height = display_.max.y - display_.min.y + 1;
    info.format = "openexr";
    const Imf::Channel* channel = header.channels().findChannel(layer.channels[0]);
    info.pixel_type = !channel ? "half" : channel->type == Imf::HALF ? "half" : "float";
    info.color_space = text_attribute(header, "oiio:ColorSpace");
    info.xyz = layer.kind == LayerKind::xyz;
    if (Imf::hasChromaticities(header)) {
      const Imf::Chromaticities& c = Imf::chromaticities(header);
      info.chromaticities = ColorManager::Chromaticities{
          {c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
    }
    if (layer.guessed)
      info.doubts.push_back(fmt::format("its layer {:.80} is taken as the light, {}; --env-layer NAME takes another",
                                        layer.name,
                                        layer.plain ? "the first with colours" : "the only one with colours"));
    else if (!layer.name.empty())
      info.notes.push_back(fmt::format("its layer {:.80} is the light", layer.name));
    if (layer.kind == LayerKind::grey) info.notes.push_back("it has no colours and is taken as grey light");
    if (layer.kind == LayerKind::chroma)
      info.notes.push_back("its luminance and chroma were made RGB, in half floats");
    if (data_ != display_)
      info.notes.push_back(fmt::format("its pixels cover {} x {} of the picture's {} x {}: the rest is black",
                                       1ll + data_.max.x - data_.min.x, 1ll + data_.max.y - data_.min.y, info.width,
                                       info.height));
    cube = Imf::hasEnvmap(header) && Imf::envmap(header) == Imf::ENVMAP_CUBE;
  }

  fs::path path_;
  Imf::MultiPartInputFile file_;
  Imath::Box2i data_, display_;
  std::unique_ptr<DataRows> rows_;
  std::vector<float> apart_;
};
}  // namespace

bool is_exr_file(const fs::path& path) {
  return first_bytes(path, 4) == "\x76\x2f\x31\x01";
}

std::unique_ptr<LightFile> open_exr_light(const fs::path& path, const std::string& layer, const ImageLimits& limits) {
  try {
    auto light = std::make_unique<ExrLight>(path, limits, layer);
    if (light->cube) return unfold_cube(path, std::move(light), limits);
    return light;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    refuse_picture(path, "is not a picture that can be read" + because(error));
  }
}

}  // namespace sateen
