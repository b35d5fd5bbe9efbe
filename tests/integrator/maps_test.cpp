#include <gtest/gtest.h>

#include <cstring>

#include "integrator/known_answers.h"
#include "integrator/picture_batches.h"
#include "scene/mapped_looks.h"

// Looks with textures and patterns through the whole of light transport. Statistical bounds: one false alarm in a
// thousand runs of each test, seeds fixed.

namespace sateen_test {
namespace {

using namespace sateen;

double bound(double tests) {
  return sidak_deviate(1e-3, tests);
}

const MappedLooks& made() {
  static const MappedLooks looks;
  return looks;
}

const char* const plain_threads =
    R"("warp": {"gamma_s_deg": 9, "gamma_v_deg": 18, "coverage": 0.6, "A": [0.3, 0.2, 0.1], "offsets_deg": [-25, 10]},
       "weft": {"gamma_s_deg": 14, "gamma_v_deg": 30, "coverage": 0.3, "A": [0.2, 0.3, 0.4], "offsets_deg": [-10, 30]})";

Scene with_side(Mesh mesh, CompiledSide side, Environment environment) {
  Scene scene = make_scene(std::move(mesh), Fabric(), std::move(environment));
  set_sides(scene, std::move(side), std::nullopt);
  return scene;
}

Environment soft_map() {
  return map_of(
      16, 8, [](int x, int y) { return Color(0.2f + 0.1f * float((3 * x + 5 * y) % 7), 0.5f, 1.0f / float(1 + y)); });
}

/// The drape from the front, small.
Scene draped(CompiledSide side) {
  Scene scene = with_side(shape("drape", 0), std::move(side), soft_map());
  CameraSettings camera;
  camera.azimuth_deg = 20;
  scene.camera = frame_points(scene.mesh->positions, camera, 24, 16);
  return scene;
}

std::vector<CameraSample> trace_all(const Scene& scene, const LightSettings& light, int samples) {
  const auto scratch = std::make_unique<PathScratch>();
  std::vector<CameraSample> out;
  for (int y = 0; y < scene.camera.height; ++y)
    for (int x = 0; x < scene.camera.width; ++x)
      for (int k = 0; k < samples; ++k)
        out.push_back(trace_sample(scene, light, 5, {x, y, k % 4, std::uint32_t(k / 4)}, *scratch));
  EXPECT_EQ(scratch->counts.non_finite, 0);
  return out;
}

TEST(Maps, OfOneValueShowWhatTheValueShows) {
  // Samplers are compiled from the means, so every sample is the same but for rounding.
  made().texture("one.exr", 4, 4, [](int, int) { return Color(0.25f); });
  const std::pair<const char*, const char*> pairs[] = {
      {R"({"warp": {"k_d": {"texture": "one.exr"}}})", R"({"warp": {"k_d": 0.25}})"},
      {R"({"warp": {"coverage": {"texture": "one.exr"}}})", R"({"warp": {"coverage": 0.25}})"},
      {R"({"weft": {"eta": {"texture": "one.exr", "offset": 1}}})", R"({"weft": {"eta": 1.25}})"},
      {R"({"warp": {"gamma_s_deg": {"texture": "one.exr", "scale": 40}}})", R"({"warp": {"gamma_s_deg": 10}})"},
      {R"({"weft": {"gamma_v_deg": {"texture": "one.exr", "scale": 80}}})", R"({"weft": {"gamma_v_deg": 20}})"},
      {R"({"warp_angle_deg": {"texture": "one.exr", "scale": 120}})", R"({"warp_angle_deg": 30})"},
      {R"({"color": {"texture": "one.exr", "space": "lin_rec709", "scale": 2}})", R"({"color": [0.5, 0.5, 0.5]})"}};
  for (const auto& [mapped, plain] : pairs) {
    const Scene a = draped(made().compiled(mapped)), b = draped(made().compiled(plain));
    EXPECT_TRUE(a.has_maps);
    EXPECT_FALSE(b.has_maps);
    for (const Strategy strategy : {Strategy::mis_compensated, Strategy::resampled}) {
      const LightSettings light{strategy, 4, 1};
      const std::vector<CameraSample> x = trace_all(a, light, 2), y = trace_all(b, light, 2);
      double sum = 0, off = 0;
      for (size_t i = 0; i < x.size(); ++i) {
        ASSERT_EQ(x[i].hit, y[i].hit);
        EXPECT_NEAR(x[i].alpha, y[i].alpha, 1e-6f);
        for (int c = 0; c < 3; ++c) {
          sum += double(y[i].total()[c]);
          off += std::abs(double(x[i].total()[c]) - double(y[i].total()[c]));
        }
      }
      // Half floats keep a colour to 5e-4; a table cell may fall to the other side here and there.
      EXPECT_LT(off / sum, 5e-4) << mapped;
      EXPECT_GT(sum, 0);
    }
  }
}

TEST(Maps, GiveEachPixelTheReflectanceOfItsOwnValues) {
  // Two halves of the floor; each must show what a look of its values shows under constant light: energy is kept
  // although the sampler is that of the mean.
  made().texture("steps.exr", 64, 1, [](int x, int) { return Color(x < 32 ? 0.1f : 0.9f); });
  const std::string mapped = R"({"color_space": "acescg",
    "warp": {"gamma_s_deg": {"texture": "steps.exr", "scale": 20, "wrap": "clamp"}, "gamma_v_deg": 20,
             "k_d": {"texture": "steps.exr", "wrap": "clamp"}, "coverage": {"texture": "steps.exr", "scale": 0.5, "wrap": "clamp"},
             "offsets_deg": [-25, 10], "A": [0.3, 0.2, 0.1]},
    "weft": {"coverage": 0.4, "eta": {"texture": "steps.exr", "offset": 1, "wrap": "clamp"}, "offsets_deg": [-10, 30],
             "A": {"texture": "steps.exr", "space": "acescg", "scale": 0.4, "wrap": "clamp"}}})";
  Scene scene = with_side(floor_quad(), made().compiled(mapped), constant_map());
  const Vec3 view = normalize(Vec3(0.5f, 1, 0.3f));
  for (const double v : {0.1, 0.9}) {
    const std::string text = fmt::format(R"({{"color_space": "acescg",
      "warp": {{"gamma_s_deg": {}, "gamma_v_deg": 20, "k_d": {}, "coverage": {}, "offsets_deg": [-25, 10], "A": [0.3, 0.2, 0.1]}},
      "weft": {{"coverage": 0.4, "eta": {}, "offsets_deg": [-10, 30], "A": [{}, {}, {}]}}}})",
                                         20 * v, v, 0.5 * v, 1 + v, 0.4 * v, 0.4 * v, 0.4 * v);
    const Fabric fabric = made().compiled(text, false).fabric;
    const Color expected = reflectance(fabric, Vec3(view.x, -view.z, view.y));
    // A small window in the middle of that half.
    scene.camera = distant_camera(Vec3(v < 0.5 ? -0.25f : 0.25f, 0, 0), view, 0.05f);
    for (const NamedSettings& settings : all_settings()) {
      const Estimate got = estimate(scene, settings.light, 512);
      expect_value(got, expected, bound(2 * 10 * 3), 1e-3, settings.name);
      EXPECT_NEAR(got.alpha, 1 - fabric.gap, 1e-5);
    }
  }
}

