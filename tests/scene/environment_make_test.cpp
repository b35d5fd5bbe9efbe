#include "scene/environment_make.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "image/chromaticities.h"
#include "image/file.h"
#include "image/scratch_folder.h"
#include "scene/environment.h"
#include "scene/environment_file.h"
#include "scene/environment_inspect.h"

namespace sateen {
namespace {

namespace fs = std::filesystem;
const fs::path source_folder = SATEEN_SOURCE_DIR;

MapDescription one_light(const MapLight& light, int width = 256, int height = 128) {
  MapDescription d;
  d.width = width;
  d.height = height;
  d.metered = false;
  d.lights = {light};
  return d;
}

MapLight light_at(MapLight::Kind kind, float azimuth, float elevation, float width, float height = 10) {
  MapLight light;
  light.kind = kind;
  light.azimuth_deg = azimuth;
  light.elevation_deg = elevation;
  light.width_deg = width;
  light.height_deg = height;
  return light;
}

double energy(const Image& map) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      sum += double(map.at(x, y)[1]) * environment_row_weight(y, map.height) * 2 * std::numbers::pi / map.width;
  return sum;
}

TEST(MakeEnvironment, KeepsTheEnergyOfASunOfAnySizeAnywhere) {
  for (float diameter : {0.01f, 0.53f, 2.0f, 20.0f})
    for (float azimuth : {0.0f, 33.0f, -179.9f})
      for (float elevation : {-90.0f, 0.0f, 14.0f, 89.0f}) {
        const double cap = 2 * std::numbers::pi * (1 - std::cos(double(radians(diameter / 2))));
        const Image map = make_environment(one_light(light_at(MapLight::Kind::disc, azimuth, elevation, diameter)));
        EXPECT_NEAR(energy(map), cap, 1e-3 * cap) << diameter << " " << azimuth << " " << elevation;
      }
}

TEST(MakeEnvironment, PlacesLightsWhereInspectionFindsThem) {
  for (float azimuth : {0.0f, -52.0f, 90.0f, 150.0f})
    for (float elevation : {-60.0f, 0.0f, 36.0f}) {
      const Environment e = build_environment(
          make_environment(one_light(light_at(MapLight::Kind::softbox, azimuth, elevation, 20, 12))));
      const EnvironmentReport report = inspect_environment(e);
      ASSERT_EQ(report.regions.size(), 1u);
      EXPECT_NEAR(report.regions[0].azimuth_deg, azimuth, 0.2f);
      EXPECT_NEAR(report.regions[0].elevation_deg, elevation, 0.2f);
      EXPECT_NEAR(report.regions[0].share, 1, 1e-3f);
      // A rectangle seen from its axis: 4 asin(sin(a/2) sin(b/2)).
      const float exact = 4 * std::asin(std::sin(radians(10)) * std::sin(radians(6)));
      EXPECT_NEAR(energy(make_environment(one_light(light_at(MapLight::Kind::softbox, azimuth, elevation, 20, 12)))),
                  double(exact), 0.01 * double(exact));
    }
  // +X is the right of the picture: azimuth 90.
  const Environment right = build_environment(make_environment(one_light(light_at(MapLight::Kind::disc, 90, 0, 10))));
  EXPECT_GT(environment_radiance(right, Vec3(1, 0, 0)).x, 0.9f);
  EXPECT_EQ(environment_radiance(right, Vec3(-1, 0, 0)).x, 0);
}

TEST(MakeEnvironment, RollsASoftboxClockwise) {
  MapLight strip = light_at(MapLight::Kind::softbox, 180, 0, 4, 60);
  strip.roll_deg = 45;
  const Environment e = build_environment(make_environment(one_light(strip)));
  // Ahead of the camera: clockwise leans the top to the right.
  EXPECT_GT(environment_radiance(e, Vec3(0.3f, 0.3f, -1)).x, 0.9f);
  EXPECT_EQ(environment_radiance(e, Vec3(-0.3f, 0.3f, -1)).x, 0);
}

TEST(MakeEnvironment, MetersItsMapsToZero) {
  MapDescription d = one_light(light_at(MapLight::Kind::glow, 20, 30, 40));
  d.metered = true;
  for (const char* space : {"lin_rec709", "acescg"}) {
    d.color_space = space;
    Image map = make_environment(d);
    const ColorManager colors("built-in");
    colors.to_working(map, space);
    EnvironmentOptions options;
    options.luminance = colors.luminance_weights();
    EXPECT_NEAR(metered_exposure_ev(build_environment(map, options)), 0, 1e-3f) << space;
  }
}

TEST(MakeEnvironment, GivesBlackBodiesTheirColour) {
  // CIE 1931 xy of 6500 K on the Planckian locus is (0.3135, 0.3237): near the white of Rec.709, a little rose.
  const Color day = black_body_rec709(6500);
  EXPECT_NEAR(day.x, 1.03f, 0.04f);
  EXPECT_NEAR(day.y, 0.99f, 0.03f);
  EXPECT_GT(black_body_rec709(3000).x, 2 * black_body_rec709(3000).z);
  EXPECT_GT(black_body_rec709(12000).z, black_body_rec709(12000).x);
  for (float kelvin = 1000; kelvin <= 15000; kelvin += 500) {
    const Color c = black_body_rec709(kelvin);
    EXPECT_NEAR(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z, 1, 1e-5f);
    EXPECT_GE(std::min({c.x, c.y, c.z}), 0);
  }
}

std::string refusal(const std::string& text) {
  try {
    parse_map_description(text, "map.json");
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::wrong);
    return error.what();
  }
  return "it was read";
}

