#include "render/candidates.h"

#include <gtest/gtest.h>

#include "pictures.h"

namespace sateen_test {
namespace {

using namespace sateen;

Scene lit_scene(const char* look, const char* map, int width, int height) {
  SceneSettings settings = scene_settings(look, width, height);
  settings.environment = map_path(map);
  return scene_of(settings);
}

TEST(Candidates, AreTheSameOnAnyNumberOfThreads) {
  const Scene scene = lit_scene("crimson_velvet", "studio_softboxes", 96, 54);
  const CandidateChoice one = choose_candidates(scene, {}, default_error_floor, 1, 1);
  for (const int threads : {2, 3}) {
    const CandidateChoice other = choose_candidates(scene, {}, default_error_floor, 1, threads);
    EXPECT_EQ(other.candidates, one.candidates);
    EXPECT_EQ(other.reason, one.reason);
    ASSERT_EQ(other.trials.size(), one.trials.size());
    for (size_t i = 0; i < one.trials.size(); ++i) {
      EXPECT_EQ(other.trials[i].squared_error, one.trials[i].squared_error);
      EXPECT_EQ(other.trials[i].cost, one.trials[i].cost);
    }
  }
}

// Its error is that of a picture: 5,184 pixels against the pilot's 1,536, which agree within a tenth unless something
// is wrong (their scatter over seeds is 3 to 6 %).
TEST(Candidates, PilotPredictsTheErrorOfThePicture) {
  for (const char* map : {"studio_softboxes", "low_sun"}) {
    const Scene scene = lit_scene("polyester_satin_charmeuse", map, 96, 54);
    for (const CandidateTrial& trial : choose_candidates(scene, {}, default_error_floor, 5, 2).trials) {
      RenderSettings settings = samples(16, 9);
      settings.light.candidates = trial.candidates;
      Film film(96, 54, false);
      const double error = render(scene, settings, film).error.error;
      EXPECT_NEAR(trial.squared_error / (error * error), 1, 0.25) << map << " " << candidates_text(trial.candidates);
    }
  }
}

CandidateCounts chosen(const char* look, const char* map, std::uint32_t seed = 1) {
  return choose_candidates(lit_scene(look, map, 240, 135), {}, default_error_floor, seed, 2).candidates;
}

// Measured on whole pictures at equal time (docs/numbers.md), E^2 over that of eight of each kind: satin among soft
// boxes 0.70 to 0.79 with 16 of the map, 1.6 with 4; velvet under a low sun 0.84 with four of each, 1.5 and more with
// 16 of the map.
TEST(Candidates, ThatAreKnownToWinAreTaken) {
  EXPECT_EQ(chosen("polyester_satin_charmeuse", "studio_softboxes").map, 16);
  EXPECT_EQ(chosen("velvet", "low_sun").map, 4);
  // Eight of the table have 1.1 there, which is as much as the pilot is unsure of: it may be wrong once in five
  // seeds.
  int fewer = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) fewer += chosen("velvet", "low_sun", seed).table < 8;
  EXPECT_GE(fewer, 4);
}

TEST(Candidates, OfAMapWithoutLightsAreTheTablesAlone) {
  Scene scene = lit_scene("polyester_satin_charmeuse", "studio_softboxes", 96, 54);
  Image map(32, 16, 3);
  for (float& v : map.pixels) v = 2;
  scene.environment = build_environment(std::move(map));
  const CandidateCounts found = choose_candidates(scene, {}, default_error_floor, 1, 2).candidates;
  EXPECT_EQ(found.map, 0);
  EXPECT_GT(found.table, 0);
}

TEST(Candidates, StayAsUsualWhereNothingIsSeen) {
  SceneSettings settings = scene_settings("crimson_velvet", 32, 16);
  settings.environment_ev = -200;  // black
  const CandidateChoice choice = choose_candidates(scene_of(settings), {}, default_error_floor, 1, 1);
  EXPECT_EQ(choice.candidates, CandidateCounts(LightSettings().candidates.table, 0));
  EXPECT_EQ(choice.reason, "the pilot met no noise");
}

TEST(Candidates, AreSaidWithTheirReason) {
  LightSettings light;
  light.candidates = {4, 16};
  EXPECT_EQ(sampling_text(light, "8 would have 1.20 times"),
            "resampled, 4 directions of the cloth's table and 16 of the map: 8 would have 1.20 times");
  light.candidates = {8, 0};
  EXPECT_EQ(sampling_text(light, ""), "resampled, 8 directions of the cloth's table");
  light.strategy = Strategy::mis;
  EXPECT_EQ(sampling_text(light, ""), "mis");
}

}  // namespace
}  // namespace sateen_test