TEST(Maps, OfStripesShowTheirMeanFromAfar) {
  // The reflectance is linear in A: whatever is filtered and whatever is sampled, the mean is that of both looks.
  made().texture("stripes.exr", 8, 1, [](int x, int) { return x % 2 ? Color(0.6f, 0.1f, 0) : Color(0, 0.3f, 0.8f); });
  const CompiledSide side = made().compiled(
      R"({"color_space": "acescg", "warp": {"A": {"texture": "stripes.exr", "space": "acescg", "repeat": [3, 1]}},
          "weft": {"A": [0.2, 0.2, 0.2]}})");
  Scene scene = with_side(floor_quad(), side, constant_map());
  const Fabric mean =
      made()
          .compiled(R"({"color_space": "acescg", "warp": {"A": [0.3, 0.2, 0.4]}, "weft": {"A": [0.2, 0.2, 0.2]}})",
                    false)
          .fabric;
  // By filtering alone, of an area wider than the cloth.
  const PointValues values = values_at(scene.front_maps->own, Vec2(0.1f, 0.1f), {Vec2(4, 0), Vec2(0, 4)});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(values.A[0][c], mean.A[0][c], 1e-3f);
  // And by sampling: pixels over whole periods, from stripes that stand out to stripes that run together. The pixels'
  // filter spills over the ends by less than a hundredth.
  const Color straight = reflectance(mean, Vec3(0, 0, 1));
  for (const int pixels : {256, 24}) {
    scene.camera = distant_camera(Vec3(0), Vec3(0, 1, 0), 2.0f / 3, pixels, 1);
    scene.camera.tan_y *= 0.1f;
    Vec3d sum(0);
    const std::vector<CameraSample> all = trace_all(scene, {Strategy::table, 4, 0}, 4096 / pixels);
    for (const CameraSample& s : all) sum += Vec3d(s.total()) / double(all.size());
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], straight[c], 0.015 * straight[c]) << pixels;
  }
}

