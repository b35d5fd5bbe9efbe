#include <gtest/gtest.h>

#include <algorithm>

#include "look/read.h"
#include "pictures.h"
#include "render/compare.h"
#include "render/plan.h"
#include "scene/near_weave.h"

// What rules an effect out "by the data", each with a scene in which the first thought says impossible and the
// picture says otherwise: switched off by hand it is another picture. Fixed seeds; differences are told from noise by
// the interval of picture_loss (95 %), and what is asserted lies far from it.

using namespace sateen;
using namespace sateen_test;

namespace {

SceneSettings on_sphere(const std::string& look) {
  SceneSettings settings = scene_settings(look, 64, 48);
  settings.mesh = "sphere";
  settings.level = 2;
  return settings;
}

Plan plan_of(const SceneSettings& settings, const Scene& scene, const std::string& effects = "auto",
             double error = 0.03) {
  PlanSettings how;
  how.switches = read_effects(effects);
  how.error = error;
  how.threads = 2;
  return make_plan(scene, read_look(settings.look, settings.look_overrides), how);
}

/// E between the picture as planned and the same with one effect taken out.
Interval lost_without(const Scene& scene, const Plan& plan, Effect effect) {
  PixelGrid grid;
  grid.columns = std::min(32, scene.camera.width);
  grid.rows = std::min(24, scene.camera.height);
  grid.samples = 16;
  Scene with = scene;
  LightSettings light;
  apply_plan(plan, with, light);
  light.bounce_share = 1;
  Scene without = with;
  LightSettings less = light;
  remove_effect(effect, without, less);
  const GridPicture a = trace_picture(with, light, 7, grid, 2), b = trace_picture(without, less, 7, grid, 2);
  return picture_loss(differences(b, a, default_error_floor), default_error_floor);
}

void expect_needed(const Scene& scene, const Plan& plan, Effect effect, double least) {
  EXPECT_TRUE(plan.of(effect).on) << effect_info(effect).name << ": " << plan.of(effect).reason;
  const Interval lost = lost_without(scene, plan, effect);
  EXPECT_GT(lost.low, least) << effect_info(effect).name << " " << percent_text(lost);
}

std::string bits_of(const SceneSettings& settings, Scene scene, const Plan& plan) {
  RenderSettings how = samples(4);
  apply_plan(plan, scene, how.light);
  Film film(settings.width, settings.height, true);
  render(scene, how, film);
  return film_hash(film);
}

/// Small differences, which no pilot of this size tells from noise: where it cannot rule them out they stay.
void expect_on_and_seen(const SceneSettings& settings, const Scene& scene, const Plan& plan, Effect effect) {
  EXPECT_TRUE(plan.of(effect).on) << plan.of(effect).reason;
  Plan naive = plan;
  naive.effects[size_t(effect)].on = false;
  EXPECT_NE(bits_of(settings, scene, plan), bits_of(settings, scene, naive)) << effect_info(effect).name;
}

}  // namespace

TEST(PlanReasons, LightCrossesASheerBodyThoughItsMeshIsConvex) {
  for (const char* look : {"silk_organza", "silk_chiffon"}) {
    const SceneSettings settings = on_sphere(look);
    const Scene scene = scene_of(settings);
    const Plan plan = plan_of(settings, scene);
    expect_needed(scene, plan, Effect::gaps, 0.1);
    expect_needed(scene, plan, Effect::self_shadowing, 0.1);
    expect_needed(scene, plan, Effect::interreflection, 0.02);
    EXPECT_EQ(plan.of(Effect::self_shadowing).basis, Basis::pilot);
  }
}

