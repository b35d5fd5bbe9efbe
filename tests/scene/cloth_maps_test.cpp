#include "scene/cloth_maps.h"

#include <gtest/gtest.h>

#include "scene/mapped_looks.h"

namespace sateen_test {
namespace {

using namespace sateen;

const Footprint wide{Vec2(8, 0), Vec2(0, 8)};

TEST(ClothMaps, GiveEveryFieldItsPixels) {
  const MappedLooks made;
  // Left half 0.25, right half 0.75.
  made.texture("halves.exr", 64, 2, [](int x, int) { return Color(x < 32 ? 0.25f : 0.75f); });
  const CompiledSide side = made.compiled(R"({
    "color_space": "lin_rec709",
    "warp": {"A": {"texture": "halves.exr", "space": "lin_rec709", "scale": 2, "offset": 0.1},
             "coverage": {"texture": "halves.exr", "scale": 0.5}, "k_d": {"texture": "halves.exr"}},
    "weft": {"coverage": 0.3, "eta": {"texture": "halves.exr", "offset": 1}, "gamma_s_deg": {"texture": "halves.exr", "scale": 20},
             "gamma_v_deg": {"texture": "halves.exr", "scale": 40, "repeat": [2, 1]}}})",
                                          false);
  ASSERT_TRUE(side.maps);
  EXPECT_TRUE(side.warnings.empty()) << side.warnings.front();
  const PointValues left = values_at(side.maps->own, Vec2(0.25f, 0.5f), {}),
                    right = values_at(side.maps->own, Vec2(0.75f, 0.5f), {}),
                    all = values_at(side.maps->own, Vec2(0.1f, 0.5f), wide);
  const Color a = made.colors.to_working(Color(0.25f), "lin_rec709");
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(left.A[0][c], a[c] * 2 + 0.1f, 1e-3f);
    EXPECT_NEAR(right.A[0][c], a[c] * 6 + 0.1f, 1e-3f);
    EXPECT_NEAR(all.A[0][c], a[c] * 4 + 0.1f, 1e-3f);
    EXPECT_EQ(left.A[1][c], side.fabric.A[1][c]);
  }
  EXPECT_FLOAT_EQ(left.family[0].coverage, 0.125f);
  EXPECT_FLOAT_EQ(left.gap, 0.575f);
  EXPECT_FLOAT_EQ(right.gap, 0.325f);
  EXPECT_FLOAT_EQ(right.family[0].k_d, 0.75f);
  EXPECT_FLOAT_EQ(left.family[1].eta, 1.25f);
  EXPECT_FLOAT_EQ(right.family[1].gamma_s, radians(15));
  EXPECT_FLOAT_EQ(values_at(side.maps->own, Vec2(0.625f, 0.5f), {}).family[1].gamma_v, radians(10));
  EXPECT_NEAR(side.fabric.gap, 0.45f, 1e-6f);
  EXPECT_TRUE(side.fabric.varying);
}

TEST(ClothMaps, TakeTheLayerThatIsNamedAndRefuseToGuess) {
  const MappedLooks made;
  const auto layer = [](const char* name, std::vector<std::string> channels, float value) {
    Image image(4, 4, int(channels.size()));
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return ImageLayer{name, std::move(channels), false, image};
  };
  write_exr(
      made.folder.path / "two.exr",
      {layer("AO", {"R", "G", "B"}, 0.9f), layer("base", {"R", "G", "B"}, 0.3f), layer("wear", {"amount"}, 0.6f)}, {},
      std::nullopt);
  const auto text = [](const std::string& more) {
    return R"({"warp": {"A": {"texture": "two.exr", "space": "lin_rec709")" + more +
           R"(}, "k_d": {"texture": "two.exr", "layer": "wear.amount"}}})";
  };
  EXPECT_NE(made.error_in(text("")).find("does not say which of its layers is the colour: AO"), std::string::npos)
      << made.error_in(text(""));
  const CompiledSide side = made.compiled(text(R"(, "layer": "base")"), false);
  ASSERT_TRUE(side.maps);
  const PointValues values = values_at(side.maps->own, Vec2(0.5f, 0.5f), {});
  EXPECT_NEAR(values.A[0][1], made.colors.to_working(Color(0.3f), "lin_rec709").y, 1e-3f);
  EXPECT_FLOAT_EQ(values.family[0].k_d, 0.6f);
  // The only layer with colours is a guess, and told.
  write_exr(made.folder.path / "one.exr", {layer("base", {"R", "G", "B"}, 0.3f), layer("depth", {"Z"}, 4)}, {},
            std::nullopt);
  const CompiledSide guessed =
      made.compiled(R"({"warp": {"A": {"texture": "one.exr", "space": "lin_rec709"}}})", false);
  ASSERT_EQ(guessed.warnings.size(), 1u);
  EXPECT_NE(guessed.warnings[0].find("its layer base is taken as the colour"), std::string::npos)
      << guessed.warnings[0];
}

