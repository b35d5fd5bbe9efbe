#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "image/exr_light.h"
#include "image/image.h"
#include "image/made_exr.h"
#include "image/scratch_folder.h"

// Luminance and chroma of OpenEXR: RY = (R - Y) / Y and BY = (B - Y) / Y.

namespace sateen_test {
namespace {

using namespace sateen;

constexpr float weights[] = {0.2126f, 0.7152f, 0.0722f};  // of Rec.709, which stands where a file says nothing

std::array<float, 3> rgb_of(float y, float ry, float by) {
  const float r = (1 + ry) * y, b = (1 + by) * y;
  return {r, (y - weights[0] * r - weights[2] * b) / weights[1], b};
}

Image read(const std::filesystem::path& path) {
  const auto file = open_exr_light(path);
  Image image(file->info.width, file->info.height, 3);
  // Band by band, as maps are read.
  for (int y = 0; y < image.height; y += 3) file->read_rows(y, std::min(3, image.height - y), image.at(0, y));
  return image;
}

MadePart part(float y, float ry, float by, MadeType type, int sampling, const std::string& name = {}) {
  const auto constant = [](float v) { return [=](int, int) { return v; }; };
  return {{},
          {{name + "BY", constant(by), type, sampling},
           {name + "RY", constant(ry), type, sampling},
           {name + "Y", constant(y), type}}};
}

TEST(ExrChroma, IsReadInFloatsOfEverySamplingAndBeyondHalf) {
  const ScratchFolder folder;
  const auto path = folder.path / "a.exr";
  struct Case {
    float y;
    MadeType type;
    int sampling;
  };
  for (const Case& c : {Case{1e6f, MadeType::single, 2},
                        {1e6f, MadeType::single, 1},
                        {0.5f, MadeType::half, 1},
                        {0.5f, MadeType::single, 4},
                        {0.5f, MadeType::half, 2},
                        {60000, MadeType::half, 2},
                        {0, MadeType::single, 2}}) {
    SCOPED_TRACE(testing::Message() << c.y << " " << c.sampling << " " << int(c.type));
    write_made_exr(path, {part(c.y, 0.75f, -0.5f, c.type, c.sampling)});
    const Image image = read(path);
    const std::array<float, 3> expected = rgb_of(c.y, 0.75f, -0.5f);
    for (size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_NEAR(image.pixels[i], expected[i % 3], 2e-3f * std::max(c.y, 1e-3f)) << i;
  }
}

TEST(ExrChroma, IsInterpolatedBetweenItsPixelsAndHeldAtTheEnds) {
  const ScratchFolder folder;
  const auto path = folder.path / "a.exr";
  const MadeWindow window{-4, -2, 12, 8};
  const auto ry = [](int x, int y) { return 0.01f * float(x) + 0.02f * float(y); };
  write_made_exr(path,
                 {{{},
                   {{"BY", [](int, int) { return 0.0f; }, MadeType::single, 2},
                    {"RY", ry, MadeType::single, 2},
                    {"Y", [](int, int) { return 2.0f; }}}}},
                 window, window);
  const Image image = read(path);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 12; ++x)
      ASSERT_NEAR(image.at(x, y)[0], 2 * (1 + ry(std::min(x, 10) - 4, std::min(y, 6) - 2)), 1e-5f) << x << " " << y;
}

TEST(ExrChroma, OfALayerIsTakenWhereItAloneHasColours) {
  const ScratchFolder folder;
  const auto path = folder.path / "a.exr";
  write_made_exr(path, {part(0.5f, 0.1f, 0.2f, MadeType::half, 2, "diffuse.")});
  EXPECT_NEAR(read(path).pixels[0], 0.55f, 1e-3f);
  EXPECT_EQ(open_exr_light(path)->info.doubts.size(), 1u);
  // In a later part too.
  write_made_exr(path,
                 {counted({"depth.Z"}, "depth"), {"diffuse", part(0.5f, 0.1f, 0.2f, MadeType::half, 2).channels}});
  EXPECT_NEAR(read(path).pixels[2], 0.6f, 1e-3f);
}

TEST(ExrChroma, OfTwoSamplingsIsRefusedByName) {
  const ScratchFolder folder;
  const auto path = folder.path / "a.exr";
  MadePart made = part(0.5f, 0.1f, 0.2f, MadeType::half, 2);
  made.channels[0].sampling = 1;
  write_made_exr(path, {made});
  try {
    open_exr_light(path);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(error.diagnostics[0].message.find("its chroma of 2 x 2 and 1 x 1"), std::string::npos)
        << error.diagnostics[0].message;
  }
}

}  // namespace
}  // namespace sateen_test
