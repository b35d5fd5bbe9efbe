#include "render/pilot.h"

#include <gtest/gtest.h>

#include "pictures.h"

namespace sateen_test {
namespace {

using namespace sateen;

TEST(Pilot, ChoosesTheSameOnAnyNumberOfThreads) {
  const Scene scene = scene_of(scene_settings("crimson_velvet", 96, 54));
  const StrategyChoice one = choose_strategy(scene, {}, 1, 1);
  for (const int threads : {2, 3}) {
    const StrategyChoice other = choose_strategy(scene, {}, 1, threads);
    EXPECT_EQ(other.strategy, one.strategy);
    EXPECT_EQ(other.reason, one.reason);
    ASSERT_EQ(other.trials.size(), one.trials.size());
    for (size_t i = 0; i < one.trials.size(); ++i) {
      EXPECT_EQ(other.trials[i].squared_error, one.trials[i].squared_error);
      EXPECT_EQ(other.trials[i].cost, one.trials[i].cost);
    }
  }
}

// The pilot's error is that of a picture of its own: 5,184 pixels against its 1,536, which agree within a tenth
// unless something is wrong (their scatter over seeds is 3 to 6 %).
TEST(Pilot, PredictsTheErrorOfThePicture) {
  for (const char* map : {"studio_softboxes", "low_sun"}) {
    SceneSettings settings = scene_settings("polyester_satin_charmeuse", 96, 54);
    settings.environment = map_path(map);
    const Scene scene = scene_of(settings);
    for (const StrategyTrial& trial : choose_strategy(scene, {}, 5, 2).trials) {
      RenderSettings render_settings = samples(trial.samples, 9);
      render_settings.light.strategy = trial.strategy;
      Film film(96, 54, false);
      const double error = render(scene, render_settings, film).error.error;
      EXPECT_NEAR(trial.squared_error / (error * error), 1, 0.25) << map << " " << strategy_name(trial.strategy);
    }
  }
}

TEST(Pilot, TakesTheStrategyThatIsKnownToWin) {
  // Measured on whole pictures: resampling has 0.65 of the usual strategy's price for velvet among soft boxes, 3.4
  // times its price for satin under an overcast sky.
  SceneSettings settings = scene_settings("crimson_velvet", 240, 135);
  EXPECT_EQ(choose_strategy(scene_of(settings), {}, 1, 2).strategy, Strategy::resampled);
  settings = scene_settings("polyester_satin_charmeuse", 240, 135);
  settings.environment = map_path("overcast");
  EXPECT_EQ(choose_strategy(scene_of(settings), {}, 1, 2).strategy, Strategy::mis_compensated);
}

// A strategy that does not draw from the map looks quiet where none of the pilot's samples meets the sun: velvet at this
// size once chose the table, with 4,000 times the error.
TEST(Pilot, DoesNotMissTheSun) {
  SceneSettings settings = scene_settings("velvet", 128, 72);
  settings.environment = map_path("low_sun");
  const Scene scene = scene_of(settings);
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const Strategy chosen = choose_strategy(scene, {}, seed, 2).strategy;
    EXPECT_TRUE(chosen != Strategy::table && chosen != Strategy::uniform && chosen != Strategy::talk) << seed;
  }
}

TEST(Pilot, KeepsTheUsualStrategyWhereNothingIsSeen) {
  SceneSettings settings = scene_settings("crimson_velvet", 32, 16);
  settings.environment_ev = -200;  // black
  const StrategyChoice choice = choose_strategy(scene_of(settings), {}, 1, 1);
  EXPECT_EQ(choice.strategy, Strategy::mis_compensated);
  EXPECT_EQ(choice.reason, "mis-compensated: the pilot met no noise");
}

}  // namespace
}  // namespace sateen_test
