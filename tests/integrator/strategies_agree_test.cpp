#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>

#include "base/parallel.h"
#include "image/color.h"
#include "integrator/made_scenes.h"
#include "integrator/picture_batches.h"
#include "mesh/obj.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "scene/environment_file.h"
#include "scene/near_weave.h"

// All strategies converge to the same picture: every pixel, every block of 4 x 4 pixels and the whole picture of
// every scene, by deviates of means of independent batches, corrected for their number (Sidak).

namespace sateen_test {
namespace {

using namespace sateen;

constexpr double false_alarms = 1e-3;  // of one of the tests below, all of its scenes and strategies together
constexpr int batches = 16;

struct SceneRecipe {
  std::string look, mesh;
  int level;
  std::string map;
  /// The finest scale at which strategies that do not know the map are judged: a mean of few hits on a small light is
  /// not normal, whatever the number of batches (at least about 50 hits are wanted). Nothing: the light is met by one
  /// direction in 100,000.
  Scale blind = Scale::pixel;
  float zoom = 1;  ///< of the camera; near enough, single threads show
};

Environment made_map(const std::string& name) {
  if (name == "constant") return constant_map(0.7f);
  if (name == "noise") {
    std::mt19937 random(7);
    const auto r = [&] { return 2 * std::pow(float(random() % 10000) / 10000, 3.0f); };
    return map_of(
        32, 16, [&](int, int) { return Color(r(), r(), r()); }, radians(37));
  }
  if (name == "one texel")
    return map_of(16, 8, [](int x, int y) { return x == 1 && y == 2 ? Color(30, 20, 10) : Color(0); });
  if (name == "sun and sky")
    return map_of(64, 32, [](int x, int y) {
      return x == 37 && y == 9 ? Color(300, 280, 240) : y < 16 ? Color(0.3f, 0.5f, 0.9f) : Color(0.1f);
    });
  static const ColorManager colors("built-in");
  const std::string own = SATEEN_SOURCE_DIR "/envmaps/" + name + ".exr";
  return read_environment(std::filesystem::exists(own) ? own : SATEEN_SOURCE_DIR "/../shared/hdri/" + name + ".exr",
                          colors);
}

Scene cook(const SceneRecipe& recipe) {
  Mesh mesh = is_built_in_shape(recipe.mesh) ? shape(recipe.mesh, recipe.level)
                                             : subdivide(read_obj(recipe.mesh), recipe.level, 2);
  const Look& look = shipped_look(recipe.look);
  Scene scene = make_scene(std::move(mesh), fabric_of(look), made_map(recipe.map));
  if (!look.back.empty()) scene.back = fabric_of(shipped_look(look.back));
  scene.has_gaps = scene.front.gap > 0 || (scene.back && scene.back->gap > 0);
  CameraSettings camera;
  camera.azimuth_deg = 20;
  camera.zoom = recipe.zoom;
  scene.camera = frame_points(scene.mesh->positions, camera, 24, 16);
  scene.near_weave_pixel = near_weave_pixel(scene);
  return scene;
}

/// Cheap and noisy strategies get more samples than dear and quiet ones, so that all means are about as normal.
int share_of_samples(const LightSettings& light, int samples) {
  switch (light.strategy) {
    case Strategy::uniform:
    case Strategy::table:
    case Strategy::environment:
      return 2 * samples;
    case Strategy::resampled:
      return light.candidates.table > 2 || light.candidates.map > 2 ? samples / 2 : samples;
    default:
      return samples;
  }
}

/// Compares all strategies with one another by way of one reference.
void expect_agreement(const std::vector<SceneRecipe>& recipes, int bounces, int samples, Scale finest_of_all) {
  // One pixel test and its block and picture tests a strategy and scene, at most.
  const double tests = double(recipes.size() * all_settings().size()) * (24 * 16 + 6 * 4 + 1) * 3;
  const double bound = sidak_deviate(false_alarms, tests);
  std::uint32_t seed = 1000;
  for (const SceneRecipe& recipe : recipes) {
    const Scene scene = cook(recipe);
    const std::string name = recipe.look + ", " + recipe.mesh + ", " + recipe.map;
    const PictureBatches reference =
        render_batches(scene, {Strategy::mis_compensated, 8, bounces}, batches, 2 * samples, seed);
    EXPECT_EQ(reference.non_finite, 0) << name;
    for (const NamedSettings& settings : all_settings(bounces)) {
      seed += 1000;
      const Scale finest =
          knows_the_map(settings.light) ? finest_of_all : std::max(finest_of_all, recipe.blind);
      if (finest == Scale::nothing) continue;
      const double start = cpu_seconds();
      const PictureBatches picture =
          render_batches(scene, settings.light, batches, share_of_samples(settings.light, samples), seed);
      EXPECT_EQ(picture.non_finite, 0) << name << ", " << settings.name;
      const Disagreement worst = largest_deviate(picture, reference, finest);
      if (std::getenv("SATEEN_TEST_NUMBERS"))
        fprintf(stderr, "%-60s %-16s %.2f  %.2f s  %s\n", name.c_str(), settings.name.c_str(), worst.deviate,
                cpu_seconds() - start, worst.place.c_str());
      EXPECT_LT(worst.deviate, bound) << name << ": " << settings.name << " disagrees with mis-compensated in "
                                      << worst.place;
    }
    seed += 1000;
  }
}

const std::vector<SceneRecipe>& everyday() {
  static const std::vector<SceneRecipe> recipes{
      {"polyester_satin_charmeuse", "drape", 1, "studio_softboxes", Scale::block},
      {"linen_plain", "sphere", 1, "constant"},
      {"velvet", "skirt", 0, "sun and sky", Scale::picture},
      {"silk_shot", "swatch", 1, "one texel", Scale::block},
      {"silk_crepe_de_chine", "sphere", 0, "noise"},
      {"habotai", "drape", 0, "low_sun", Scale::nothing},
  };
  return recipes;
}

// The whole grid: 24 scenes of looks, maps and meshes, those of ../shared too where they are there.
std::vector<SceneRecipe> grid() {
  const std::string shared = SATEEN_SOURCE_DIR "/../shared";
  const bool there = std::filesystem::exists(shared + "/hdri/studio.exr");
  const std::vector<std::string> looks{"polyester_satin_charmeuse",
                                       "silk_crepe_de_chine",
                                       "velvet",
                                       "linen_plain",
                                       "silk_shot",
                                       "ivory_duchess_satin",
                                       "habotai",
                                       "dupioni"};
  std::vector<std::pair<std::string, Scale>> maps{{"noise", Scale::pixel},
                                                  {"one texel", Scale::block},
                                                  {"constant", Scale::pixel},
                                                  {"sun and sky", Scale::picture},
                                                  {"studio_softboxes", Scale::picture},
                                                  {"low_sun", Scale::nothing},
                                                  {"three_light_rig", Scale::picture},
                                                  {"overcast", Scale::pixel}};
  if (there)
    for (const char* name : {"apartment", "city", "forest", "interior", "sky", "studio", "sunrise"})
      maps.push_back({name, Scale::nothing});
  std::vector<std::string> meshes{"drape", "skirt", "sphere", "swatch"};
  const std::string garment = shared + "/meshes/makehuman/fedora.obj";
  if (std::filesystem::exists(garment)) meshes.push_back(garment);
  std::vector<SceneRecipe> all;
  for (size_t i = 0; i < 24; ++i) {
    const auto& [map, blind] = maps[i % maps.size()];
    all.push_back({looks[(i + i / 8) % looks.size()], meshes[i % meshes.size()], int(i % 2), map, blind});
  }
  return all;
}

TEST(Strategies, ConvergeToTheSamePictureOverTheWholeGridOfScenes) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "long: set SATEEN_LONG_TESTS";
  expect_agreement(grid(), 0, 256, Scale::pixel);
}

TEST(Strategies, ConvergeToTheSamePictureOverTheWholeGridOfScenesWithLightThatMeetsClothAgain) {
  if (!std::getenv("SATEEN_LONG_TESTS")) GTEST_SKIP() << "long: set SATEEN_LONG_TESTS";
  expect_agreement(grid(), 2, 128, Scale::block);
}

TEST(Strategies, ConvergeToTheSamePicture) {
  expect_agreement(everyday(), 0, 32, Scale::pixel);
}

TEST(Strategies, ConvergeToTheSamePictureOfThreadsSeenFromNear) {
  expect_agreement({{"linen_plain", "swatch", 1, "constant", Scale::block, 300},
                    {"shot_taffeta", "swatch", 1, "noise", Scale::block, 600},
                    {"champagne_silk_satin", "swatch", 1, "studio_softboxes", Scale::picture, 600}},
                   1, 10, Scale::block);
}

TEST(Strategies, ConvergeToTheSamePictureWithLightThatMeetsClothAgain) {
  expect_agreement({everyday()[0], everyday()[2], {"linen_plain", "drape", 0, "noise"}}, 2, 16, Scale::block);
}

}  // namespace
}  // namespace sateen_test