/// A pattern of a look that is turned and of other threads.
std::string pattern_of(const std::string& mask) {
  std::ofstream(made().folder.path / "woven.json")
      << R"({"warp_angle_deg": 70, "warp": {"gamma_s_deg": 20, "coverage": 0.4, "A": [0.1, 0.5, 0.2], "offsets_deg": [0, 40]},
             "weft": {"coverage": 0.2, "A": [0.5, 0.1, 0.1]}})";
  return fmt::format("{{{}, \"pattern\": {{\"mask\": {}, \"look\": \"woven.json\"}}}}", plain_threads, mask);
}

TEST(Pattern, BlendsBothLooksInTheSharesOfTheMask) {
  const Vec3 view = normalize(Vec3(0.5f, 1, 0.3f));
  pattern_of("0.5");  // writes the look
  const Fabric ground = made().compiled(fmt::format("{{{}}}", plain_threads), false).fabric;
  FabricParts parts;
  parts.table = false;
  const Fabric woven =
      compile_side(read_look((made().folder.path / "woven.json").string()), made().colors, parts).fabric;
  const float turn = woven.warp_angle;
  const Vec3 local(view.x, -view.z, view.y);
  const Vec3 turned(local.x * std::cos(turn) + local.y * std::sin(turn),
                    local.y * std::cos(turn) - local.x * std::sin(turn), local.z);
  const Color a = reflectance(ground, local), b = reflectance(woven, turned);
  for (const double share : {0.0, 0.3, 1.0}) {
    Scene scene = with_side(floor_quad(), made().compiled(pattern_of(fmt::format("{}", share))), constant_map());
    scene.camera = distant_camera(Vec3(0), view, 0.1f);
    for (const NamedSettings& settings : all_settings()) {
      const Estimate got = estimate(scene, settings.light, 512);
      expect_value(got, a * float(1 - share) + b * float(share), bound(3 * 10 * 3), 1e-3, settings.name);
      EXPECT_NEAR(got.alpha, 1 - (ground.gap * (1 - share) + woven.gap * share), share == 0.3 ? 2e-3 : 1e-5);
    }
  }
}

TEST(Pattern, ShowsEachLookWhereTheMaskSaysSo) {
  made().texture("half.exr", 64, 1, [](int x, int) { return Color(x < 32 ? 0.0f : 1.0f); });
  Scene scene = with_side(floor_quad(), made().compiled(pattern_of(R"({"texture": "half.exr", "wrap": "clamp"})")),
                          constant_map());
  for (const bool right : {false, true}) {
    scene.camera = distant_camera(Vec3(right ? 0.25f : -0.25f, 0, 0), Vec3(0, 1, 0), 0.1f);
    const auto scratch = std::make_unique<PathScratch>();
    for (int k = 0; k < 64; ++k) {
      const CameraSample s = trace_sample(scene, {}, 3, {0, 0, k % 4, std::uint32_t(k / 4)}, *scratch);
      EXPECT_NEAR(s.warp.x, right ? std::cos(radians(70)) : 1, 1e-5f);
      EXPECT_NEAR(s.alpha, right ? 0.6f : 0.9f, 1e-6f);
    }
  }
}

TEST(MappedGaps, ShadowByTheirShareAndShowWhatIsBehind) {
  made().texture("sheer.exr", 64, 1, [](int x, int) { return Color(x < 32 ? 0.1f : 0.4f); });
  // A floor under a roof: both of the same mapped cloth, both lit and seen where its coverage is .1 + .3.
  const CompiledSide side = made().compiled(
      R"({"warp": {"coverage": {"texture": "sheer.exr", "wrap": "clamp"}}, "weft": {"coverage": 0.3}})");
  for (const bool right : {false, true}) {
    const float gap = right ? 0.3f : 0.6f;
    Mesh mesh = floor_quad();
    add_quad(mesh, Vec3(0, -0.1f, 0), Vec3(1, 0, 0), Vec3(0, 0, -1));
    Scene scene = with_side(std::move(mesh), side, constant_map());
    EXPECT_TRUE(scene.has_gaps);
    scene.camera = distant_camera(Vec3(right ? 0.25f : -0.25f, 0, 0), Vec3(0, 1, 0), 0.05f);
    EXPECT_NEAR(estimate(scene, {Strategy::mis, 8, 0}, 4).alpha, 1 - gap * gap, 1e-5);
    scene.backdrop = Backdrop::plain;
    scene.backdrop_color = Color(3);
    EXPECT_NEAR(estimate(scene, {Strategy::mis, 8, 0}, 4).backdrop[1], 3 * gap * gap, 1e-5);
  }
  // A sun straight above, a camera between roof and floor.
  const Sun sun{16, 8, 9, 0, 20};
  for (const bool right : {false, true}) {
    const float gap = right ? 0.3f : 0.6f;
    double light[2];
    for (int roofs = 0; roofs < 2; ++roofs) {
      Mesh mesh = floor_quad();
      // So wide that all of the sun's rays to the point meet its half of the texture.
      for (int k = 0; k < roofs; ++k)
        add_quad(mesh, Vec3(right ? -40.0f : 40.0f, 0.2f, 0), Vec3(200, 0, 0), Vec3(0, 0, -200));
      Scene scene = with_side(std::move(mesh), side, sun.map());
      scene.camera = distant_camera(Vec3(right ? 0.25f : -0.25f, 0, 0), Vec3(0.4f, 0.15f, 0), 1);
      scene.camera.position = Vec3((right ? 0.25f : -0.25f) + 0.04f, 0.015f, 0);
      scene.camera.tan_x = scene.camera.tan_y = 1e-5f;
      light[roofs] = estimate(scene, {Strategy::environment, 8, 0}, 64).channel[1].mean;
    }
    // The same samples: the ratio is exact. The roof's own texture there is that of the other half.
    EXPECT_NEAR(light[1] / light[0], right ? 0.3f : 0.6f, 1e-4) << gap;
  }
}

