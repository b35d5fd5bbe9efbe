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
  const CandidateChoice one = choose_candidates(scene, {}, 1, 1);
  for (const int threads : {2, 3}) {
    const CandidateChoice other = choose_candidates(scene, {}, 1, threads);
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
    for (const CandidateTrial& trial : choose_candidates(scene, {}, 5, 2).trials) {
      RenderSettings settings = samples(16, 9);
      settings.light.candidates = trial.candidates;
      Film film(96, 54, false);
      const double error = render(scene, settings, film).error.error;
      EXPECT_NEAR(trial.squared_error / (error * error), 1, 0.25) << map << " " << trial.candidates;
    }
  }
}

// Measured on whole pictures at equal time, E^2 of 4 and 2 over that of 8: satin among soft boxes 1.53 and 2.0,
// velvet under a low sun 0.78 and 0.65 (docs/numbers.md).
TEST(Candidates, ThatAreKnownToWinAreTaken) {
  EXPECT_EQ(
      choose_candidates(lit_scene("polyester_satin_charmeuse", "studio_softboxes", 240, 135), {}, 1, 2).candidates,
      8);
  EXPECT_LT(choose_candidates(lit_scene("velvet", "low_sun", 240, 135), {}, 1, 2).candidates, 8);
}

TEST(Candidates, StayAsUsualWhereNothingIsSeen) {
  SceneSettings settings = scene_settings("crimson_velvet", 32, 16);
  settings.environment_ev = -200;  // black
  const CandidateChoice choice = choose_candidates(scene_of(settings), {}, 1, 1);
  EXPECT_EQ(choice.candidates, LightSettings().candidates);
  EXPECT_EQ(choice.reason, "the pilot met no noise");
}

TEST(Candidates, AreSaidWithTheirReason) {
  LightSettings light;
  light.candidates = 4;
  EXPECT_EQ(sampling_text(light, "8 would have 1.20 times"),
            "resampled, 4 candidates of each kind: 8 would have 1.20 times");
  light.strategy = Strategy::mis;
  EXPECT_EQ(sampling_text(light, ""), "mis");
}

}  // namespace
}  // namespace sateen_test
