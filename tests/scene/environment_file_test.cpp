#include "scene/environment_file.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/file.h"
#include "image/scratch_folder.h"
#include "maps.h"
#include "scene/environment_inspect.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
using sateen_test::make_map;
using sateen_test::ScratchFolder;
using sateen_test::write_map;

long peak_kilobytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
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
  write_map(exr, red, {});
  EXPECT_NEAR(read(exr, "lin_rec709", space).x, 0.613097f, 1e-5f);
  try {
    read(exr, "", space);
    ADD_FAILURE() << "primaries of zeros were read as " << space;
  } catch (const InputError& error) {
    EXPECT_EQ(error.diagnostics.at(0).message, exr.string() +
                                                   ": the chromaticities describe no colour space: "
                                                   "expected three primaries around a white");
    EXPECT_NE(error.diagnostics.at(0).help.find("--env-space"), std::string::npos);
  }
  Image grey(4, 2, 3);
  for (float& v : grey.pixels) v = 128 / 255.0f;
  write_display_image(png, grey);
  EXPECT_NEAR(read(png, "", space).y, 0.2158f, 0.003f);  // sRGB's curve
  EXPECT_NEAR(read(png, "raw", space).y, 0.502f, 0.005f);
}

TEST(ReadEnvironment, KnowsTheNamesThatFilesGiveTheirColourSpaceOrSaysThatItDoesNot) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const fs::path path = folder.path / "a.exr";
  const Image map = make_map(4, 2, [](int, int) { return Color(0.1f, 0.2f, 0.3f); });
  struct Case {
    const char *attribute, *name, *used;
    bool known = true;
  };
  for (const Case& c : {Case{"oiio:ColorSpace", "ACEScg", "ACEScg (the file's metadata)"},
                        {"oiio:ColorSpace", "lin_ap1_scene", "acescg (the file says lin_ap1_scene)"},
                        {"colorInteropID", "lin_ap1_scene", "acescg (the file says lin_ap1_scene)"},
                        {"colorInteropID", "srgb_rec709_scene", "srgb_texture (the file says srgb_rec709_scene)"},
                        {"oiio:ColorSpace", "ACES - ACES2065-1", "aces2065-1 (the file says ACES - ACES2065-1)"},
                        {"oiio:ColorSpace", "Linear", "lin_rec709 (usual for float pixels)"},
                        {"oiio:ColorSpace", "Rec709", "lin_rec709 (usual for float pixels)", false},
                        {"colorInteropID", "lin_rec2020_scene", "lin_rec709 (usual for float pixels)", false}}) {
    write_exr(path, {{"", {"R", "G", "B"}, false, map}}, {{c.attribute, std::string(c.name)}}, std::nullopt);
    std::string used;
    const Environment e = read_environment(path.string(), colors, {}, &used);
    EXPECT_EQ(used, c.used);
    EXPECT_EQ(e.doubts.empty(), c.known) << c.name;
    if (!c.known && !e.doubts.empty()) {
      EXPECT_NE(e.doubts[0].find(std::string(c.name) + ", which is not known; taken as lin_rec709"),
                std::string::npos)
          << e.doubts[0];
    }
    EnvironmentFileOptions asked;
    asked.color_space = "acescg";
    EXPECT_TRUE(read_environment(path.string(), colors, asked).doubts.empty());
  }
}

TEST(ReadEnvironment, CountsOnlyWhatIsNegativeInTheWorkingSpaceAsOutOfGamut) {
  const ScratchFolder folder;
  const ColorManager colors("built-in", "lin_rec709");
  const fs::path path = folder.path / "a.exr";
  Image map = make_map(8, 4, [](int, int) { return Color(0.5f, 0.5f, 0.5f); });
  std::copy_n(Color(-4, 0.5f, 0.5f).getValue(), 3, map.at(2, 1));  // negative here and there
  std::copy_n(Color(0, 1, 0).getValue(), 3, map.at(5, 3));         // AP1 green: outside Rec.709
  std::copy_n(Color(1, 1, -0.001f).getValue(), 3, map.at(6, 3));   // negative here alone? no: outside too
  write_map(path, map, ap1_chromaticities);
  const Environment e = read_environment(path.string(), colors);
  EXPECT_EQ(e.repairs.negative.count, 2);
  EXPECT_EQ(e.repairs.negative.first_x, 2);
  EXPECT_EQ(e.repairs.out_of_gamut.count, 1);
  EXPECT_EQ(e.repairs.wide.count, 0);
  for (const auto& t : e.texels) EXPECT_GE(std::min({t.radiance.x, t.radiance.y, t.radiance.z}), 0);
}