TEST(PlanReasons, APatternOrABackMayBeSheerWhereTheLookIsNot) {
  SceneSettings settings = on_sphere("champagne_silk_satin");
  settings.look_overrides = {"pattern.look=" + look_path("silk_organza"), "pattern.mask=0.6"};
  const Scene patterned = scene_of(settings);
  const Plan plan = plan_of(settings, patterned);
  EXPECT_NE(plan.of(Effect::gaps).reason.find("40 % of the cloth"), std::string::npos)
      << plan.of(Effect::gaps).reason;
  expect_needed(patterned, plan, Effect::self_shadowing, 0.1);
  expect_needed(patterned, plan, Effect::interreflection, 0.03);
  // Nobody sees the inside of an opaque ball: its sheer back is asked by the pilot, and changes nothing.
  settings.look_overrides = {"back=" + look_path("silk_organza")};
  const Plan lined = plan_of(settings, scene_of(settings));
  EXPECT_EQ(lined.of(Effect::gaps).basis, Basis::pilot);
  EXPECT_FALSE(lined.of(Effect::gaps).on) << lined.of(Effect::gaps).reason;
  EXPECT_FALSE(lined.of(Effect::self_shadowing).on);
}

TEST(PlanReasons, OpaqueClothOnAConvexBodyNeedsNeither) {
  const SceneSettings settings = on_sphere("champagne_silk_satin");
  const Plan plan = plan_of(settings, scene_of(settings));
  EXPECT_EQ(plan.of(Effect::self_shadowing).basis, Basis::data);
  EXPECT_FALSE(plan.of(Effect::self_shadowing).on);
  EXPECT_FALSE(plan.of(Effect::interreflection).on);
  // Without its gaps organza is as opaque.
  const SceneSettings sheer = on_sphere("silk_organza");
  const Plan closed = plan_of(sheer, scene_of(sheer), "auto,-gaps");
  EXPECT_EQ(closed.of(Effect::self_shadowing).basis, Basis::data);
  EXPECT_FALSE(closed.of(Effect::self_shadowing).on);
}

TEST(PlanReasons, AFlatSheetLetsLightPassAndMeetsItNoMore) {
  SceneSettings settings = scene_settings("silk_organza", 64, 48);
  settings.mesh = SATEEN_SOURCE_DIR "/tests/render/data/flat_sheet.obj";
  const Scene scene = scene_of(settings);
  const Plan plan = plan_of(settings, scene);
  EXPECT_EQ(plan.of(Effect::self_shadowing).basis, Basis::pilot);
  EXPECT_FALSE(plan.of(Effect::self_shadowing).on);
  EXPECT_EQ(plan.of(Effect::self_shadowing).loss->high, 0);
  EXPECT_EQ(plan.bounces, 0);
}