TEST(MappedGaps, LoseNothingUnderConstantLight) {
  // What a sheer cloth reflects and what it lets pass, before the same light: R + gap.
  made().texture("sheer.exr", 64, 1, [](int x, int) { return Color(x < 32 ? 0.1f : 0.4f); });
  Scene scene = with_side(
      floor_quad(),
      made().compiled(
          R"({"warp": {"coverage": {"texture": "sheer.exr", "wrap": "clamp"}}, "weft": {"coverage": 0.3}})"),
      constant_map());
  scene.backdrop = Backdrop::environment;
  const Vec3 view = normalize(Vec3(0.3f, 1, 0.2f));
  scene.camera = distant_camera(Vec3(0.25f, 0, 0), view, 0.05f);
  const Fabric there = made().compiled(R"({"warp": {"coverage": 0.4}, "weft": {"coverage": 0.3}})", false).fabric;
  const Color expected = reflectance(there, Vec3(view.x, -view.z, view.y)) + Color(there.gap);
  for (const NamedSettings& settings : all_settings(2))
    expect_value(estimate(scene, settings.light, 256), expected, bound(30), 1e-3, settings.name);
}

TEST(Maps, LetAllStrategiesAgreeOnADrape) {
  made().texture("patches.exr", 16, 16,
                 [](int x, int y) { return Color(0.1f + 0.8f * float((x / 4 + y / 4) % 2), 0.5f, 0.3f); });
  const Scene scene = draped(made().compiled(
      R"({"warp": {"A": {"texture": "patches.exr", "space": "lin_rec709", "scale": 0.4, "repeat": [5, 5]}, "coverage": 0.5,
                   "gamma_s_deg": {"texture": "patches.exr", "scale": 20, "repeat": [5, 5]}, "offsets_deg": [-25, 25]},
          "weft": {"coverage": {"texture": "patches.exr", "scale": 0.4}, "k_d": {"texture": "patches.exr"}},
          "warp_angle_deg": {"texture": "patches.exr", "scale": 90}})"));
  const std::vector<NamedSettings> all = all_settings(1);
  const PictureBatches reference = render_batches(scene, {Strategy::mis_compensated, 8, 1}, 16, 12, 1000);
  const double limit = bound(double(all.size()) * comparisons(reference, Scale::block));
  std::uint32_t seed = 1000;
  for (const NamedSettings& settings : all) {
    const PictureBatches picture = render_batches(scene, settings.light, 16, 8, seed += 1000);
    const Disagreement worst = largest_deviate(picture, reference, Scale::block);
    EXPECT_LT(worst.deviate, limit) << settings.name << ", " << worst.place;
  }
}

TEST(Maps, GiveASampleTheBitsThatItHasAlone) {
  made().texture("patches.exr", 16, 16,
                 [](int x, int y) { return Color(0.1f + 0.8f * float((x / 4 + y / 4) % 2), 0.5f, 0.3f); });
  const Scene scene = draped(made().compiled(pattern_of(R"({"texture": "patches.exr", "repeat": [3, 2]})")));
  const auto scratch = std::make_unique<PathScratch>();
  std::vector<SampleId> ids;
  for (int k = 0; k < batch_size; ++k) ids.push_back({6 + k % 12, 4 + k / 12, k % 4, std::uint32_t(k % 3)});
  std::vector<CameraSample> together(ids.size());
  const LightSettings light{Strategy::mis_compensated, 4, 2};
  trace_samples(scene, light, 9, ids, *scratch, together.data());
  for (size_t k = ids.size(); k-- > 0;) {
    const CameraSample alone = trace_sample(scene, light, 9, ids[k], *scratch);
    const Color a = alone.total(), b = together[k].total();
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
    EXPECT_EQ(alone.alpha, together[k].alpha);
  }
}

}  // namespace
}  // namespace sateen_test
