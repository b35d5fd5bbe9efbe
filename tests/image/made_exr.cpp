#include "image/made_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace sateen_test {

namespace {
Imath::Box2i box(const MadeWindow& w) {
  return {{w.left, w.top}, {w.left + w.width - 1, w.top + w.height - 1}};
}

template <class Number>
std::vector<char> values_of(const MadeChannel& channel, const Imath::Box2i& data) {
  std::vector<char> bytes;
  for (int y = data.min.y; y <= data.max.y; y += channel.sampling)
    for (int x = data.min.x; x <= data.max.x; x += channel.sampling) {
      const auto number = Number(channel.value(x, y));
      bytes.insert(bytes.end(), reinterpret_cast<const char*>(&number), reinterpret_cast<const char*>(&number + 1));
    }
  return bytes;
}
}  // namespace

MadePart counted(const std::vector<std::string>& names, const std::string& part) {
  MadePart made{part, {}};
  for (const std::string& name : names) {
    const auto value = float(made.channels.size() + 1);
    made.channels.push_back({name, [=](int, int) { return value; }});
  }
  return made;
}

void write_made_exr(const std::filesystem::path& path, const std::vector<MadePart>& parts, const MadeWindow& data,
                    const MadeWindow& display, const std::map<std::string, std::string>& texts) {
  constexpr Imf::PixelType types[] = {Imf::UINT, Imf::HALF, Imf::FLOAT};
  const Imath::Box2i window = box(data);
  std::vector<Imf::Header> headers;
  for (const MadePart& part : parts) {
    Imf::Header header(box(display), window);
    header.compression() = Imf::NO_COMPRESSION;
    header.setName(part.name);
    header.setType(Imf::SCANLINEIMAGE);
    for (const MadeChannel& c : part.channels)
      header.channels().insert(c.name, Imf::Channel(types[size_t(c.type)], c.sampling, c.sampling));
    for (const auto& [name, text] : texts) header.insert(name, Imf::StringAttribute(text));
    headers.push_back(header);
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
  for (size_t p = 0; p < parts.size(); ++p) {
    std::vector<std::vector<char>> bytes;
    Imf::FrameBuffer frame;
    for (const MadeChannel& c : parts[p].channels) {
      const Imf::PixelType type = types[size_t(c.type)];
      bytes.push_back(type == Imf::UINT   ? values_of<unsigned>(c, window)
                      : type == Imf::HALF ? values_of<half>(c, window)
                                          : values_of<float>(c, window));
      const size_t size = type == Imf::HALF ? 2 : 4;
      const size_t columns = size_t((data.width + c.sampling - 1) / c.sampling);
      frame.insert(c.name, Imf::Slice::Make(type, bytes.back().data(), window.min, data.width, data.height, size,
                                            columns * size, c.sampling, c.sampling));
    }
    Imf::OutputPart part(file, int(p));
    part.setFrameBuffer(frame);
    part.writePixels(data.height);
  }
}

}  // namespace sateen_test
