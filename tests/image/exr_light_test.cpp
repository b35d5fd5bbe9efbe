#include "image/exr_light.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfEnvmapAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/file.h"
#include "image/image.h"
#include "image/made_exr.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

namespace sateen_test {
namespace {

using namespace sateen;
namespace fs = std::filesystem;

// Channels of one colour each: the first 1, the second 2 ...
struct Channels {
  const char* part;
  std::vector<const char*> names;
};

Imf::Header header_of(const Channels& part, int width, int height) {
  Imf::Header header(width, height);
  header.setName(part.part);
  header.setType(Imf::SCANLINEIMAGE);
  for (const char* name : part.names) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  return header;
}

fs::path write_parts(const ScratchFolder& folder, const std::vector<Channels>& parts, int width = 6, int height = 3) {
  const fs::path path = folder.path / "a.exr";
  std::vector<Imf::Header> headers;
  for (const Channels& part : parts) headers.push_back(header_of(part, width, height));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), int(headers.size()));
  float value = 0;
  for (size_t p = 0; p < parts.size(); ++p) {
    Imf::OutputPart part(file, int(p));
    std::vector<std::vector<float>> values;
    Imf::FrameBuffer frame;
    for (const char* name : parts[p].names) {
      values.emplace_back(size_t(width) * size_t(height), ++value);
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, values.back().data(), headers[p].dataWindow()));
    }
    part.setFrameBuffer(frame);
    part.writePixels(height);
  }
  return path;
}

struct Read {
  LightFileInfo info;
  Image image;
  std::string error;  // message and help
  Color first() const { return {image.pixels.at(0), image.pixels.at(1), image.pixels.at(2)}; }
};
Read read(const fs::path& path, const std::string& layer = {}) {
  Read r;
  try {
    const auto file = open_light_file(path, layer);
    r.info = file->info;
    r.image = Image(r.info.width, r.info.height, 3);
    file->read_rows(0, r.info.height, r.image.pixels.data());
  } catch (const InputError& error) {
    r.error = error.diagnostics.at(0).message + "; " + error.diagnostics.at(0).help;
    r.image.pixels.assign(3, -1);
  }
  return r;
}

TEST(ExrLight, TakesTheLayerThatIsThePicture) {
  const ScratchFolder folder;
  struct Case {
    std::vector<Channels> parts;
    Color taken;
    bool guessed = false;
  };
  const std::vector<Case> all{
      {{{"", {"R", "G", "B"}}}, {1, 2, 3}},
      {{{"", {"A", "B", "G", "R", "Z"}}}, {4, 3, 2}},
      {{{"", {"AO.R", "AO.G", "AO.B", "R", "G", "B"}}}, {4, 5, 6}},
      {{{"",
         {"View Layer.AO.R", "View Layer.AO.G", "View Layer.AO.B", "View Layer.Combined.R", "View Layer.Combined.G",
          "View Layer.Combined.B"}}},
       {4, 5, 6}},
      {{{"", {"AO.R", "AO.G", "AO.B", "rgba.R", "rgba.G", "rgba.B"}}}, {4, 5, 6}},
      {{{"", {"AO.red", "AO.green", "AO.blue", "BEAUTY.red", "BEAUTY.green", "BEAUTY.blue"}}}, {4, 5, 6}},
      {{{"AO", {"AO.R", "AO.G", "AO.B"}}, {"rgba", {"rgba.R", "rgba.G", "rgba.B"}}}, {4, 5, 6}},
      {{{"AO", {"R", "G", "B"}}, {"Beauty", {"R", "G", "B"}}}, {4, 5, 6}},
      {{{"depth", {"Z"}}, {"main", {"R", "G", "B"}}}, {2, 3, 4}},
      {{{"left", {"R", "G", "B"}}, {"right", {"R", "G", "B"}}}, {1, 2, 3}, true},
      {{{"", {"sky.R", "sky.G", "sky.B", "depth.Z"}}}, {1, 2, 3}, true},
      {{{"", {"Y"}}}, {1, 1, 1}},
      {{{"", {"A", "Y"}}}, {2, 2, 2}},
      {{{"", {"luminance"}}}, {1, 1, 1}},
      {{{"", {"X", "Y", "Z"}}}, {1, 2, 3}},
      {{{"", {"N.X", "N.Y", "N.Z", "R", "G", "B"}}}, {4, 5, 6}},
  };
  for (const Case& c : all) {
    const Read r = read(write_parts(folder, c.parts));
    SCOPED_TRACE(c.parts[0].names[0]);
    EXPECT_EQ(r.error, "");
    EXPECT_EQ(r.first(), c.taken);
    EXPECT_EQ(!r.info.doubts.empty(), c.guessed);
    EXPECT_EQ(r.info.xyz, std::string(c.parts[0].names[0]) == "X");
  }
}

