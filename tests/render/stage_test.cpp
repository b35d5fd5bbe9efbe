#include "render/stage.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "render/metadata.h"
#include "render/pictures.h"
#include "render/references.h"
#include "render/turntable.h"

namespace sateen_test {
namespace {

using namespace sateen;

constexpr int width = 60, height = 40;

StageSettings everything() {
  StageSettings stage;
  stage.ground = GroundSettings{};
  stage.lens = LensSettings{};
  stage.lens->f_stop = 0.5f;
  stage.shutter_deg = 20;
  return stage;
}

SceneSettings staged(const StageSettings& stage) {
  SceneSettings settings = scene_settings("linen_plain", width, height);
  settings.stage = stage;
  settings.backdrop = Backdrop::blurred;
  return settings;
}

std::string rendered(const Scene& scene, int threads = 2) {
  RenderSettings settings = samples(6);
  settings.light.bounces = 2;
  settings.threads = threads;
  Film film(width, height, true);
  EXPECT_EQ(render(scene, settings, film).rays.non_finite, 0);
  return film_hash(film);
}

TEST(Stage, HasTheSameBitsForAnyNumberOfThreads) {
  const Scene scene = scene_of(staged(everything()));
  const std::string one = rendered(scene, 1);
  for (const int threads : {2, 5}) EXPECT_EQ(rendered(scene, threads), one);
}

// A planner clears a member: the bits are those of a scene that never had it.
TEST(Stage, ThatIsClearedHasTheBitsOfAScenesThatNeverHadIt) {
  const std::string plain = rendered(scene_of(staged({})));
  Scene scene = scene_of(staged(everything()));
  EXPECT_NE(rendered(scene), plain);
  scene.ground.reset();
  EXPECT_NE(rendered(scene), plain);
  scene.lens.reset();
  EXPECT_NE(rendered(scene), plain);
  scene.shutter.reset();
  EXPECT_EQ(rendered(scene), plain);
}

TEST(Stage, DecidesTheSamplesAndSaysSo) {
  PictureJob job;
  SceneReport report;
  const auto value = [&](const std::string& name) {
    for (const Fact& fact : sampling_facts(job, report))
      if (fact.name == name) return fact.value;
    return std::string("nothing");
  };
  EXPECT_EQ(value("ground"), "none");
  EXPECT_EQ(value("lens"), "none");
  EXPECT_EQ(value("shutter"), "0");
  job.scene.stage = everything();
  job.scene.stage.lens->focus = 2.5f;
  job.scene.backdrop = Backdrop::blurred;
  EXPECT_EQ(value("ground"), "floor, height auto, colour 0.4 0.4 0.4");
  EXPECT_EQ(value("lens"), "f/0.5, focus 2.5 m, 0 blades, 1 m a unit");
  EXPECT_EQ(value("shutter"), "20");
  EXPECT_EQ(value("backdrop"), "blurred 20");
}

// The cloth under a catcher is the cloth without one, bit for bit; beside it the shadow is in the alpha alone.
TEST(Catcher, LeavesTheClothAsItIs) {
  SceneSettings settings = scene_settings("emerald_satin", width, height);
  const Scene plain = scene_of(settings);
  settings.stage.ground = GroundSettings{GroundKind::catcher, {}, Color(0.4f)};
  const Scene caught = scene_of(settings);
  Film without(width, height, false), with(width, height, false);
  render(plain, samples(16), without);
  render(caught, samples(16), with);
  int shadowed = 0, clear = 0;
  for (size_t i = 0; i < with.pixels.size(); ++i) {
    EXPECT_EQ(pixel_mean(with.pixels[i]), pixel_mean(without.pixels[i]));
    if (pixel_coverage(without.pixels[i]) > 0) continue;
    EXPECT_GE(pixel_coverage(with.pixels[i]), 0);
    ++(pixel_coverage(with.pixels[i]) > 0.05 ? shadowed : clear);
  }
  EXPECT_GT(shadowed, 30);
  EXPECT_GT(clear, 300);
}

TEST(TurningStage, FollowsTheCameraAndBlursWhatTurns) {
  SceneSettings settings = staged(everything());
  settings.stage.ground->kind = GroundKind::cyclorama;
  Scene scene = scene_of(settings);
  for (const Turn turn : {Turn::object, Turn::camera}) {
    TurntableStart start = start_turntable(scene, settings.camera, turn);
    set_turning_stage(scene, start, settings.stage);
    EXPECT_EQ(scene.shutter->object_angle == 0, turn == Turn::camera);
    EXPECT_EQ(scene.shutter->camera_angle == 0, turn == Turn::object);
    for (const double angle : {0.0, 77.0, -140.0}) {
      pose_turntable(scene, start, angle);
      EXPECT_NEAR(dot(scene.ground->away, normalize(Vec3(scene.camera.forward.x, 0, scene.camera.forward.z))), 1,
                  1e-5);
    }
  }
}

TEST(References, MeasureAConstantLightAsItIs) {
  Image map(32, 16, 3);
  for (float& v : map.pixels) v = 2;
  const Environment environment = build_environment(std::move(map));
  const ColorManager colors("built-in");
  const Camera camera = frame_points({Vec3(-1), Vec3(1)}, {}, 320, 180);
  const References r = make_references(environment, camera, colors, settle_display({}, colors), 0, 2);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(r.ball_mean[c], 0.36f, 1e-3);
    EXPECT_NEAR(r.ball_brightest[c], 0.36f, 1e-3);
  }
  double before = 10;
  for (const References::Patch& patch : r.greys) {
    EXPECT_NEAR(patch.light.x, 2 * patch.reflectance, 2e-3);
    EXPECT_LT(patch.code.y, before);
    before = double(patch.code.y);
  }
  // A mirror under constant light shows the light; outside the references there is nothing.
  int bright = 0, covered = 0;
  for (size_t i = 0; i < r.overlay.pixels.size(); i += 4) {
    EXPECT_LE(r.overlay.pixels[i], 2 * r.overlay.pixels[i + 3] + 1e-4f);
    bright += r.overlay.pixels[i] > 1.99f;
    covered += r.overlay.pixels[i + 3] > 0;
  }
  EXPECT_NEAR(bright, M_PI * std::pow(0.068 * 180, 2), 60);
  EXPECT_LT(covered, 320 * 180 / 20);
  EXPECT_EQ(r.overlay.pixels[3], 0);
  EXPECT_THROW(make_references(environment, frame_points({Vec3(-1), Vec3(1)}, {}, 64, 36), colors,
                               settle_display({}, colors), 0, 2),
               InputError);
}

}  // namespace
}  // namespace sateen_test
