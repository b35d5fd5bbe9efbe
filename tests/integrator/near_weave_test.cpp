#include "scene/near_weave.h"

#include <gtest/gtest.h>

#include "integrator/made_scenes.h"
#include "integrator/path.h"
#include "scene/mapped_looks.h"

// Cloth seen from so near that its threads show: a flat swatch in front of a camera that comes nearer.

namespace sateen_test {
namespace {

using namespace sateen;

constexpr int side = 48;  // pixels

/// A square of `repeats` repeats of the weave fills the picture. One UV unit is a metre.
Scene swatch_of(CompiledSide cloth, double repeats) {
  Mesh mesh = floor_quad(10);
  for (size_t i = 0; i < mesh.uvs.size(); ++i) mesh.uvs[i] *= 10;
  for (Vec3& v : mesh.dpdu) v *= 0.1f;
  for (Vec3& v : mesh.dpdv) v *= 0.1f;
  Scene scene = make_scene(std::move(mesh), Fabric(), constant_map(1));
  set_sides(scene, std::move(cloth), std::nullopt);
  const float extent = float(repeats * scene.front.weave.ends * scene.front.weave.warp_spacing);
  scene.camera = distant_camera(Vec3(0), Vec3(0, 1, 0), extent, side, side);
  // A distant camera's directions lose their digits in so small a picture: a metre is far enough.
  scene.camera.position = Vec3(0, 1, 0);
  scene.camera.tan_x = scene.camera.tan_y = extent / 2;
  scene.near_weave_pixel = near_weave_pixel(scene);
  return scene;
}

Scene swatch_of(const std::string& name, const std::string& draft, double repeats) {
  Look look = shipped_look(name);
  look.weave.draft = {draft};
  look.weave.warp_per_cm = look.weave.weft_per_cm = 20;
  look.weave.irregularity = look.weave.slubs = 0;
  look.back.clear();
  CompiledSide cloth;
  cloth.fabric = fabric_of(look);
  return swatch_of(std::move(cloth), repeats);
}

struct Seen {
  std::vector<double> pixels;  ///< means over the samples
  double mean = 0, alpha = 0;
  int non_finite = 0;
};
Seen look_at(const Scene& scene, int samples) {
  static PathScratch scratch;
  scratch.counts = {};
  Seen seen;
  seen.pixels.resize(side * side);
  std::vector<SampleId> ids;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int k = 0; k < samples; ++k) ids.push_back({x, y, k % 4, std::uint32_t(k / 4)});
  std::array<CameraSample, batch_size> out;
  for (size_t i = 0; i < ids.size(); i += batch_size) {
    const size_t n = std::min(ids.size() - i, size_t(batch_size));
    trace_samples(scene, {Strategy::table, 1, 0}, 7, {&ids[i], n}, scratch, out.data());
    for (size_t k = 0; k < n; ++k) {
      const SampleId& id = ids[i + k];
      const double light = double(mean_component(out[k].total()));
      seen.pixels[size_t(id.y * side + id.x)] += light / samples;
      seen.mean += light / samples / (side * side);
      seen.alpha += double(out[k].alpha) / samples / (side * side);
    }
  }
  seen.non_finite = int(scratch.counts.non_finite);
  return seen;
}

/// Largest deviation of the means of the picture's nine blocks from their mean, relative.
double unevenness(const Seen& seen) {
  double worst = 0;
  constexpr int third = side / 3;
  for (int block = 0; block < 9; ++block) {
    double sum = 0;
    for (int y = 0; y < third; ++y)
      for (int x = 0; x < third; ++x)
        sum += seen.pixels[size_t((block / 3 * third + y) * side + block % 3 * third + x)];
    worst = std::max(worst, std::abs(sum / (third * third) / seen.mean - 1));
  }
  return worst;
}

TEST(NearWeave, KeepsTheSwatchAsBrightOnTheWholeWayFromFarToNear) {
  for (const auto& [look, draft] : {std::pair("champagne_silk_satin", "satin 5/2"),
                                    {"shot_taffeta", "plain"},
                                    {"silk_crepe_de_chine", "twill 3/1"},
                                    {"linen_plain", "plain"}}) {
    const int threads = std::string(draft) == "plain" ? 2 : std::string(draft) == "twill 3/1" ? 4 : 5;
    double before = 0, far = 0;
    bool near = false;
    // Twelve steps, from half a pixel a yarn to the whole picture for a repeat or two.
    for (int step = 0; step < 12; ++step) {
      const double pixels_a_yarn = 0.5 * std::pow(2, step * 0.4);
      const double repeats = std::max(1.0, std::round(side / pixels_a_yarn / threads));
      const Scene scene = swatch_of(look, draft, repeats);
      const Seen seen = look_at(scene, 64);
      EXPECT_EQ(seen.non_finite, 0);
      if (step == 0) before = far = seen.mean;
      // 147,456 samples of a deviation below their mean: noise of 0.2 %, and less since they are well spread.
      EXPECT_NEAR(seen.mean / before, 1, 0.01) << look << " " << pixels_a_yarn;
      EXPECT_NEAR(seen.mean / far, 1, 0.012) << look << " " << pixels_a_yarn;
      EXPECT_NEAR(seen.alpha, 1 - double(scene.front.gap), 0.004) << look << " " << pixels_a_yarn;
      before = seen.mean;
      near = near || pixels_a_yarn > 3;
      // Nothing beats with the pixels: while a third of the picture holds many repeats its parts are alike.
      if (side / 3 / pixels_a_yarn / threads >= 4) {
        EXPECT_LT(unevenness(seen), 0.015) << look << " " << pixels_a_yarn;
      }
    }
    EXPECT_TRUE(near);
  }
}

TEST(NearWeave, ShowsPartsThatDifferWhereYarnsAreWide) {
  const Scene scene = swatch_of("shot_taffeta", "plain", 2);
  const Seen seen = look_at(scene, 32);
  double squares = 0;
  for (const double p : seen.pixels) squares += (p / seen.mean - 1) * (p / seen.mean - 1);
  EXPECT_GT(std::sqrt(squares / (side * side)), 0.1);
}

TEST(NearWeave, KeepsTheBrightnessAndTheGapsThatATextureOfCoverageAsksFor) {
  const MappedLooks made;
  // At the swatch's middle, where the clamped texture's right side goes on, 0.2; its mean is 0.5.
  made.texture("halves.exr", 64, 1, [](int x, int) { return Color(x < 32 ? 0.8f : 0.2f); });
  for (const char* draft : {"plain", "satin 5/2"}) {
    CompiledSide cloth = made.compiled(fmt::format(
        R"({{"warp": {{"coverage": {{"texture": "halves.exr", "wrap": "clamp", "scale": 0.8}}, "A": [0.8, 0.6, 0.1]}},
             "weft": {{"coverage": 0.3, "A": [0.1, 0.3, 0.6]}},
             "weave": {{"draft": "{}", "warp_per_cm": 20, "weft_per_cm": 20}}}})",
        draft));
    Scene scene = swatch_of(std::move(cloth), 4);
    const Seen near = look_at(scene, 64);
    scene.near_weave_pixel = 0;
    const Seen far = look_at(scene, 64);
    // The bars of the swatches above.
    EXPECT_NEAR(near.mean / far.mean, 1, 0.012) << draft;
    EXPECT_NEAR(far.alpha, 0.16 + 0.3, 1e-5) << draft;
    EXPECT_NEAR(near.alpha, far.alpha, 0.004) << draft;
    EXPECT_NE(near.pixels, far.pixels);
  }
}