TEST(PlanReasons, ACameraInsideAConvexBodySeesItsInside) {
  const SceneSettings settings = on_sphere("champagne_silk_satin");
  Scene scene = scene_of(settings);
  scene.camera.position = (scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f;
  const Plan plan = plan_of(settings, scene);
  EXPECT_TRUE(plan.of(Effect::self_shadowing).on);
  EXPECT_NE(plan.of(Effect::self_shadowing).reason.find("from inside"), std::string::npos);
  Plan naive = plan;
  naive.effects[size_t(Effect::self_shadowing)].on = false;
  EXPECT_NE(bits_of(settings, scene, plan), bits_of(settings, scene, naive));
}

TEST(PlanReasons, AGroundSendsLightBackToAConvexBody) {
  for (const GroundKind kind : {GroundKind::floor, GroundKind::cyclorama}) {
    SceneSettings settings = on_sphere("champagne_silk_satin");
    settings.stage.ground = GroundSettings();
    settings.stage.ground->kind = kind;
    settings.stage.ground->color = Color(0.8f);
    const Scene scene = scene_of(settings);
    const Plan plan = plan_of(settings, scene);
    expect_needed(scene, plan, Effect::interreflection, 0.03);
    EXPECT_FALSE(plan.of(Effect::self_shadowing).on) << "the ground shades by itself";
    // Switched off it sends none.
    EXPECT_FALSE(plan_of(settings, scene, "auto,-ground").of(Effect::interreflection).on);
  }
  SceneSettings caught = on_sphere("champagne_silk_satin");
  caught.stage.ground = GroundSettings();
  caught.stage.ground->kind = GroundKind::catcher;
  EXPECT_FALSE(plan_of(caught, scene_of(caught)).of(Effect::interreflection).on) << "a catcher is not lit";
}

// A sheet that lies askew turns its threads under the light by the whole angle, however few pixels it moves by.
TEST(PlanReasons, ATurnBelowHalfAPixelMovesNarrowHighlights) {
  SceneSettings settings = scene_settings("champagne_silk_satin", 12, 9);
  settings.stage.shutter_deg = 1.8f;
  settings.look_overrides = {"warp.gamma_s_deg=1", "weft.gamma_s_deg=1"};
  const Scene scene = scene_of(settings);
  const Plan loose = plan_of(settings, scene, "auto,-interreflection", 2),
             tight = plan_of(settings, scene, "auto,-interreflection", 0.002);
  EXPECT_NE(loose.of(Effect::motion_blur).reason.find("less than half of one"), std::string::npos)
      << loose.of(Effect::motion_blur).reason;
  EXPECT_FALSE(loose.of(Effect::motion_blur).on);
  expect_on_and_seen(settings, scene, tight, Effect::motion_blur);
}

TEST(PlanReasons, ABlurBelowHalfAPixelSoftensEdges) {
  SceneSettings settings = scene_settings("champagne_silk_satin", 24, 18);
  settings.stage.lens = LensSettings();
  settings.stage.lens->f_stop = 1.4f;
  const Scene scene = scene_of(settings);
  const Plan loose = plan_of(settings, scene, "auto,-interreflection", 2),
             tight = plan_of(settings, scene, "auto,-interreflection", 0.002);
  EXPECT_NE(loose.of(Effect::depth_of_field).reason.find("less than half of one"), std::string::npos)
      << loose.of(Effect::depth_of_field).reason;
  EXPECT_FALSE(loose.of(Effect::depth_of_field).on);
  expect_on_and_seen(settings, scene, tight, Effect::depth_of_field);
}

TEST(PlanReasons, WhatIsFarBehindMovesMoreThanTheObjectWhereTheCameraWalks) {
  SceneSettings settings = on_sphere("champagne_silk_satin");
  settings.backdrop = Backdrop::environment;
  Scene scene = scene_of(settings);
  scene.shutter = shutter_of(*scene.mesh, 0.25, true);
  expect_on_and_seen(settings, scene, plan_of(settings, scene, "auto", 1), Effect::motion_blur);
  scene.backdrop = Backdrop::none;
  EXPECT_FALSE(plan_of(settings, scene, "auto", 1).of(Effect::motion_blur).on) << "the object hardly moves";
}

TEST(PlanReasons, ThreadsThatNobodySeesAreOffToTheBitAndThoseThatAreSeenAreOn) {
  SceneSettings settings = scene_settings("natural_linen", 160, 90);
  settings.mesh = "drape";
  int off = 0, on = 0;
  for (const float zoom : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f, 40.0f}) {
    settings.camera.zoom = zoom;
    const Scene scene = scene_of(settings);
    const Plan plan = plan_of(settings, scene, "auto,-interreflection", 1);
    const Plan forced = plan_of(settings, scene, "auto,-interreflection,+weave", 1);
    const bool same = bits_of(settings, scene, plan) == bits_of(settings, scene, forced);
    if (!plan.of(Effect::weave).on) {
      EXPECT_TRUE(same) << zoom;
    }
    off += !plan.of(Effect::weave).on;
    Plan naive = forced;
    naive.effects[size_t(Effect::weave)].on = false;
    on += plan.of(Effect::weave).on && bits_of(settings, scene, naive) != bits_of(settings, scene, forced);
  }
  EXPECT_GE(off, 2) << "a test of nothing";
  EXPECT_GE(on, 1) << "a test of nothing";
}

