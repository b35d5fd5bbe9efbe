#include "scene/environment_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/scratch_folder.h"
#include "maps.h"
#include "scene/environment_inspect.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using sateen_test::make_map;
using sateen_test::ScratchFolder;

void write_map(const fs::path& path, const Image& image, const ColorManager::Chromaticities& chromaticities) {
  ImageLayer layer;
  layer.channels = image.channels == 1 ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  layer.image = image;
  write_exr(path, {layer}, {}, chromaticities);
}

struct EnvironmentVariable {
  const char* name;
  EnvironmentVariable(const char* n, const std::string& value) : name(n) { setenv(n, value.c_str(), 1); }
  ~EnvironmentVariable() { unsetenv(name); }
};

TEST(ReadEnvironment, FindsNamesOnItsPathAndSuggestsTheNearest) {
  const ScratchFolder folder;
  const EnvironmentVariable home("SATEEN_HOME", (folder.path / "home").string());
  const EnvironmentVariable path("SATEEN_PATH",
                                 "/none:" + (folder.path / "a").string() + "::" + (folder.path / "b").string());
  fs::create_directories(folder.path / "a");
  fs::create_directories(folder.path / "b/envmaps");
  fs::create_directories(folder.path / "home/envmaps");
  const Image map = make_map(4, 2, [](int, int) { return Color(1, 1, 1); });
  write_map(folder.path / "a/harbour.exr", map, rec709_chromaticities);
  write_map(folder.path / "b/envmaps/quarry.exr", map, rec709_chromaticities);
  write_map(folder.path / "home/envmaps/quarry.exr", map, rec709_chromaticities);
  write_map(folder.path / "home/envmaps/v1.2.exr", map, rec709_chromaticities);
  EXPECT_EQ(find_environment("harbour"), folder.path / "a/harbour.exr");
  EXPECT_EQ(find_environment("harbour.exr"), folder.path / "a/harbour.exr");
  EXPECT_EQ(find_environment("quarry"), folder.path / "b/envmaps/quarry.exr");
  EXPECT_EQ(find_environment("v1.2"), folder.path / "home/envmaps/v1.2.exr");
  EXPECT_EQ(find_environment((folder.path / "a/harbour.exr").string()), folder.path / "a/harbour.exr");
  const auto names = environment_names();
  for (const char* name : {"harbour", "quarry", "v1.2"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  for (const char* wrong : {"harbor", "/none/harbor.exr", ""}) {
    try {
      find_environment(wrong);
      ADD_FAILURE() << wrong;
    } catch (const InputError& error) {
      EXPECT_EQ(error.kind, InputError::Kind::unreadable);
      if (*wrong) {
        EXPECT_NE(std::string(error.what()).find("did you mean harbour?"), std::string::npos) << error.what();
      }
    }
  }
}

TEST(ReadEnvironment, TakesTheColourSpaceFromFlagThenChromaticitiesThenTheUsual) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const Image red = make_map(4, 2, [](int, int) { return Color(1, 0, 0); });
  const auto read = [&](const fs::path& path, const std::string& flag, std::string& space) {
    EnvironmentFileOptions options;
    options.color_space = flag;
    return read_environment(path.string(), colors, options, &space).texels[0].radiance;
  };
  std::string space;
  const fs::path exr = folder.path / "a.exr", png = folder.path / "a.png";
  write_map(exr, red, ap1_chromaticities);
  EXPECT_NEAR(read(exr, "", space).x, 1, 1e-5f);
  EXPECT_NEAR(read(exr, "lin_rec709", space).x, 0.613097f, 1e-5f);
  EXPECT_EQ(space, "lin_rec709 (as asked)");
  EXPECT_THROW(read(exr, "lin_rec708", space), InputError);
  Image grey(4, 2, 3);
  for (float& v : grey.pixels) v = 128 / 255.0f;
  write_display_image(png, grey);
  EXPECT_NEAR(read(png, "", space).y, 0.2158f, 0.003f);  // sRGB's curve
  EXPECT_NEAR(read(png, "raw", space).y, 0.502f, 0.005f);
}

TEST(ReadEnvironment, RepairsBeforeItConvertsAndCountsWhatConversionMakesNegative) {
  const ScratchFolder folder;
  const ColorManager colors("built-in", "lin_rec709");
  const fs::path path = folder.path / "a.exr";
  Image map = make_map(8, 4, [](int, int) { return Color(0.5f, 0.5f, 0.5f); });
  map.at(2, 1)[0] = -4;                                     // in the file
  std::copy_n(Color(0, 1, 0).getValue(), 3, map.at(5, 3));  // AP1 green: outside Rec.709
  write_map(path, map, ap1_chromaticities);
  const Environment e = read_environment(path.string(), colors);
  EXPECT_EQ(e.repairs.negative.count, 1);
  EXPECT_EQ(e.repairs.negative.first_x, 2);
  EXPECT_EQ(e.repairs.out_of_gamut.count, 2);  // without its red, the mended pixel is outside too
  for (const auto& t : e.texels) EXPECT_GE(std::min({t.radiance.x, t.radiance.y, t.radiance.z}), 0);
}

TEST(ReadEnvironment, ReadsAGreyMap) {
  const ScratchFolder folder;
  Image grey(4, 2, 1);
  for (float& v : grey.pixels) v = 0.5f;
  write_map(folder.path / "a.exr", grey, rec709_chromaticities);
  const Environment e = read_environment((folder.path / "a.exr").string(), ColorManager("built-in"));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(e.texels[0].radiance[i], 0.5f, 1e-5f);
}

TEST(InspectEnvironment, MeasuresRangeAndRegions) {
  const Environment e = build_environment(make_map(64, 32, [](int x, int y) {
    if (y == 16 && (x == 63 || x == 0)) return Color(800, 800, 800);  // across the seam: one region
    if (y == 8 && x == 16) return Color(300, 300, 300);
    return Color(0.5f, 0.5f, 0.5f);
  }));
  const EnvironmentReport r = inspect_environment(e);
  EXPECT_NEAR(r.largest, 800, 0.1f);
  EXPECT_NEAR(r.smallest, 0.5f, 1e-5f);
  EXPECT_NEAR(r.stops, std::log2(1600.0f), 1e-4f);
  ASSERT_EQ(r.regions.size(), 2u);
  EXPECT_NEAR(r.regions[0].azimuth_deg, 0, 1e-3f);
  EXPECT_NEAR(r.regions[0].elevation_deg, -2.8125f, 0.01f);
  EXPECT_NEAR(r.regions[1].azimuth_deg, -92.8125f, 0.01f);
  EXPECT_GT(r.regions[0].share, r.regions[1].share);
  EXPECT_TRUE(inspect_environment(build_environment(make_map(4, 2, [](int, int) {
                return Color(1, 1, 1);
              }))).regions.empty());
  EXPECT_EQ(inspect_environment(build_environment(make_map(4, 2, [](int, int) { return Color(0, 0, 0); })))
                .largest_over_mean,
            0);
}

// The maps of other makers. Counts are of what the files hold, found once by reading them; sunrise has 44 negative
// values below the smallest normal half, which readers that flush denormals lose.
TEST(ReadEnvironment, ReadsTheMapsOfOthersWithTheirRepairsCounted) {
  const fs::path shared = fs::path(SATEEN_SOURCE_DIR) / "../shared/hdri";
  if (!fs::exists(shared)) GTEST_SKIP() << "no " << shared;
  struct Known {
    const char* name;
    std::int64_t negative, spike;
    float largest_over_mean;
  };
  const Known all[] = {{"apartment", 11, 0, 19.5f},  {"city", 299, 0, 33071}, {"forest", 784, 0, 1761},
                       {"interior", 5053, 0, 30673}, {"sky", 11, 0, 28692},   {"studio", 3, 0, 329.4f},
                       {"sunrise", 195, 14, 3562}};
  const ColorManager colors("built-in");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Known& known : all) {
    SCOPED_TRACE(known.name);
    std::string space;
    EnvironmentFileOptions options;
    options.rotation_deg = 77;
    const Environment e =
        read_environment((shared / (known.name + std::string(".exr"))).string(), colors, options, &space);
    EXPECT_EQ(e.repairs.negative.count, known.negative);
    EXPECT_EQ(e.repairs.not_a_number.count + e.repairs.infinite.count, 0);
    EXPECT_EQ(e.repairs.spike.count, known.spike);
    EXPECT_NEAR(inspect_environment(e).largest_over_mean, known.largest_over_mean, 2e-3f * known.largest_over_mean);
    EXPECT_EQ(space.find("chromaticities") != std::string::npos, std::string(known.name) == "city");
    for (int k = 0; k < 20000; ++k)
      for (const auto density : {EnvironmentDensity::radiance, EnvironmentDensity::compensated}) {
        const EnvironmentSample s = sample_environment(e, density, uniform(random), uniform(random));
        ASSERT_GT(s.pdf, 0);
        ASSERT_EQ(environment_pdf(e, density, s.direction), s.pdf);
      }
  }
}

}  // namespace
}  // namespace sateen
