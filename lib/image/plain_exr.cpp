#include "image/plain_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <cctype>

namespace sateen {

namespace fs = std::filesystem;

namespace {

// Colour spaces by name are the module's to understand.
bool names_a_space(const Imf::Header& header) {
  for (auto a = header.begin(); a != header.end(); ++a) {
    std::string name = a.name();
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    if (name.find("colorspace") != std::string::npos) return true;
  }
  return false;
}

/// The channels in the order of their meaning; empty where the file is not plain.
std::vector<std::string> plain_channels(const Imf::Header& header) {
  std::vector<std::string> found;
  const Imf::ChannelList& list = header.channels();
  for (auto c = list.begin(); c != list.end(); ++c) {
    const Imf::Channel& channel = c.channel();
    if (channel.xSampling != 1 || channel.ySampling != 1) return {};
    if (channel.type == Imf::UINT || channel.type != list.begin().channel().type) return {};
    found.emplace_back(c.name());
  }
  for (const std::vector<std::string>& known :
       {std::vector<std::string>{"R", "G", "B"}, std::vector<std::string>{"R", "G", "B", "A"},
        std::vector<std::string>{"Y"}})
    if (std::is_permutation(known.begin(), known.end(), found.begin(), found.end())) return known;
  return {};
}

}  // namespace

std::optional<Image> read_plain_exr(const fs::path& path, const ImageLimits& limits, ImageFileInfo* info) {
  std::error_code code;
  if (!fs::is_regular_file(path, code)) return std::nullopt;
  bool tiled = false, deep = false, parts = false;
  if (!Imf::isOpenExrFile(path.c_str(), tiled, deep, parts) || deep || parts) return std::nullopt;
  try {
    Imf::InputFile file(path.c_str(), 0);
    const Imf::Header& header = file.header();
    const Imath::Box2i data = header.dataWindow();
    const std::vector<std::string> names = plain_channels(header);
    if (names.empty() || names_a_space(header) || data != header.displayWindow() || !file.isComplete())
      return std::nullopt;
    const long long width = 1ll + data.max.x - data.min.x, height = 1ll + data.max.y - data.min.y;
    const long long pixel = (long long)(names.size() * sizeof(float));
    if (width > limits.side || height > limits.side || width * height > limits.decoded_bytes / pixel)
      return std::nullopt;

    Image image(int(width), int(height), int(names.size()));
    Imf::FrameBuffer frame;
    for (size_t c = 0; c < names.size(); ++c)
      frame.insert(names[c],
                   Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, data, size_t(pixel), size_t(width * pixel)));
    file.setFrameBuffer(frame);
    file.readPixels(data.min.y, data.max.y);
    if (!info) return image;
    *info = {};
    info->width = image.width;
    info->height = image.height;
    info->channels = image.channels;
    info->channel_names = names;
    info->format = "openexr";
    info->alpha_channel = names.size() == 4 ? 3 : -1;
    info->colors_times_alpha = names.size() == 4;
    info->pixel_type = header.channels().begin().channel().type == Imf::HALF ? "half" : "float";
    if (Imf::hasChromaticities(header)) {
      const Imf::Chromaticities& c = Imf::chromaticities(header);
      info->chromaticities = ColorManager::Chromaticities{
          {c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
    }
    return image;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace sateen