TEST(NearWeave, OfClosedGapsIsAsBrightAsTheFarPictureAndHasNoHoles) {
  Scene scene = swatch_of("linen_plain", "plain", 4);
  ASSERT_GT(scene.front.gap, 0.05f);
  // As --effects -gaps leaves a scene.
  scene.front.gap = 0;
  scene.has_gaps = false;
  close_gaps(scene.front.weave);
  const Seen near = look_at(scene, 64);
  scene.near_weave_pixel = 0;
  const Seen far = look_at(scene, 64);
  EXPECT_NEAR(near.alpha, 1, 1e-9);
  EXPECT_NEAR(near.mean / far.mean, 1, 0.012);
  // No hole is left: a pixel in one would be black.
  EXPECT_GT(*std::min_element(near.pixels.begin(), near.pixels.end()), 0.15 * near.mean);
}

TEST(NearWeave, IsOffWhereTheWeaveIsTakenOutOfTheFabric) {
  Scene scene = swatch_of("shot_taffeta", "plain", 2);
  const Seen near = look_at(scene, 4);
  scene.front.weave = {};
  const Seen off = look_at(scene, 4);
  scene.near_weave_pixel = 0;
  EXPECT_EQ(look_at(scene, 4).pixels, off.pixels);
  EXPECT_NE(near.pixels, off.pixels);
}

TEST(NearWeave, GivesASampleTheSameBitsInAnyBatch) {
  Scene scene = swatch_of("linen_plain", "plain", 3);
  scene.backdrop = Backdrop::plain;
  scene.backdrop_color = Color(0.1f, 0.2f, 0.3f);
  PathScratch scratch;
  const LightSettings light{Strategy::mis_compensated, 8, 2};
  std::vector<SampleId> ids;
  for (int k = 0; k < batch_size; ++k) ids.push_back({k % side, k / 3, 0, std::uint32_t(k)});
  std::array<CameraSample, batch_size> together;
  trace_samples(scene, light, 3, ids, scratch, together.data());
  for (size_t k = 0; k < ids.size(); ++k) {
    const CameraSample alone = trace_sample(scene, light, 3, ids[k], scratch);
    EXPECT_EQ(alone.direct.total(), together[k].direct.total());
    EXPECT_EQ(alone.alpha, together[k].alpha);
    EXPECT_EQ(alone.backdrop, together[k].backdrop);
  }
}

}  // namespace
}  // namespace sateen_test