// The working space holds all of these colours: whatever primaries they are written with, they are the same light.
TEST(ReadEnvironment, ReadsTheSameLightFromPrimariesThatHaveToStateItWithNegativeNumbers) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const Image wide = make_map(16, 8, [](int x, int y) {
    return x == 3 && y == 2 ? Color(0, 30, 0.5f) : Color(0.05f, 1, 0.05f + float(y) / 8) * float(x + 1);
  });
  const Matrix3 matrix = multiply(inverse(to_aces2065_1(rec709_chromaticities)), to_aces2065_1(ap1_chromaticities));
  Image narrow = wide;
  std::int64_t negative = 0;
  for (size_t i = 0; i < wide.pixels.size(); i += 3) {
    bool below = false;
    for (size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (size_t k = 0; k < 3; ++k) sum += matrix[c][k] * double(wide.pixels[i + k]);
      narrow.pixels[i + c] = float(sum);
      below = below || sum < 0;
    }
    negative += below;
  }
  ASSERT_GT(negative, 100);
  write_map(folder.path / "wide.exr", wide, ap1_chromaticities);
  write_map(folder.path / "narrow.exr", narrow, rec709_chromaticities);
  const Environment a = read_environment((folder.path / "wide.exr").string(), colors);
  const Environment b = read_environment((folder.path / "narrow.exr").string(), colors);
  for (size_t i = 0; i < a.texels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(a.texels[i].radiance[c], b.texels[i].radiance[c], 2e-4f * (1 + a.texels[i].radiance[c])) << i;
  EXPECT_EQ(b.repairs.wide.count + b.repairs.negative.count, negative);
  EXPECT_LE(b.repairs.negative.count, 1);  // rounding at the pixel without red
  EXPECT_FALSE(a.repairs.any());
}

TEST(ReadEnvironment, MendsWhatIsNoNumberBeforeItConverts) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  Image map = make_map(16, 8, [](int, int) { return Color(1, 1, 1); });
  map.at(4, 1)[0] = inf;  // above the pixel that says what it becomes
  map.at(9, 5)[0] = 50;
  map.at(2, 3)[1] = nan;
  map.at(1, 1)[2] = -inf;
  Image mended = map;
  mended.at(4, 1)[0] = 50;
  mended.at(2, 3)[1] = mended.at(1, 1)[2] = 0;
  write_map(folder.path / "a.exr", map, rec709_chromaticities);
  write_map(folder.path / "b.exr", mended, rec709_chromaticities);
  const Environment a = read_environment((folder.path / "a.exr").string(), colors);
  const Environment b = read_environment((folder.path / "b.exr").string(), colors);
  for (size_t i = 0; i < a.texels.size(); ++i) ASSERT_EQ(a.texels[i].radiance, b.texels[i].radiance) << i;
  EXPECT_EQ(a.repairs.infinite.count, 2);
  EXPECT_EQ(a.repairs.not_a_number.count, 1);
}

TEST(ReadEnvironment, ConvertsXyzWithD65AsWhite) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const fs::path path = folder.path / "a.hdr";
  {
    std::ofstream out(path, std::ios::binary);
    out << "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 2\n";
    // 0.9505 1 1.0891 and Rec.709's green in 1/256 of 2.
    for (const int byte : {122, 128, 139, 129, 46, 92, 15, 129}) out.put(char(byte));
  }
  std::string space;
  const Environment e = read_environment(path.string(), colors, {}, &space);
  EXPECT_EQ(space, "CIE XYZ, D65 as white");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(e.texels[0].radiance[c], 1, 0.02f);
  const Color green = colors.to_working(Color(0, 1, 0), "lin_rec709");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(e.texels[1].radiance[c], green[c], 0.02f);
}