TEST(ExrLight, RefusesToGuessAmongLayersListsThemAndTakesTheOneAskedFor) {
  const ScratchFolder folder;
  const fs::path path =
      write_parts(folder, {{"",
                            {"RenderLayer.AO.R", "RenderLayer.AO.G", "RenderLayer.AO.B", "RenderLayer.Emit.R",
                             "RenderLayer.Emit.G", "RenderLayer.Emit.B", "RenderLayer.Depth.Z"}}});
  EXPECT_NE(read(path).error.find("does not say which of its layers is the light: RenderLayer.AO (B, G, R), "
                                  "RenderLayer.Depth (Z), RenderLayer.Emit (B, G, R)"),
            std::string::npos)
      << read(path).error;
  EXPECT_NE(read(path).error.find("--env-layer"), std::string::npos);
  EXPECT_EQ(read(path, "RenderLayer.Emit").first(), Color(4, 5, 6));
  EXPECT_EQ(read(path, "emit").first(), Color(4, 5, 6));
  EXPECT_EQ(read(path, "renderlayer.depth.z").first(), Color(7, 7, 7));
  EXPECT_NE(read(path, "mist").error.find("has no layer \"mist\"; its layers are RenderLayer.AO"), std::string::npos);
  // Vectors are no light unless asked for.
  EXPECT_NE(read(write_parts(folder, {{"", {"N.X", "N.Y", "N.Z"}}})).error, "");
  for (const char* alone : {"Z", "A", "depth", "View Layer.Depth.Z", "Mist.alpha", "mask", "matte.01", "AO", "ao.Y",
                            "View Layer.IndexOB.X", "CryptoObject00.r", "objectID"}) {
    const fs::path matte = write_parts(folder, {{"", {alone}}});
    EXPECT_NE(read(matte).error.find("does not say which of its layers is the light"), std::string::npos) << alone;
    EXPECT_EQ(read(matte, alone).first(), Color(1, 1, 1));
  }
  // Cryptomatte's names of objects look like colours.
  const fs::path crypt = write_parts(folder, {{"", {"CryptoObject00.r", "CryptoObject00.g", "CryptoObject00.b"}}});
  EXPECT_NE(read(crypt).error, "");
  EXPECT_EQ(read(crypt, "cryptoobject00").first(), Color(1, 2, 3));
  // So do integers that stand alone.
  const fs::path ids = folder.path / "ids.exr";
  write_made_exr(ids, {{{}, {{"thing", [](int, int) { return 7.0f; }, MadeType::uint}}}});
  EXPECT_NE(read(ids).error, "");
  EXPECT_EQ(read(ids, "thing").first(), Color(7, 7, 7));
  // A name that says nothing is a guess.
  EXPECT_NE(read(write_parts(folder, {{"", {"stuff"}}})).info.doubts.at(0).find("only channel stuff"),
            std::string::npos);
  const fs::path hdr = folder.path / "a.hdr";
  write_bytes(hdr, "#?RADIANCE\n\n-Y 1 +X 1\nabcd");
  EXPECT_NE(read(hdr, "AO").error.find("has no layers"), std::string::npos);
}

TEST(ExrLight, PlacesTilesWindowsAndPartsInTheirPicture) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.exr";
  const int windows[][4] = {{3, 2, 5, 4}, {-4, -3, 30, 20}, {-2, 5, 8, 12}, {0, 0, 16, 12}, {100, 100, 2, 2}};
  for (const auto& w : windows) {
    write_windowed_exr(path, 16, 12, w[0], w[1], w[2], w[3]);
    const auto file = open_light_file(path);
    EXPECT_EQ(file->info.notes.empty(), w[2] == 16) << w[0];
    Image image(16, 12, 3);
    for (int y = 0; y < 12; y += 5) file->read_rows(y, std::min(5, 12 - y), image.at(0, y));
    for (int y = 0; y < 12; ++y)
      for (int x = 0; x < 16; ++x) {
        const bool inside = x >= w[0] && x < w[0] + w[2] && y >= w[1] && y < w[1] + w[3];
        ASSERT_EQ(image.at(x, y)[0], inside ? float(x) : 0.0f) << w[0] << " " << x << " " << y;
        ASSERT_EQ(image.at(x, y)[1], inside ? float(y) : 0.0f);
      }
  }
  // What is cut off is not black.
  const auto told = [&](const MadeWindow& data, const MadeWindow& display) {
    write_made_exr(path, {counted({"R", "G", "B"})}, data, display);
    return open_light_file(path)->info.notes.at(0);
  };
  EXPECT_EQ(told({-4, -2, 16, 8}, {0, 0, 8, 4}),
            "8 x 4 of its 16 x 8 pixels lie within the picture of 8 x 4: the overscan is cut off");
  EXPECT_EQ(told({1, 1, 4, 2}, {0, 0, 8, 4}),
            "all of its 4 x 2 pixels lie within the picture of 8 x 4: the rest is "
            "black");
  EXPECT_EQ(told({4, 2, 8, 4}, {0, 0, 8, 4}),
            "4 x 2 of its 8 x 4 pixels lie within the picture of 8 x 4: the "
            "overscan is cut off, and what has no pixels is black");
  EXPECT_EQ(told({20, 2, 8, 4}, {0, 0, 8, 4}), "its 8 x 4 pixels lie outside of the picture of 8 x 4: it is black");
  for (const bool mipmapped : {false, true}) {
    write_tiled_exr(path, 50, 37, mipmapped);
    const Image image = read(path).image;
    for (int y = 0; y < 37; ++y)
      for (int x = 0; x < 50; ++x) ASSERT_EQ(image.at(x, y)[0] + 1000 * image.at(x, y)[1], float(x + 1000 * y));
  }
  write_multipart_exr(path, 8, 6);
  EXPECT_EQ(read(path).image.at(5, 4)[1], 4);
  write_deep_exr(path, 8, 6);
  EXPECT_EQ(read(path).error.rfind("holds deep pixels only", 0), 0u) << read(path).error;
  write_windowed_exr(path, 64, 48, 0, 0, 64, 48);
  const std::string bytes = read_bytes(path);
  for (size_t length = 5; length < bytes.size(); length += bytes.size() / 40) {
    write_bytes(path, bytes.substr(0, length));
    EXPECT_NE(read(path).error, "") << length;
    if (length < 200) {
      EXPECT_NE(read(path).error.find("cut short"), std::string::npos) << length << read(path).error;
    }
  }
}