TEST(MapDescription, RefusesEveryMistakeAtItsPlaceAllAtOnce) {
  const std::string text =
      "{\n"
      "  \"size\": [0, 12.5],\n"
      "  \"tilte\": \"x\",\n"
      "  \"lights\": [\n"
      "    { \"kind\": \"softbx\" },\n"
      "    { \"kind\": \"disc\", \"width_deg\": 500, \"height_deg\": 3 },\n"
      "    { \"kind\": \"uniform\", \"color\": [1, 2], \"kelvin\": 3000 },\n"
      "    { \"kind\": \"gradient\", \"stops\": [ { \"elevation_deg\": 5 }, { \"elevation_deg\": 5 } ] },\n"
      "    7\n"
      "  ]\n"
      "}\n";
  const std::string message = refusal(text);
  for (const char* expected :
       {"map.json:2:12: error: this value is 0, expected 1 to 16384",
        "map.json:2:15: error: size is 12.5, expected a whole number", "map.json:3:3: error: unknown key \"tilte\"",
        "help: did you mean title?", "map.json:5:15: error: unknown kind of light \"softbx\"",
        "help: did you mean softbox?", "map.json:6:36: error: width_deg is 500, expected 0.01 to 170",
        "map.json:6:41: error: unknown key \"height_deg\"", "color has 2 numbers, expected 3",
        "color and kelvin are both given",
        "map.json:8:62: error: elevation_deg is 5, expected above the stop before it, 5",
        "map.json:9:5: error: this value is a number, expected an object"})
    EXPECT_NE(message.find(expected), std::string::npos) << "missing: " << expected << "\nin:\n" << message;
}

TEST(MapDescription, RefusesOtherShapes) {
  EXPECT_NE(refusal("[]").find("expected an object"), std::string::npos);
  EXPECT_NE(refusal("{}").find("a map needs lights"), std::string::npos);
  EXPECT_NE(refusal("{\"lights\": 3}").find("expected a list"), std::string::npos);
  EXPECT_NE(refusal("{\"lights\": [], \"color_space\": \"srgb\"}").find("expected \"lin_rec709\" or \"acescg\""),
            std::string::npos);
  EXPECT_NE(refusal("{\"lights\": [], \"lights\": []}").find("lights"), std::string::npos);
  EXPECT_EQ(refusal("{\"lights\": []}"), "it was read");
}

TEST(ShippedMaps, AreWhatTheirDescriptionsMake) {
  int found = 0;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(source_folder / "envmaps")) {
    if (entry.path().extension() != ".json") continue;
    ++found;
    fs::path exr = entry.path();
    exr.replace_extension(".exr");
    SCOPED_TRACE(exr.string());
    bytes += fs::file_size(exr);
    const Image made = make_environment(read_map_description(entry.path())), shipped = read_image(exr);
    ASSERT_EQ(made.pixels.size(), shipped.pixels.size());
    // Half keeps 11 bits; another processor's libm may differ in the last of them.
    for (size_t i = 0; i < made.pixels.size(); ++i)
      ASSERT_NEAR(shipped.pixels[i], made.pixels[i], 1.5e-3f * made.pixels[i] + 1e-6f) << i;
    for (float v : shipped.pixels) ASSERT_TRUE(std::isfinite(v) && v >= 0);
  }
  EXPECT_GE(found, 4);
  EXPECT_LT(bytes, 3u << 20);
}

TEST(ShippedMaps, AreFoundByNameAndNeedNoRepair) {
  setenv("SATEEN_HOME", SATEEN_SOURCE_DIR, 1);
  const ColorManager colors("built-in");
  for (const char* name : {"studio_softboxes", "overcast", "low_sun", "three_light_rig"}) {
    std::string space;
    const Environment e = read_environment(name, colors, {}, &space);
    EXPECT_FALSE(e.repairs.any()) << name;
    EXPECT_EQ(e.repairs.spike.count, 0) << name;
    EXPECT_EQ(space, "linear, primaries and white of the file's chromaticities");
    EXPECT_NEAR(metered_exposure_ev(e), 0, 0.01f) << name;
  }
  unsetenv("SATEEN_HOME");
}

}  // namespace
}  // namespace sateen