TEST(ClothMaps, TakeXyzAsXyzOrNotAtAll) {
  const MappedLooks made;
  Image xyz(4, 4, 3);
  for (int i = 0; i < 16; ++i) {
    xyz.pixels[size_t(i) * 3] = 0.95047f / 2;
    xyz.pixels[size_t(i) * 3 + 1] = 0.5f;
    xyz.pixels[size_t(i) * 3 + 2] = 1.08883f / 2;
  }
  write_exr(made.folder.path / "xyz.exr", {{"", {"X", "Y", "Z"}, false, xyz}}, {}, std::nullopt);
  const auto text = [](const char* space) {
    return fmt::format(R"({{"warp": {{"A": {{"texture": "xyz.exr", "space": "{}"}}}}}})", space);
  };
  EXPECT_NE(made.error_in(text("lin_rec709")).find("holds CIE XYZ pixels"), std::string::npos);
  const CompiledSide side = made.compiled(text("cie_xyz_d65"), false);
  ASSERT_TRUE(side.maps);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(values_at(side.maps->own, Vec2(0.5f, 0.5f), {}).A[0][c], 0.5f, 2e-3f);
}

TEST(ClothMaps, HaveASizeOnTheClothWhereTheyAreGivenOne) {
  const MappedLooks made;
  made.texture("halves.exr", 64, 64, [](int x, int) { return Color(x < 32 ? 0.25f : 0.75f); });
  const auto k_d_at = [&](const std::string& members, float metres_per_uv, float metres) {
    const std::string text =
        R"({"warp": {"k_d": {"texture": "halves.exr")" + members + R"(}}, "weft": {"coverage": 0.5}})";
    const CompiledSide side = made.compiled(text, false, metres_per_uv);
    return values_at(side.maps->own, Vec2(metres / metres_per_uv, 0.3f), {}).family[0].k_d;
  };
  // 8 cm: the right half of a repeat from 4 to 8, 12 to 16 ... whatever a UV unit is.
  for (const float metres_per_uv : {0.02f, 0.5f, 1.0f, 3.0f})
    for (const auto& [cm, k_d] :
         {std::pair(2.0f, 0.25f), {6.0f, 0.75f}, {10.0f, 0.25f}, {14.0f, 0.75f}, {22.0f, 0.75f}})
      EXPECT_FLOAT_EQ(k_d_at(R"(, "repeat_cm": [8, 5])", metres_per_uv, cm / 100), k_d) << metres_per_uv << " " << cm;
  EXPECT_FLOAT_EQ(k_d_at(R"(, "repeat": [0.5, 1])", 3, 4.5f), 0.75f) << "by UV units, the size does not count";
  EXPECT_TRUE(has_sized_textures(made.look(R"({"warp": {"k_d": {"texture": "halves.exr", "repeat_cm": [8, 5]}}})")));
  EXPECT_FALSE(has_sized_textures(made.look(R"({"warp": {"k_d": {"texture": "halves.exr"}}})")));
}