// Chroma is stored at half the size: colours that change slowly come back as they were.
TEST(ExrLight, MakesRgbOfLuminanceAndChromaByTheFilesOwnPrimaries) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.exr";
  constexpr int width = 64, height = 32;
  const auto value = [](int x, int y) {
    return std::array{1 + std::sin(float(x) * 0.1f) / 2, 0.5f + float(y) / 64, 2 - float(x) / 64};
  };
  for (const bool wide : {false, true}) {
    Imf::Header header(width, height);
    if (wide)
      Imf::addChromaticities(
          header, Imf::Chromaticities({0.713f, 0.293f}, {0.165f, 0.83f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}));
    {
      Imf::RgbaOutputFile file(path.c_str(), header, Imf::WRITE_YC);
      std::vector<Imf::Rgba> pixels;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) pixels.emplace_back(value(x, y)[0], value(x, y)[1], value(x, y)[2]);
      file.setFrameBuffer(pixels.data(), 1, width);
      file.writePixels(height);
    }
    const Read r = read(path);
    ASSERT_EQ(r.error, "");
    EXPECT_EQ(r.info.chromaticities.has_value(), wide);
    for (int y = 2; y < height - 2; ++y)
      for (int x = 2; x < width - 2; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(r.image.at(x, y)[c], value(x, y)[size_t(c)], 0.02f) << x << " " << y << " " << c;
  }
}

// The faces hold the direction of each pixel as OpenEXR defines it: the lat-long map must hold its own directions.
TEST(ExrLight, UnfoldsACube) {
  const ScratchFolder folder;
  const fs::path path = folder.path / "a.exr";
  constexpr int side = 32;
  const Imath::Box2i window({0, 0}, {side - 1, 6 * side - 1});
  const auto write = [&](int height) {
    Imf::Header header(side, height);
    Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    Image faces(side, 6 * side, 3);
    for (int f = 0; f < 6; ++f)
      for (int v = 0; v < side; ++v)
        for (int u = 0; u < side; ++u) {
          const auto face = Imf::CubeMapFace(f);
          const Imath::V2f place{float(u), float(v)}, at = Imf::CubeMap::pixelPosition(face, window, place);
          const Imath::V3f d = Imf::CubeMap::direction(face, window, place).normalized();
          std::copy_n(&d.x, 3, faces.at(int(std::lround(at.x)), int(std::lround(at.y))));
        }
    Imf::OutputFile file(path.c_str(), header);
    Imf::FrameBuffer frame;
    const char* names[] = {"R", "G", "B"};
    for (size_t c = 0; c < 3; ++c)
      frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, faces.pixels.data() + c, header.dataWindow(),
                                              3 * sizeof(float), 3 * sizeof(float) * side));
    file.setFrameBuffer(frame);
    file.writePixels(height);
  };
  write(6 * side);
  const Read r = read(path);
  ASSERT_EQ(r.error, "");
  ASSERT_EQ(r.image.width, 4 * side);
  ASSERT_EQ(r.image.height, 2 * side);
  for (int y = 0; y < r.image.height; ++y)
    for (int x = 0; x < r.image.width; ++x) {
      const double longitude = std::numbers::pi * (1 - 2 * (x + 0.5) / r.image.width);
      const double latitude = std::numbers::pi * (0.5 - (y + 0.5) / r.image.height);
      const double d[3] = {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                           std::cos(longitude) * std::cos(latitude)};
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(double(r.image.at(x, y)[c]), d[c], 0.01) << x << " " << y;
    }
  write(5 * side);
  EXPECT_NE(read(path).error.find("expected six times as high as wide"), std::string::npos) << read(path).error;
}

}  // namespace
}  // namespace sateen_test
