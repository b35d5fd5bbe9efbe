#include "render/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "error_scenes.h"
#include "look/find.h"
#include "look/read.h"
#include "render/bill.h"

using namespace sateen;
using namespace sateen_test;

namespace {

SceneSettings settings_of(const ErrorScene& s, int width, int height) {
  SceneSettings settings = scene_settings(s.look, width, height);
  settings.mesh = s.mesh;
  settings.environment = map_path(s.map);
  settings.level = 2;
  return settings;
}

Plan plan_of(const SceneSettings& settings, const Scene& scene, const std::string& effects, double error,
             double error_floor = default_error_floor) {
  PlanSettings how;
  how.switches = read_effects(effects);
  how.error = error;
  how.error_floor = error_floor;
  how.threads = 2;
  return make_plan(scene, read_look(settings.look), how);
}

std::vector<Verdict> verdicts_of(const Scene& scene, const Plan& plan, double error_floor = default_error_floor) {
  return verify_plan(scene, plan, {}, error_floor, 1, 2);
}

/// A scene that plans are tested on, beside those that errors are.
struct PlanScene {
  ErrorScene scene;
  float zoom = 1;
  int ground = -1;        ///< a GroundKind; -1: none
  float map_ev = 0;       ///< of the light
  float exposure_ev = 0;  ///< of the picture: a dim light is metered, or the picture is dark
  float f_stop = 0;       ///< 0: a pinhole
  float shutter_deg = 0;
  bool seen_map = false;  ///< as the backdrop
};

std::vector<PlanScene> plan_scenes() {
  constexpr int catcher = int(GroundKind::catcher), floor = int(GroundKind::floor),
                cyclorama = int(GroundKind::cyclorama);
  std::vector<PlanScene> all{
      // Sheer cloth.
      {{"silk_organza", "sphere", "studio_softboxes"}},
      {{"silk_organza", "drape", "low_sun"}},
      {{"silk_organza", "swatch", "overcast"}, 1, -1, 0, 0, 0, 0, true},
      {{"silk_organza", "skirt", "three_light_rig"}},
      {{"silk_chiffon", "sphere", "low_sun"}, 1, -1, 0, 0, 0, 0, true},
      {{"silk_chiffon", "drape", "studio_softboxes"}},
      {{"silk_chiffon", "skirt", "overcast"}, 1, floor},
      {{"dupioni", "sphere", "low_sun"}},
      {{"dupioni", "skirt", "three_light_rig"}, 1, -1, 0, 0, 0, 0, true},
      {{"linen_plain", "sphere", "studio_softboxes"}},
      {{"natural_linen", "drape", "low_sun"}},
      // Dim light that is metered, and dark pictures.
      {{"champagne_silk_satin", "drape", "studio_softboxes"}, 1, -1, -6, 6},
      {{"ivory_duchess_satin", "skirt", "overcast"}, 1, -1, -10, 10},
      {{"silk_organza", "sphere", "overcast"}, 1, -1, -6, 6},
      {{"dupioni", "drape", "low_sun"}, 1, -1, -8, 8},
      {{"emerald_satin", "drape", "studio_softboxes"}, 1, -1, -4, 0},
      {{"midnight_silk", "skirt", "studio_softboxes"}, 1, -1, 5, -5},
      // Grounds.
      {{"champagne_silk_satin", "drape", "low_sun"}, 1, catcher},
      {{"silk_organza", "sphere", "studio_softboxes"}, 1, catcher},
      {{"crimson_velvet", "skirt", "overcast"}, 1, catcher},
      {{"emerald_satin", "sphere", "low_sun"}, 1, floor},
      {{"pewter_satin", "sphere", "studio_softboxes"}, 1, cyclorama},
      {{"linen_plain", "swatch", "three_light_rig"}, 1, floor},
      // Threads from near.
      {{"shot_taffeta", "swatch", "studio_softboxes"}, 70},
      {{"shot_taffeta", "drape", "low_sun"}, 30},
      {{"natural_linen", "swatch", "overcast"}, 20},
      {{"natural_linen", "drape", "studio_softboxes"}, 6},
      {{"dupioni", "swatch", "studio_softboxes"}, 60},
      {{"silk_organza", "swatch", "low_sun"}, 80},
      {{"silk_chiffon", "drape", "three_light_rig"}, 40, -1, 0, 0, 0, 0, true},
      // Lens, shutter, back, pattern, map seen.
      {{"champagne_silk_satin", "drape", "studio_softboxes"}, 1, -1, 0, 0, 64, 0, true},
      {{"emerald_satin", "drape", "low_sun"}, 1, -1, 0, 0, 400},
      {{"pewter_satin", "sphere", "low_sun"}, 1, -1, 0, 0, 0, 0.1f},
      {{"silk_damask", "skirt", "studio_softboxes"}},
      {{"printed_silk", "sphere", "overcast"}},
  };
  for (const ErrorScene& scene : error_scenes()) all.push_back({scene});
  return all;
}

Scene scene_of(const PlanScene& s, SceneSettings& settings) {
  settings = settings_of(s.scene, 160, 90);
  settings.camera.zoom = s.zoom;
  settings.environment_ev = s.map_ev;
  if (s.seen_map) settings.backdrop = Backdrop::environment;
  if (s.ground >= 0) {
    settings.stage.ground = GroundSettings();
    settings.stage.ground->kind = GroundKind(s.ground);
  }
  if (s.f_stop > 0) {
    settings.stage.lens = LensSettings();
    settings.stage.lens->f_stop = s.f_stop;
  }
  settings.stage.shutter_deg = s.shutter_deg;
  return sateen_test::scene_of(settings);
}

/// Whether a loss lies above an error beyond what chance does to one of `most_verdicts` losses in twenty such tests:
/// Sidak's 1 - 0.95^(1 / most_verdicts) = 1.7e-4 of a normal deviate lies above 3.58.
constexpr int most_verdicts = 300;
bool beyond_chance(const Interval& loss, double error) {
  const double square = loss.value * loss.value, deviation = (loss.high * loss.high - square) / 1.96;
  return square - 3.58 * deviation > error * error;
}

const Verdict& of(const std::vector<Verdict>& all, Effect effect) {
  for (const Verdict& v : all)
    if (v.effect == effect) return v;
  throw std::runtime_error("no verdict on " + effect_info(effect).name);
}

}  // namespace