TEST(ClothMaps, TellHowFarColourStraysWhereNumbersVaryToo) {
  const MappedLooks made;
  made.texture("halves.exr", 64, 64, [](int x, int) { return Color(x < 32 ? 0.1f : 0.4f); });
  const std::string color = R"("color": {"texture": "halves.exr", "space": "lin_rec709"})";
  EXPECT_EQ(made.compiled("{" + color + "}", false).color_error, 0);
  EXPECT_EQ(made.compiled(R"({"warp": {"coverage": {"texture": "halves.exr"}}, "weft": {"coverage": 0.5}})", false)
                .color_error,
            0);
  const CompiledSide both = made.compiled(
      "{" + color + R"(, "warp": {"coverage": {"texture": "halves.exr"}}, "weft": {"coverage": 0.5}})", false);
  // Compiled as a look of its own, at the thinnest and at the thickest place.
  float worst = 0;
  for (const float coverage : {0.1f, 0.4f}) {
    const Look there =
        made.look(fmt::format(R"({{"warp": {{"coverage": {}}}, "weft": {{"coverage": 0.5}}}})", coverage));
    const Albedo parts = albedo(compile_fabric(there, same_space, {false, 1}).threads, Vec3(0, 0, 1));
    const Look mean = made.look(R"({"warp": {"coverage": 0.25}, "weft": {"coverage": 0.5}})");
    const Albedo solved = albedo(compile_fabric(mean, same_space, {false, 1}).threads, Vec3(0, 0, 1));
    const float A = both.maps->own.A[0]->high[0];
    worst = std::max(worst, std::abs(parts.surface - solved.surface +
                                     A * (parts.volume[0] + parts.volume[1] - solved.volume[0] - solved.volume[1])));
  }
  EXPECT_GT(both.color_error, 0.02f);
  EXPECT_NEAR(both.color_error, worst, 0.05f * worst);
}

TEST(ClothMaps, ConvertEncodedColoursBeforeTheyAreFiltered) {
  const MappedLooks made;
  Image checks(16, 16, 3);
  for (size_t i = 0; i < checks.pixels.size(); ++i) checks.pixels[i] = float((i / 3 % 16 + i / 48) % 2);
  write_display_image(made.folder.path / "checks.png", checks);
  const CompiledSide side =
      made.compiled(R"({"warp": {"A": {"texture": "checks.png", "space": "srgb_texture"}}})", false);
  // Half of the light, not the light of half the code, which is 0.214.
  const PointValues mean = values_at(side.maps->own, Vec2(0.3f, 0.3f), wide);
  const Color half = made.colors.to_working(Color(0.5f), "lin_rec709");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean.A[0][c], half[c], 1e-3f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(side.fabric.A[0][c], half[c], 1e-3f);
}

TEST(ClothMaps, TakeTheTileOfAUdimSetAndItsMeanWhereThereIsNone) {
  const MappedLooks made;
  made.texture("k.1001.exr", 4, 4, [](int, int) { return Color(0.2f); });
  made.texture("k.1002.exr", 4, 4, [](int, int) { return Color(0.4f); });
  made.texture("k.1011.exr", 4, 4, [](int, int) { return Color(0.9f); });
  const CompiledSide side = made.compiled(R"({"warp": {"k_d": {"texture": "k.<UDIM>.exr"}}})", false);
  const auto at = [&](float u, float v) { return values_at(side.maps->own, Vec2(u, v), {}).family[0].k_d; };
  EXPECT_FLOAT_EQ(at(0.5f, 0.5f), 0.2f);
  EXPECT_FLOAT_EQ(at(1.01f, 0.99f), 0.4f);
  EXPECT_FLOAT_EQ(at(0.99f, 1.01f), 0.9f);
  EXPECT_FLOAT_EQ(at(5, 5), 0.5f);
  EXPECT_FLOAT_EQ(at(-0.5f, 0.5f), 0.5f);
  EXPECT_TRUE(side.maps->own.k_d[0]->covers(Vec2(1.5f, 0.5f)));
  EXPECT_FALSE(side.maps->own.k_d[0]->covers(Vec2(1.5f, 1.5f)));
}

