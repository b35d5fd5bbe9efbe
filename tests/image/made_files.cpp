#include "image/made_files.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineOutputFile.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <fstream>
#include <iterator>
#include <vector>

namespace sateen_test {

namespace fs = std::filesystem;

namespace {
Imf::Header header_of(int width, int height) {
  Imf::Header header(width, height);
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  return header;
}

// Pixels of a window, and the frame buffer that shows them to OpenEXR.
struct Pixels {
  std::vector<float> values;
  Imf::FrameBuffer frame;

  Pixels(int left, int top, int width, int height) : values(size_t(3 * width * height)) {
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        float* p = values.data() + 3 * (y * width + x);
        p[0] = float(x + left);
        p[1] = float(y + top);
        p[2] = 2;
      }
    const char* names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c)
      frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, values.data() + c, Imath::V2i(left, top), width, height,
                                              3 * sizeof(float), 3 * sizeof(float) * size_t(width)));
  }
};

struct DeepPixels {
  std::vector<unsigned> counts;
  std::vector<float> sample{7};
  std::vector<float*> pointers;
  Imf::DeepFrameBuffer frame;

  DeepPixels(int width, int height)
      : counts(size_t(width * height), 1u), pointers(size_t(width * height), sample.data()) {
    frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(unsigned),
                                            sizeof(unsigned) * size_t(width)));
    for (const char* name : {"R", "G", "B"})
      frame.insert(name, Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), sizeof(float*),
                                        sizeof(float*) * size_t(width), sizeof(float)));
  }
};
}  // namespace

void write_windowed_exr(const fs::path& path, int width, int height, int left, int top, int data_width,
                        int data_height) {
  Imf::Header header = header_of(width, height);
  header.dataWindow() = Imath::Box2i({left, top}, {left + data_width - 1, top + data_height - 1});
  Pixels pixels(left, top, data_width, data_height);
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(pixels.frame);
  file.writePixels(data_height);
}

void write_tiled_exr(const fs::path& path, int width, int height, bool mipmapped) {
  Imf::Header header = header_of(width, height);
  header.setTileDescription(Imf::TileDescription(16, 16, mipmapped ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
  Pixels pixels(0, 0, width, height);
  Imf::TiledOutputFile file(path.c_str(), header);
  for (int level = 0; level < file.numLevels(); ++level) {
    file.setFrameBuffer(pixels.frame);
    file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
  }
}

void write_deep_exr(const fs::path& path, int width, int height) {
  Imf::Header header = header_of(width, height);
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  DeepPixels pixels(width, height);
  Imf::DeepScanLineOutputFile file(path.c_str(), header);
  file.setFrameBuffer(pixels.frame);
  file.writePixels(height);
}

void write_multipart_exr(const fs::path& path, int width, int height) {
  Imf::Header headers[2] = {header_of(width, height), header_of(width, height)};
  headers[0].setType(Imf::DEEPSCANLINE);
  headers[0].compression() = Imf::ZIPS_COMPRESSION;
  headers[0].setName("deep");
  headers[1].setType(Imf::SCANLINEIMAGE);
  headers[1].setName("flat");
  DeepPixels deep(width, height);
  Pixels flat(0, 0, width, height);
  Imf::MultiPartOutputFile file(path.c_str(), headers, 2);
  Imf::DeepScanLineOutputPart first(file, 0);
  first.setFrameBuffer(deep.frame);
  first.writePixels(height);
  Imf::OutputPart second(file, 1);
  second.setFrameBuffer(flat.frame);
  second.writePixels(height);
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

std::string read_bytes(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace sateen_test