// The plan's error is the difference to the picture with every effect, on other pixels with another seed. A plan may
// be beyond the error asked in one scene of twenty; with its allowance of a half none should be. The test fails in
// one of twenty sets of scenes of which every effect lies just at the error asked for, and practically never where
// they lie at half of it, as they should.
TEST(VerifyPlan, TheErrorOfPlansIsBelowTheErrorAsked) {
  const bool all = std::getenv("SATEEN_LONG_TESTS") != nullptr;
  const std::vector<PlanScene> scenes = plan_scenes();
  ASSERT_GE(scenes.size(), 60u);
  const size_t others = scenes.size() - error_scenes().size();
  // Short: a sheer ball, a sheer drape, dim light, a catcher, near threads, and some of the rest.
  const std::vector<size_t> few{0, 5, 11, 18, 26, others + 8, others + 17, others + 24};
  int plans = 0, beyond = 0, ruled_out = 0;
  for (size_t i = 0; i < scenes.size(); ++i) {
    if (!all && std::find(few.begin(), few.end(), i) == few.end()) continue;
    const PlanScene& s = scenes[i];
    SceneSettings settings;
    const Scene scene = scene_of(s, settings);
    const double floor = error_floor_at(double(s.exposure_ev));
    // Scenes that errors are tested on, at three of them.
    const std::vector<double> errors =
        all && i >= others ? std::vector<double>{0.1, 0.03, 0.01} : std::vector<double>{0.03};
    for (const double error : errors) {
      const Plan plan = plan_of(settings, scene, "auto", error, floor);
      double squares = 0;
      for (const Verdict& v : verdicts_of(scene, plan, floor)) {
        squares += v.loss.value * v.loss.value;
        ruled_out += v.tested;
        EXPECT_FALSE(beyond_chance(v.loss, error)) << name_of(s.scene) << ", scene " << i << " at " << error << ": "
                                                   << effect_info(v.effect).name << " " << percent_text(v.loss);
      }
      ++plans;
      beyond += std::sqrt(squares) > error;
    }
  }
  std::printf("%d plans, %d of them beyond the error asked, %d effects were ruled out and tested\n", plans, beyond,
              ruled_out);
  EXPECT_LE(beyond, plans / 20);
  EXPECT_LE(ruled_out, most_verdicts);
  EXPECT_GE(ruled_out, plans / 3) << "a test of nothing";
}