// What --map-size does while it reads is the box filter, over solid angle, of what would have been read.
TEST(ReadEnvironment, ShrinksWhileItReadsToTheMeansOfTheWholeMap) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const fs::path path = folder.path / "a.exr";
  std::mt19937 random(4);
  Image map = make_map(101, 50, [&](int, int) {
    const auto r = [&] { return float(random() % 1000) / 300; };
    return Color(r(), r(), r());
  });
  map.at(70, 20)[1] = std::numeric_limits<float>::infinity();
  map.at(33, 40)[1] = 900;
  write_map(path, map, rec709_chromaticities);
  EnvironmentFileOptions options;
  options.exposure_ev = 1.5f;
  options.rotation_deg = 30;
  const Environment whole = read_environment(path.string(), colors, options);
  for (const auto& [width, height] : {std::pair{50, 25}, std::pair{64, 32}, std::pair{8, 4}, std::pair{101, 50}}) {
    options.width = width;
    const Environment small = read_environment(path.string(), colors, options);
    ASSERT_EQ(small.width, width);
    ASSERT_EQ(small.height, height);
    EXPECT_EQ(small.rotation, whole.rotation);
    EXPECT_EQ(small.repairs.infinite.first_x, 70);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double sum[3] = {0, 0, 0}, weight = 0;
        for (int v = y * 50 / height; v < (y + 1) * 50 / height; ++v)
          for (int u = x * 101 / width; u < (x + 1) * 101 / width; ++u) {
            const double row = environment_row_weight(v, 50);
            for (int c = 0; c < 3; ++c) sum[c] += row * double(whole.radiance_at(u, v)[c]);
            weight += row;
          }
        for (int c = 0; c < 3; ++c) ASSERT_FLOAT_EQ(small.radiance_at(x, y)[c], float(sum[c] / weight));
      }
  }
  options.width = 5000;
  EXPECT_EQ(read_environment(path.string(), colors, options).width, 101) << "never made larger";
}

TEST(ReadEnvironment, KeepsToTheLimitWithWhatItHoldsAndNamesBothWaysOut) {
  const ScratchFolder folder;
  const ColorManager colors("built-in");
  const fs::path path = folder.path / "a.exr";
  write_map(path, make_map(64, 32, [](int, int) { return Color(1, 2, 3); }), rec709_chromaticities);
  EnvironmentFileOptions options;
  options.limits.decoded_bytes = 64 * 32 * 12 - 1;
  try {
    read_environment(path.string(), colors, options);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
    EXPECT_NE(std::string(error.what()).find("--map-size"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--image-limit"), std::string::npos) << error.what();
  }
  options.width = 32;
  EXPECT_EQ(read_environment(path.string(), colors, options).width, 32);
  options.width = 0;
  options.limits.decoded_bytes += 1;
  EXPECT_EQ(read_environment(path.string(), colors, options).width, 64);
  const ImageLimits raised = image_limits_of(8);
  EXPECT_EQ(raised.decoded_bytes, 8ll << 30);
}

// 16384 x 8192 in half floats, as libraries of maps offer them.
TEST(ReadEnvironment, ReadsA16kMapInTwoGigabytes) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "takes 2 GB and a minute; set SATEEN_LONG_TESTS";
  const ScratchFolder folder;
  const fs::path path = folder.path / "16k.exr";
  constexpr int width = 16384, height = 8192;
  sateen_test::write_banded_exr(path, width, height);
  const ColorManager colors("built-in");
  EnvironmentFileOptions options;
  options.width = 1024;
  const long before = peak_kilobytes();
  const Environment small = read_environment(path.string(), colors, options);
  EXPECT_LT(peak_kilobytes() - before, 200'000) << "shrunk while reading";
  const Environment e = read_environment(path.string(), colors);
  EXPECT_EQ(e.width, width);
  EXPECT_GT(inspect_environment(e).largest, 1);
  EXPECT_LT(peak_kilobytes(), 2'200'000'000 / 1024);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(small.mean_radiance[c] / e.mean_radiance[c], 1, 1e-5f);
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
    std::int64_t negative;  ///< in the file
    std::int64_t still;     ///< of them, in the working space too
    std::int64_t spike;
    float largest_over_mean;
  };
  const Known all[] = {{"apartment", 11, 7, 0, 19.5f},     {"city", 299, 220, 0, 33071}, {"forest", 784, 1, 0, 1761},
                       {"interior", 5053, 4161, 0, 30673}, {"sky", 11, 11, 0, 28692},    {"studio", 3, 0, 0, 329.4f},
                       {"sunrise", 195, 31, 14, 3562}};
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
    EXPECT_EQ(e.repairs.negative.count + e.repairs.wide.count, known.negative);
    EXPECT_EQ(e.repairs.negative.count, known.still);
    EXPECT_EQ(e.repairs.out_of_gamut.count, 0);  // the working space holds the primaries of all of them
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