TEST(PlanReasons, AThreadThatIsNearButBesideTheFrameIsNotSeen) {
  SceneSettings settings = scene_settings("natural_linen", 640, 360);
  settings.camera.zoom = 8;
  Scene scene = scene_of(settings);
  ASSERT_TRUE(may_show_yarns(scene)) << "the cloth in the middle is near";
  scene.camera.forward = -scene.camera.forward;
  scene.camera.right = -scene.camera.right;
  EXPECT_FALSE(may_show_yarns(scene)) << "the camera looks away from it";
  EXPECT_TRUE(may_show_yarns(scene, true)) << "but will turn";
}

TEST(PlanReasons, GapsStayWhereTheyMatterAndGoWhereTheyDoNot) {
  const SceneSettings dupioni = scene_settings("dupioni", 96, 54);
  const Scene scene = scene_of(dupioni);
  const Plan plan = plan_of(dupioni, scene);
  const PlannedEffect& gaps = plan.of(Effect::gaps);
  EXPECT_FALSE(gaps.on) << gaps.reason;
  EXPECT_EQ(gaps.basis, Basis::pilot);
  EXPECT_GT(gaps.cost, 0.2) << "what it saves";
  ASSERT_TRUE(gaps.share);
  EXPECT_LT(gaps.share->value, 0.01);
  EXPECT_LE(gaps.loss->high, plan_allowance * plan.error);
  EXPECT_TRUE(plan_of(dupioni, scene, "auto", 0.0003).of(Effect::gaps).on) << "ask for less, and it is decided anew";
  EXPECT_TRUE(plan_of(dupioni, scene, "auto,+gaps").of(Effect::gaps).on);
  const SceneSettings organza = scene_settings("silk_organza", 96, 54);
  expect_needed(scene_of(organza), plan_of(organza, scene_of(organza)), Effect::gaps, 0.1);
}

// "Never had gaps": the fabric was compiled with none, and its yarns cover all; the light of the threads stays
// theirs.
TEST(PlanReasons, ClothWhoseGapsAreOffIsThatWhichNeverHadAnyAndGainsNoLight) {
  SceneSettings settings = scene_settings("silk_chiffon", 64, 48);
  const Scene scene = scene_of(settings);
  Scene never = scene;
  never.front.gap = 0;
  close_gaps(never.front.weave);
  never.has_gaps = false;
  Plan plan = plan_of(settings, scene, "auto,-gaps");
  EXPECT_EQ(bits_of(settings, scene, plan), bits_of(settings, never, plan_of(settings, never)));

  // Under the same light from everywhere a ball of it sends what its threads did before: nothing of what passed.
  settings = on_sphere("silk_chiffon");
  Scene ball = scene_of(settings);
  Image white(8, 4, 3);
  for (float& value : white.pixels) value = 1;
  ball.environment = build_environment(white);
  renew_openness(ball);
  const auto threads_light = [&](const std::string& effects) {
    Scene lit = ball;
    RenderSettings how = samples(32);
    apply_plan(plan_of(settings, ball, effects), lit, how.light);
    Film film(settings.width, settings.height, true);
    render(lit, how, film);
    double sum = 0, all = 0;
    for (const LayerPixel& p : film.layers)
      for (int f = 0; f < 2; ++f) sum += double(mean_component(p.surface[f] + p.volume[f]));
    for (const FilmPixel& p : film.pixels) all += double(mean_component(pixel_mean(p))) * 32;
    return std::pair(sum, all);
  };
  const auto [with, whole] = threads_light("none,+gaps,+self-shadowing");
  const auto [closed, beauty] = threads_light("none");
  EXPECT_NEAR(closed, with, 0.01 * with);
  EXPECT_NEAR(beauty, closed, 0.01 * closed) << "nothing is seen behind";
  EXPECT_LT(beauty, whole);
}