TEST(VerifyPlan, APlanThatLeavesOutWhatIsNeededIsFoundWrong) {
  const SceneSettings settings = settings_of({"ivory_duchess_satin", "skirt", "studio_softboxes"}, 192, 108);
  const Scene scene = scene_of(settings);
  Plan plan = plan_of(settings, scene, "auto", 0.02);
  PlannedEffect& bounces = plan.effects[size_t(Effect::interreflection)];
  bounces.on = false;  // planted
  plan.bounces = 0;
  EXPECT_EQ(int(of(verdicts_of(scene, plan), Effect::interreflection).outcome), int(Verdict::Outcome::wrong));

  plan = plan_of(settings, scene, "auto", 0.02);
  plan.effects[size_t(Effect::self_shadowing)].on = false;  // planted
  EXPECT_EQ(int(of(verdicts_of(scene, plan), Effect::self_shadowing).outcome), int(Verdict::Outcome::wrong));

  plan = plan_of(settings, scene, "-interreflection", 0.02);
  const std::vector<Verdict> asked = verdicts_of(scene, plan);
  EXPECT_EQ(int(of(asked, Effect::interreflection).outcome), int(Verdict::Outcome::right)) << "the user's own wish";
  EXPECT_GT(of(asked, Effect::interreflection).loss.low, 0.02);
}

TEST(Bill, NamesWhatThePictureHasAndWhatItWouldLose) {
  SceneSettings settings = settings_of({"linen_plain", "drape", "studio_softboxes"}, 192, 108);
  settings.backdrop = Backdrop::environment;
  Scene scene = scene_of(settings);
  LightSettings light;
  const Plan plan = plan_of(settings, scene, "+interreflection", 0.02);
  apply_plan(plan, scene, light);
  const ColorManager colors("built-in");
  BillSettings how;
  how.display = settle_display({}, colors);
  const Bill bill = make_bill(scene, plan, light, how, colors, 1, 2);
  std::vector<Effect> billed;
  for (const BillItem& item : bill.items) {
    billed.push_back(item.effect);
    const std::string& name = effect_info(item.effect).name;
    EXPECT_GT(item.loss.low, 0) << name;
    EXPECT_GT(item.visible, 1) << name;
    EXPECT_EQ(item.without.width, bill.picture.width) << name;
    EXPECT_EQ(item.time_share.has_value(), effect_info(item.effect).switchable) << name;
  }
  EXPECT_EQ(billed,
            (std::vector<Effect>{Effect::families, Effect::surface_lobe, Effect::directed_volume, Effect::gaps,
                                 Effect::self_shadowing, Effect::interreflection, Effect::backdrop}));
}

// What the pilot says of bounces by splitting one picture, the bill finds by making two.
TEST(Bill, AgreesWithThePlanAboutInterreflection) {
  const SceneSettings settings = settings_of({"champagne_silk_satin", "drape", "studio_softboxes"}, 192, 108);
  Scene scene = scene_of(settings);
  LightSettings light;
  const Interval planned = *plan_of(settings, scene, "-interreflection", 0.02).of(Effect::interreflection).loss;
  const Plan plan = plan_of(settings, scene, "+interreflection", 0.02);
  apply_plan(plan, scene, light);
  const ColorManager colors("built-in");
  BillSettings how;
  how.display = settle_display({}, colors);
  for (const BillItem& item : make_bill(scene, plan, light, how, colors, 9, 2).items)
    if (item.effect == Effect::interreflection) {
      EXPECT_LT(item.loss.low, planned.high);
      EXPECT_GT(item.loss.high, planned.low);
    }
}