TEST(ClothMaps, FilterAnglesAroundTheCircle) {
  const MappedLooks made;
  made.texture("angle.exr", 2, 1, [](int x, int) { return Color(x == 0 ? 170.0f : -170.0f); });
  const CompiledSide side = made.compiled(R"({"warp_angle_deg": {"texture": "angle.exr", "wrap": "clamp"}})", false);
  const auto at = [&](float u) { return degrees(warp_angle_at(side.maps->own, side.fabric, Vec2(u, 0.5f), {})); };
  EXPECT_NEAR(at(0.25f), 170, 1e-3);
  EXPECT_NEAR(std::abs(at(0.5f)), 180, 1e-3);
  EXPECT_NEAR(at(0.625f), -175, 0.1);
  EXPECT_NEAR(std::abs(degrees(side.fabric.warp_angle)), 180, 1e-3);
}

TEST(ClothMaps, CountPixelsThatAreOutOfRange) {
  const MappedLooks made;
  made.texture("wild.exr", 8, 8, [](int x, int y) {
    return Color(y == 0 ? std::numeric_limits<float>::quiet_NaN() : x == 3 ? 7.0f : x == 4 ? -1.0f : 0.5f);
  });
  const CompiledSide side = made.compiled(
      R"({"warp": {"k_d": {"texture": "wild.exr"}, "gamma_s_deg": {"texture": "wild.exr", "scale": 20}}})", false);
  std::string all;
  for (const std::string& warning : side.warnings) all += warning + "\n";
  EXPECT_NE(
      all.find("mapped.json:1: 14 of the 64 pixels of the texture of warp.k_d are out of range: brought into 0 to 1"),
      std::string::npos)
      << all;
  EXPECT_NE(all.find("8 of the 64 pixels of the texture of warp.k_d are not finite and count as 0"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("of the texture of warp.gamma_s_deg are out of range: brought into 0.5 to 90"),
            std::string::npos)
      << all;
  EXPECT_FLOAT_EQ(values_at(side.maps->own, Vec2(0.4375f, 0.3f), {}).family[0].k_d, 1);
}

TEST(ClothMaps, SolveColourPixelByPixel) {
  const MappedLooks made;
  made.texture("c.exr", 2, 1, [](int x, int) { return x == 0 ? Color(0.6f, 0.4f, 0.2f) : Color(0.3f, 0.3f, 0.5f); });
  const char* threads = R"("k_d": 0.3, "gamma_s_deg": 8)";
  const CompiledSide side = made.compiled(
      fmt::format(
          R"({{"color": {{"texture": "c.exr", "space": "lin_rec709", "wrap": "clamp"}}, "warp": {{{0}}}, "weft": {{{0}}}}})",
          threads),
      false);
  EXPECT_TRUE(side.warnings.empty());
  const CompiledSide plain =
      made.compiled(fmt::format(R"({{"color": [0.6, 0.4, 0.2], "warp": {{{0}}}, "weft": {{{0}}}}})", threads), false);
  EXPECT_FALSE(plain.maps);
  const PointValues left = values_at(side.maps->own, Vec2(0.2f, 0.5f), {});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(left.A[0][c], plain.fabric.A[0][c], 1e-3f);
  EXPECT_EQ(side.maps->own.A[0], side.maps->own.A[1]) << "one picture, kept once";
  // What no A can show is taken as near as it gets, and counted.
  const CompiledSide dark =
      made.compiled(R"({"color": {"texture": "c.exr", "space": "lin_rec709", "scale": 0.01}})", false);
  ASSERT_EQ(dark.warnings.size(), 1u);
  EXPECT_NE(dark.warnings[0].find("2 of the 2 pixels of the texture of warp.color"), std::string::npos)
      << dark.warnings[0];
}

TEST(ClothMaps, SayWhatIsWrongWithATextureAndWhere) {
  const MappedLooks made;
  std::ofstream(made.folder.path / "broken.exr") << "no picture";
  EXPECT_NE(made.error_in(R"({"warp": {"k_d": {"texture": "broken.exr"}}})")
                .find("mapped.json:1: error: the texture of warp.k_d"),
            std::string::npos)
      << made.error_in(R"({"warp": {"k_d": {"texture": "broken.exr"}}})");
  made.texture("k.exr", 2, 2, [](int, int) { return Color(0.5f); });
  EXPECT_NE(made.error_in(R"({"warp": {"A": {"texture": "k.exr", "space": "srgb_textur"}}})").find("srgb_texture"),
            std::string::npos);
  EXPECT_NE(made.error_in(R"({"warp": {"coverage": {"texture": "k.exr", "scale": 0}}, "weft": {"coverage": 0}})")
                .find("no threads"),
            std::string::npos);
  made.look(R"({"pattern": {"mask": 0.5, "look": "linen_plain"}})", "other.json");
  EXPECT_NE(made.error_in(R"({"pattern": {"mask": 0.5, "look": "other.json"}})").find("has a pattern of its own"),
            std::string::npos);
}

TEST(Footprint, IsThatOfANeighbouringPixel) {
  Mesh mesh;
  mesh.quads.push_back({0, 1, 2, 3});
  const Vec3 along(3, 0.4f, 0), across(0.2f, 1, -2);
  for (const auto& [a, b] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}}) {
    mesh.positions.push_back(along * a + across * b);
    mesh.normals.push_back(normalize(cross(along, across)));
    mesh.dpdu.push_back(along);
    mesh.dpdv.push_back(across);
    mesh.uvs.push_back(Vec2(a, b));
  }
  const RayTracer rays(mesh);
  CameraSettings settings;
  settings.azimuth_deg = 25;
  settings.elevation_deg = 40;
  const Camera camera = frame_points(mesh.positions, settings, 200, 120);
  const auto surface_at = [&](float x, float y) {
    const std::optional<Hit> hit = rays.closest_hit(camera.ray(x, y));
    return hit ? std::optional(surface_point(mesh, *hit)) : std::nullopt;
  };
  int seen = 0;
  for (float y = 10; y < 110; y += 9)
    for (float x = 10; x < 190; x += 17) {
      const auto here = surface_at(x, y), right = surface_at(x + 1, y), below = surface_at(x, y + 1);
      if (!here || !right || !below) continue;
      const Footprint f = camera_footprint(camera, camera.ray(x, y), *here);
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(f.dx[k], right->uv[k] - here->uv[k], 3e-5f);
        EXPECT_NEAR(f.dy[k], below->uv[k] - here->uv[k], 3e-5f);
      }
      ++seen;
    }
  EXPECT_GT(seen, 30);
}

TEST(Footprint, StaysFiniteAtTheSilhouette) {
  SurfacePoint surface;
  surface.position = Vec3(0, 0, -5);
  surface.geometric_normal = Vec3(0, 1, 0);
  surface.dpdu = Vec3(2, 0, 0);
  surface.dpdv = Vec3(0, 0, -2);
  Camera camera;
  camera.position = Vec3(0);
  camera.right = Vec3(1, 0, 0);
  camera.up = Vec3(0, 1, 0);
  camera.forward = Vec3(0, 0, -1);
  camera.width = camera.height = 100;
  for (const float height : {0.0f, 1e-20f, 1e-6f, 0.01f, -0.01f}) {
    Ray ray;
    ray.origin = Vec3(0, height, 0);
    ray.direction = normalize(surface.position - ray.origin);
    const Footprint f = camera_footprint(camera, ray, surface);
    for (const Vec2& d : {f.dx, f.dy})
      for (int k = 0; k < 2; ++k) {
        EXPECT_TRUE(std::isfinite(d[k]));
        EXPECT_LE(std::abs(d[k]), 1) << height;
      }
  }
}

}  // namespace
}  // namespace sateen_test
