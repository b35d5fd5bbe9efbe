#include "render/plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "look/find.h"
#include "look/read.h"
#include "pictures.h"
#include "render/candidates.h"
#include "render/loss.h"

using namespace sateen;
using namespace sateen_test;

namespace {

Plan plan_of(const SceneSettings& settings, const Scene& scene, const std::string& effects, double error,
             int threads = 2) {
  PlanSettings how;
  how.switches = read_effects(effects);
  how.error = error;
  how.threads = threads;
  return make_plan(scene, read_look(settings.look, settings.look_overrides), how);
}

SceneSettings with_mesh(SceneSettings settings, const std::string& mesh, int level) {
  settings.mesh = mesh;
  settings.level = level;
  return settings;
}

std::string hash_after(const Plan& plan, const SceneSettings& settings) {
  Scene scene = scene_of(settings);
  RenderSettings how = samples(4);
  apply_plan(plan, scene, how.light);
  Film film(settings.width, settings.height, true);
  render(scene, how, film);
  return film_hash(film);
}

std::string error_of(const std::string& effects) {
  try {
    read_effects(effects);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Loss, IsThatOfWhatIsMissingAndNotOfItsNoise) {
  // 4,096 pixels of value 0.4 that lack 0.02, each replicate with ten times that as noise. A single square of noise
  // would make it 0.25; the interval is wider than three standard errors with a chance of 0.3 %, and the seed is
  // fixed.
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.2);
  std::vector<PixelLoss> pixels(4096);
  for (PixelLoss& pixel : pixels) {
    pixel.value = Vec3d(0.4);
    for (Vec3d& lost : pixel.lost) lost = Vec3d(0.02 + noise(random));
  }
  const Interval loss = picture_loss(pixels, default_error_floor), share = light_share(pixels);
  const double expected = 0.02 / std::sqrt(0.4 * 0.4 + 0.01);
  EXPECT_LE(loss.low, expected);
  EXPECT_GE(loss.high, expected);
  EXPECT_LT(loss.high, 2.5 * expected);
  EXPECT_NEAR(share.value, 0.05, 0.02);
  EXPECT_LE(share.low, 0.05);
  EXPECT_GE(share.high, 0.05);
  EXPECT_LT(share.high - share.low, 0.04);
}

TEST(Loss, OfNothingIsNothing) {
  EXPECT_EQ(picture_loss({}, default_error_floor).high, 0);
  std::vector<PixelLoss> black(10);
  EXPECT_EQ(picture_loss(black, default_error_floor).high, 0);
  EXPECT_EQ(light_share(black).value, 0);
}

TEST(Loss, IsThatOfWhatIsRenderedHoweverMuchNothingIsAroundIt) {
  std::vector<PixelLoss> pixels(100);
  for (PixelLoss& pixel : pixels) {
    pixel.value = Vec3d(0.4);
    for (Vec3d& lost : pixel.lost) lost = Vec3d(0.02);
  }
  const Interval alone = picture_loss(pixels, default_error_floor);
  for (int i = 0; i < 900; ++i) pixels.emplace_back().weight = 0;
  const Interval beside = picture_loss(pixels, default_error_floor);
  EXPECT_NEAR(beside.value, alone.value, 1e-12);
  EXPECT_NEAR(beside.high, alone.high, 1e-12);
}

TEST(Loss, CountsInProportionToLightAndFloor) {
  std::vector<PixelLoss> pixels(10);
  for (size_t i = 0; i < 10; ++i) {
    pixels[i].value = Vec3d(0.1 * double(i));
    for (Vec3d& lost : pixels[i].lost) lost = Vec3d(0.03);
  }
  const double before = picture_loss(pixels, default_error_floor).value;
  for (PixelLoss& pixel : pixels) {
    pixel.value *= 0x1p-6;
    for (Vec3d& lost : pixel.lost) lost *= 0x1p-6;
  }
  EXPECT_EQ(picture_loss(pixels, error_floor_at(6)).value, before);
  EXPECT_LT(picture_loss(pixels, default_error_floor).value, before / 10);
}

TEST(Effects, AreReadFromOneList) {
  const EffectSwitches s = read_effects("none,+interreflection,-back");
  EXPECT_EQ(s.rest, EffectSwitches::Rest::none);
  EXPECT_TRUE(s.named_on(Effect::interreflection));
  EXPECT_TRUE(s.named_off(Effect::back));
  EXPECT_FALSE(s.named_on(Effect::gaps));
}

TEST(Effects, WrongOnesSayWhatWasMeant) {
  EXPECT_NE(error_of("+interreflexion").find("interreflection"), std::string::npos) << error_of("+interreflexion");
  EXPECT_NE(error_of("gaps").find("+gaps"), std::string::npos) << error_of("gaps");
  EXPECT_NE(error_of("-surface-lobe").find("part of the cloth model"), std::string::npos);
  EXPECT_NE(error_of("+gaps,-gaps").find("both"), std::string::npos);
  EXPECT_NE(error_of("auto,,").find("expected"), std::string::npos);
}

TEST(Plan, BrightFoldsNeedInterreflectionAndAFlatSheetDoesNot) {
  const SceneSettings skirt = with_mesh(scene_settings("ivory_duchess_satin", 96, 72), "skirt", 1);
  const Plan folded = plan_of(skirt, scene_of(skirt), "auto", 0.02);
  EXPECT_TRUE(folded.of(Effect::interreflection).on);
  EXPECT_EQ(folded.of(Effect::interreflection).basis, Basis::pilot);
  EXPECT_GE(folded.bounces, 1);

  SceneSettings flat = with_mesh(skirt, SATEEN_SOURCE_DIR "/tests/render/data/flat_sheet.obj", 2);
  const Plan sheet = plan_of(flat, scene_of(flat), "auto", 0.001);
  EXPECT_FALSE(sheet.of(Effect::interreflection).on);
  EXPECT_EQ(sheet.of(Effect::interreflection).basis, Basis::data);
  EXPECT_FALSE(sheet.of(Effect::self_shadowing).on);
  EXPECT_EQ(sheet.bounces, 0);
}

TEST(Plan, GivenBouncesAreKeptAndThePilotLooksOneFurther) {
  const SceneSettings settings = scene_settings("ivory_duchess_satin", 96, 54);
  const Scene scene = scene_of(settings);
  PlanSettings how;
  how.switches.bounces = 1;
  how.switches.bounce_share = 0.5f;
  how.error = 0.02;
  how.threads = 2;
  const Look look = read_look(settings.look);
  const Plan one = make_plan(scene, look, how);
  EXPECT_EQ(one.bounces, 1);
  EXPECT_EQ(one.bounce_share, 0.5f);
  EXPECT_TRUE(one.of(Effect::interreflection).on);
  ASSERT_TRUE(one.of(Effect::interreflection).loss);
  EXPECT_GT(one.of(Effect::interreflection).loss->value, 0);
  how.switches.bounces = 0;
  const Plan none = make_plan(scene, look, how);
  EXPECT_FALSE(none.of(Effect::interreflection).on);
  EXPECT_GT(none.of(Effect::interreflection).share->low, 0);
}

TEST(Plan, ATighterErrorNeverCallsForLess) {
  const SceneSettings settings = scene_settings("crimson_velvet", 96, 54);
  const Scene scene = scene_of(settings);
  int before = 0;
  for (const double error : {1.0, 0.1, 0.03, 0.01, 0.003, 0.0003}) {
    const Plan plan = plan_of(settings, scene, "auto", error);
    EXPECT_GE(plan.bounces, before) << error;
    before = plan.bounces;
  }
  EXPECT_GE(before, 2);
  EXPECT_EQ(plan_of(settings, scene, "auto", 1).bounces, 0);
}

TEST(Plan, IsTheSameOnAnyNumberOfThreads) {
  const SceneSettings settings = scene_settings("linen_plain", 96, 54);
  const Scene scene = scene_of(settings);
  EXPECT_EQ(plan_json(plan_of(settings, scene, "auto", 0.01, 1)),
            plan_json(plan_of(settings, scene, "auto", 0.01, 3)));
}

TEST(Plan, WhatTheLookHasNoneOfIsOffByItsNumbers) {
  SceneSettings settings = scene_settings("velvet", 48, 32);
  settings.look_overrides = {"warp.eta=1", "weft.eta=1",      "warp.k_d=0",
                             "weft.k_d=0", "weft.coverage=0", "warp.coverage=1"};
  const Plan plan = plan_of(settings, scene_of(settings), "auto", 0.1);
  for (const Effect effect : {Effect::surface_lobe, Effect::isotropic_volume, Effect::families, Effect::back,
                              Effect::gaps, Effect::backdrop})
    EXPECT_FALSE(plan.of(effect).on) << effect_info(effect).name;
  for (const Effect effect : {Effect::directed_volume, Effect::tangent_curve, Effect::self_shadowing})
    EXPECT_TRUE(plan.of(effect).on) << effect_info(effect).name;
}

TEST(Plan, AnEffectThatIsNotThereCannotBeSwitchedOn) {
  const SceneSettings settings = scene_settings("emerald_satin", 48, 32);
  const Scene scene = scene_of(settings);
  EXPECT_THROW(plan_of(settings, scene, "+gaps", 0.1), InputError);
  EXPECT_THROW(plan_of(settings, scene, "+backdrop", 0.1), InputError);
  EXPECT_NO_THROW(plan_of(settings, scene, "all", 0.1));
}

TEST(Plan, AnEffectThatIsOffLeavesTheBitsOfASceneThatNeverHadIt) {
  const SceneSettings plain = scene_settings("linen_plain", 64, 48);
  const auto bits = [](const std::string& effects, const SceneSettings& settings) {
    return hash_after(plan_of(settings, scene_of(settings), effects, 0.03), settings);
  };
  SceneSettings seen = plain;
  seen.backdrop = Backdrop::environment;
  EXPECT_EQ(bits("none,+gaps,+self-shadowing,-backdrop", seen), bits("none,+gaps,+self-shadowing", plain));
  EXPECT_NE(bits("none,+gaps,+self-shadowing,+backdrop", seen), bits("none,+gaps,+self-shadowing", plain));

  SceneSettings two_sided = scene_settings("polyester_satin_charmeuse", 64, 48), one_sided = two_sided;
  two_sided.look_overrides = {"back=" + look_path("polyester_satin_charmeuse_back")};
  one_sided.look_overrides = {"back="};
  EXPECT_EQ(bits("none,-back", two_sided), bits("none", one_sided));
  EXPECT_NE(bits("none,+back", two_sided), bits("none", one_sided));
}

TEST(Plan, APartOfTheStageThatIsOffLeavesTheBitsOfASceneThatNeverHadIt) {
  const SceneSettings plain = scene_settings("habotai", 64, 48);
  SceneSettings staged = plain;
  staged.stage.ground = GroundSettings();
  staged.stage.lens = LensSettings();
  staged.stage.shutter_deg = 3;
  const auto bits = [](const std::string& effects, const SceneSettings& settings) {
    return hash_after(plan_of(settings, scene_of(settings), effects, 0.03), settings);
  };
  const std::string whole = bits("all,-interreflection", staged), bare = bits("all,-interreflection", plain);
  EXPECT_NE(whole, bare);
  EXPECT_EQ(bits("all,-interreflection,-ground,-depth-of-field,-motion-blur", staged), bare);
}

TEST(Plan, TexturesAndPatternsCanBeSwitchedOff) {
  const SceneSettings damask = scene_settings("silk_damask", 64, 48);
  const auto bits = [](const std::string& effects, const SceneSettings& settings) {
    return hash_after(plan_of(settings, scene_of(settings), effects, 0.03), settings);
  };
  EXPECT_NE(bits("none", damask), bits("none,+pattern", damask));
  const SceneSettings print = scene_settings("printed_silk", 64, 48);
  EXPECT_NE(bits("none", print), bits("none,+maps", print));
  EXPECT_FALSE(plan_of(print, scene_of(print), "none", 0.03).of(Effect::maps).on);
}

TEST(Plan, WhatIsTooSmallToSeeIsOff) {
  SceneSettings settings = scene_settings("emerald_satin", 64, 48);
  settings.stage.lens = LensSettings();
  settings.stage.lens->f_stop = 900;
  settings.stage.shutter_deg = 0.01f;
  const Plan plan = plan_of(settings, scene_of(settings), "auto", 0.03);
  EXPECT_FALSE(plan.of(Effect::depth_of_field).on) << plan.of(Effect::depth_of_field).reason;
  EXPECT_FALSE(plan.of(Effect::motion_blur).on) << plan.of(Effect::motion_blur).reason;
  settings.stage.lens->f_stop = 1;
  settings.stage.shutter_deg = 10;
  const Plan large = plan_of(settings, scene_of(settings), "auto", 0.03);
  EXPECT_TRUE(large.of(Effect::depth_of_field).on);
  EXPECT_TRUE(large.of(Effect::motion_blur).on);
}

TEST(Plan, SelfShadowingThatGeometryRulesOutIsNotMissed) {
  const auto rendered = [](const SceneSettings& settings, const std::string& effects, bool expected_on) {
    Scene scene = scene_of(settings);
    const Plan plan = plan_of(settings, scene, effects, 0.01);
    EXPECT_EQ(plan.of(Effect::self_shadowing).on, expected_on) << settings.mesh;
    RenderSettings how = samples(16);
    apply_plan(plan, scene, how.light);
    Film film(settings.width, settings.height, true);
    render(scene, how, film);
    return film;
  };
  const SceneSettings flat = with_mesh(scene_settings("champagne_silk_satin", 64, 48),
                                       SATEEN_SOURCE_DIR "/tests/render/data/flat_sheet.obj", 2);
  EXPECT_EQ(film_hash(rendered(flat, "auto", false)), film_hash(rendered(flat, "+self-shadowing", true)));

  // The quads of a sphere are not quite flat: traced, a few rays that graze them are lost to their diagonals, which
  // the sphere itself would not take away.
  const SceneSettings sphere = with_mesh(flat, "sphere", 3);
  const Film off = rendered(sphere, "auto", false), on = rendered(sphere, "+self-shadowing", true);
  double squares = 0;
  for (size_t i = 0; i < off.pixels.size(); ++i) {
    const Color a = pixel_mean(off.pixels[i]), b = pixel_mean(on.pixels[i]);
    for (int c = 0; c < 3; ++c)
      squares += double(a[c] - b[c]) * double(a[c] - b[c]) / (double(b[c]) * double(b[c]) + 0.01);
  }
  EXPECT_LT(std::sqrt(squares / double(3 * off.pixels.size())), 0.003);
}

TEST(Plan, ItsTextIsReadBackAsThePlanThatItWas) {
  const SceneSettings settings = scene_settings("silk_chiffon", 48, 32);
  Scene scene = scene_of(settings);
  for (const char* effects : {"auto", "none,+gaps", "all"}) {
    const Plan plan = plan_of(settings, scene, effects, 0.02);
    EXPECT_EQ(plan_json(read_plan(plan_json(plan))), plan_json(plan)) << effects;
  }
  EXPECT_THROW(read_plan("{}"), InputError);
  EXPECT_THROW(read_plan("{\"error\": 1"), InputError);
}

TEST(Plan, OfAnotherRenderIsHeldToWhatIsAskedForNow) {
  const SceneSettings settings = scene_settings("silk_chiffon", 48, 32);
  const Scene scene = scene_of(settings);
  const Plan before = plan_of(settings, scene, "auto", 0.02);
  const auto held = [&](const std::string& effects, std::optional<int> bounces = {}) {
    EffectSwitches switches = read_effects(effects);
    switches.bounces = bounces;
    Plan plan = before;
    hold_to(switches, plan);
    return plan;
  };
  ASSERT_TRUE(before.of(Effect::gaps).on);
  EXPECT_EQ(plan_json(held("auto")), plan_json(before));
  EXPECT_EQ(plan_json(held("auto,+gaps")), plan_json(before));
  EXPECT_FALSE(held("auto,-gaps").of(Effect::gaps).on);
  EXPECT_FALSE(held("none").of(Effect::self_shadowing).on);
  EXPECT_EQ(held("none").bounces, 0);
  EXPECT_EQ(held("auto", 5).bounces, 5);
  EXPECT_FALSE(held("auto", 0).of(Effect::interreflection).on);
  EXPECT_FALSE(held("all").of(Effect::back).on) << "the look has none";
}

TEST(Plan, DoesNotDependOnTheUnitOfLight) {
  const SceneSettings settings = scene_settings("dupioni", 96, 54);
  const Look look = read_look(settings.look);
  Scene scene = scene_of(settings);
  Image map(scene.environment.width, scene.environment.height, 3);
  for (size_t i = 0; i < scene.environment.texels.size(); ++i)
    for (int c = 0; c < 3; ++c) map.pixels[3 * i + size_t(c)] = scene.environment.texels[i].radiance[c];
  const auto decided = [&](int stops) {
    Image stored = map;
    for (float& value : stored.pixels) value = std::ldexp(value, stops);
    scene.environment = build_environment(stored);
    PlanSettings how;
    how.error_floor = error_floor_at(double(metered_exposure_ev(scene.environment)));
    how.threads = 2;
    const Plan plan = make_plan(scene, look, how);
    std::string text = std::to_string(plan.bounces);
    for (const PlannedEffect& p : plan.effects) text += (p.on ? "\non " : "\noff ") + p.reason;
    LightSettings light;
    return text + "\n" + settle_candidates(scene, {}, light, how.error_floor, 1, 2) +
           candidates_text(light.candidates);
  };
  const std::string usual = decided(0);
  EXPECT_EQ(decided(-6), usual);
  EXPECT_EQ(decided(6), usual);
}

TEST(Plan, TellsTheNumbersThatTexturesGiveAndNotThoseBehindThem) {
  SceneSettings settings = scene_settings("champagne_silk_satin", 48, 32);
  const std::string texture = R"({"texture": ")" SATEEN_SOURCE_DIR R"(/looks/textures/damask_mask.png", )";
  const auto planned = [&](const std::string& eta) {
    settings.look_overrides = {"warp.eta=" + texture + eta + "}", "weft.eta=1"};
    return plan_of(settings, scene_of(settings), "auto", 0.1).of(Effect::surface_lobe);
  };
  const PlannedEffect none = planned(R"("scale": 0, "offset": 1)");
  EXPECT_FALSE(none.on) << none.reason;
  const PlannedEffect some = planned(R"("scale": 0.4, "offset": 1.1)");
  EXPECT_TRUE(some.on);
  EXPECT_EQ(some.reason.find("1.46"), std::string::npos) << some.reason;
  EXPECT_NE(some.reason.find("eta 1.1 to 1.5 in the warp, 1 in the weft"), std::string::npos) << some.reason;
}
