#include <gtest/gtest.h>

#include <cmath>

#include "scene/mapped_looks.h"

// Textures with alpha: what is transparent shows the cloth that the look has without them.

namespace sateen_test {
namespace {

using namespace sateen;

const Footprint wide{Vec2(8, 0), Vec2(0, 8)};

struct TransparentLooks : MappedLooks {
  /// A picture with alpha: a PNG, whose colours lie beside it, or an EXR, which holds them multiplied.
  void picture(const std::string& name, int width, int height,
               const std::function<std::array<float, 4>(int, int)>& at, int channels = 4) const {
    Image image(width, height, channels);
    const bool exr = name.ends_with(".exr");
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::array<float, 4> pixel = at(x, y);
        for (int c = 0; c < channels; ++c)
          image.at(x, y)[c] = pixel[size_t(c)] * (exr && c < 3 && channels == 4 ? pixel[3] : 1);
      }
    const std::vector<std::string> names{"R", "G", "B", "A"};
    if (exr)
      write_exr(folder.path / name, {{"", {names.begin(), names.begin() + channels}, false, image}}, {},
                std::nullopt);
    else
      write_display_image(folder.path / name, image, {}, 16);
  }

  /// Own values at the left, half of each in the middle, the picture's at the right; black under what is clear.
  void thirds(const std::string& name, float value) const {
    picture(name, 3, 3, [&](int x, int) {
      const float alpha = 0.5f * float(x), v = x == 0 ? 0 : value;
      return std::array{v, v, v, alpha};
    });
  }
};

TEST(TransparentMaps, ShowTheNumberThatTheLookHasWithoutThem) {
  const TransparentLooks made;
  made.thirds("t.exr", 0.8f);
  const CompiledSide side = made.compiled(R"({
    "warp": {"k_d": {"texture": "t.exr", "under": 0.4}, "eta": {"texture": "t.exr", "scale": 1.5, "offset": 1, "under": 1.3},
             "coverage": {"texture": "t.exr", "scale": 0.5, "under": 0.2},
             "gamma_s_deg": {"texture": "t.exr", "scale": 50, "under": 8}, "gamma_v_deg": {"texture": "t.exr", "scale": 50}},
    "weft": {"coverage": 0.5}, "warp_angle_deg": {"texture": "t.exr", "scale": 100, "under": -60},
    "pattern": {"mask": {"texture": "t.exr", "under": 0.1}, "look": "linen_plain"}})",
                                          false);
  ASSERT_TRUE(side.maps);
  EXPECT_TRUE(side.warnings.empty()) << side.warnings.front();
  const float u[] = {1 / 6.0f, 0.5f, 5 / 6.0f}, alpha[] = {0, 0.5f, 1};
  for (size_t i = 0; i < 3; ++i) {
    const Vec2 uv(u[i], 0.5f);
    const PointValues point = values_at(side.maps->own, uv, {});
    const auto blend = [&](float own, float picture) { return own + (picture - own) * alpha[i]; };
    EXPECT_NEAR(point.family[0].k_d, blend(0.4f, 0.8f), 1e-5f);
    EXPECT_NEAR(point.family[0].eta, blend(1.3f, 2.2f), 1e-5f);
    EXPECT_NEAR(point.family[0].coverage, blend(0.2f, 0.4f), 1e-5f);
    EXPECT_NEAR(point.family[0].gamma_s, radians(blend(8, 40)), 1e-5f);
    EXPECT_NEAR(point.family[0].gamma_v, radians(blend(24, 40)), 1e-5f) << "24 is the default";
    EXPECT_NEAR(pattern_share(*side.maps->pattern, uv, {}), blend(0.1f, 0.8f), 1e-5f);
    const float angle = warp_angle_at(side.maps->own, side.fabric, uv, {});
    EXPECT_NEAR(degrees(angle), blend(-60, 80), 1e-2f);  // of equal length, so half way is the middle
  }
}

TEST(TransparentMaps, ShowTheColourThatTheLookHasWithoutThemBlendedInLight) {
  const TransparentLooks made;
  for (const char* name : {"t.exr", "t.png"}) {
    made.picture(name, 3, 1, [&](int x, int) {
      return x == 0 ? std::array{0.0f, 0.0f, 0.0f, 0.0f} : std::array{0.8f, 0.7f, 0.6f, 0.5f * float(x)};
    });
    const char* space = name[2] == 'e' ? "lin_rec709" : "srgb_texture";
    const auto text = [&](const std::string& own) {
      return fmt::format(R"({{{}"color": {{"texture": "{}", "space": "{}"}}}})", own, name, space);
    };
    made.look(R"({"color": [0.2, 0.5, 0.4]})", "parent.json");
    made.look(R"({"warp": {"A": [0.2, 0.5, 0.4]}, "weft": {"A": [0.1, 0.1, 0.9]}})", "raw.json");
    const CompiledSide own = made.compiled(R"({"inherits": "parent.json"})", false),
                       raw = made.compiled(R"({"inherits": "raw.json"})", false);
    const CompiledSide all =
        made.compiled(fmt::format(R"({{"color": {{"value": [0.8, 0.7, 0.6], "space": "{}"}}}})", space), false);
    const CompiledSide over_color = made.compiled(text(R"("inherits": "parent.json", )"), false),
                       over_scale = made.compiled(text(R"("inherits": "raw.json", )"), false);
    ASSERT_TRUE(over_color.maps && over_scale.maps);
    EXPECT_TRUE(over_color.warnings.empty()) << over_color.warnings.front();
    for (size_t f = 0; f < 2; ++f)
      for (int c = 0; c < 3; ++c) {
        const auto at = [&](const CompiledSide& side, float u) {
          return values_at(side.maps->own, Vec2(u, 0.5f), {}).A[f][c];
        };
        const float mine = own.fabric.A[f][c], scale = raw.fabric.A[f][c], picture = all.fabric.A[f][c];
        EXPECT_NEAR(at(over_color, 1 / 6.0f), mine, 1e-3f) << name;
        EXPECT_NEAR(at(over_color, 0.5f), (mine + picture) / 2, 1e-3f) << name;
        EXPECT_NEAR(at(over_color, 5 / 6.0f), picture, 1e-3f) << name;
        EXPECT_NEAR(at(over_scale, 1 / 6.0f), scale, 1e-3f) << name;
        EXPECT_NEAR(at(over_scale, 0.5f), (scale + picture) / 2, 1e-3f) << name;
      }
  }
}

TEST(TransparentMaps, AreOverTheColourOfBothFamiliesWhereOneHasATexture) {
  const TransparentLooks made;
  made.picture("clear.exr", 2, 2, [](int x, int) { return std::array{0.5f, 0.5f, 0.5f, float(x)}; });
  const CompiledSide side = made.compiled(
      R"({"color": [0.2, 0.5, 0.4], "warp": {"color": {"texture": "clear.exr", "space": "lin_rec709"}}})", false);
  const CompiledSide plain = made.compiled(R"({"color": [0.2, 0.5, 0.4]})", false);
  ASSERT_TRUE(side.maps);
  EXPECT_FALSE(side.maps->own.A[1]);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(values_at(side.maps->own, Vec2(0.25f, 0.5f), {}).A[0][c], plain.fabric.A[0][c], 1e-3f);
    EXPECT_NEAR(side.fabric.A[1][c], plain.fabric.A[1][c], 1e-6f);
  }
}

TEST(TransparentMaps, HaveNoDarkFringesWhenFiltered) {
  const TransparentLooks made;
  // A quarter of a checkerboard of clear black and opaque 0.8 over 0.4.
  for (const char* name : {"c.exr", "c.png"}) {
    made.picture(name, 64, 64, [](int x, int y) {
      return (x / 2 + y / 2) % 2 ? std::array{0.8f, 0.8f, 0.8f, 1.0f} : std::array{0.0f, 0.0f, 0.0f, 0.0f};
    });
    const CompiledSide side =
        made.compiled(fmt::format(R"({{"warp": {{"k_d": {{"texture": "{}", "under": 0.4}}}}}})", name), false);
    for (const float size : {0.0f, 0.01f, 0.1f, 0.5f, 8.0f})
      for (float u = 0.01f; u < 1; u += 0.093f) {
        const float k_d = values_at(side.maps->own, Vec2(u, 0.37f), {Vec2(size, 0), Vec2(0, size)}).family[0].k_d;
        EXPECT_GE(k_d, 0.399f) << "neither 0.4 nor 0.8 nor between them";
        EXPECT_LE(k_d, 0.801f);
        if (size > 0.4f) {
          EXPECT_NEAR(k_d, 0.6f, 0.01f);
        }
      }
  }
}

TEST(TransparentMaps, PlaceOneMotifAndLeaveTheClothAroundIt) {
  const TransparentLooks made;
  made.picture("disc.png", 64, 64, [](int x, int y) {
    const float r = std::hypot(float(x) - 31.5f, float(y) - 31.5f);
    return r < 31 ? std::array{0.9f, 0.9f, 0.9f, 1.0f} : std::array{0.0f, 0.0f, 0.0f, 0.0f};
  });
  const CompiledSide side = made.compiled(
      R"({"warp": {"k_d": {"texture": "disc.png", "repeat_cm": [10, 10], "wrap": "clamp", "under": 0.3}}})", false);
  ASSERT_TRUE(side.maps);
  const auto at = [&](float u, float v, float size) {
    return values_at(side.maps->own, Vec2(u, v), {Vec2(size, 0), Vec2(0, size)}).family[0].k_d;
  };
  EXPECT_NEAR(at(0.05f, 0.05f, 0), 0.9f, 1e-3f);
  EXPECT_NEAR(at(0.002f, 0.002f, 0), 0.3f, 1e-3f);
  // Beside it the cloth, however wide the area: also on its level, where a border that is not clear any more would
  // run on in streaks.
  for (const float size : {0.0f, 0.01f, 0.05f, 0.2f})
    for (const Vec2& uv : {Vec2(0.8f, 0.05f), Vec2(0.05f, 0.8f), Vec2(-0.7f, 0.05f), Vec2(0.9f, 0.9f)})
      EXPECT_NEAR(at(uv.x, uv.y, size), 0.3f, 1e-4f) << uv.x << " " << uv.y << " " << size;
}

TEST(TransparentMaps, SayWhereNothingOfThemIsSeen) {
  const TransparentLooks made;
  made.picture("none.png", 4, 4, [](int, int) { return std::array{9.0f, 0.5f, 0.5f, 0.0f}; });
  const CompiledSide side = made.compiled(R"({"warp": {"k_d": {"texture": "none.png", "scale": 7}}})", false);
  ASSERT_EQ(side.warnings.size(), 1u);
  EXPECT_NE(side.warnings[0].find("16 of the 16 pixels of the texture of warp.k_d are transparent"),
            std::string::npos)
      << side.warnings[0];
  EXPECT_FLOAT_EQ(values_at(side.maps->own, Vec2(0.4f, 0.4f), wide).family[0].k_d, 0.3f);
}

TEST(TransparentMaps, OfAnOpaqueAlphaHaveTheBitsOfThePictureWithoutIt) {
  const TransparentLooks made;
  const auto pixel = [](int x, int y) { return std::array{float(x) / 8, float(y) / 8, 0.5f, 1.0f}; };
  for (const std::string name : {"a.png", "a.exr"}) {
    made.picture("with_" + name, 8, 8, pixel);
    made.picture("without_" + name, 8, 8, pixel, 3);
    const auto A = [&](const std::string& kind, float u, float v) {
      const CompiledSide side = made.compiled(
          fmt::format(R"({{"color": {{"texture": "{}{}", "space": "srgb_texture", "wrap": "clamp"}}}})", kind, name),
          false);
      return values_at(side.maps->own, Vec2(u, v), {Vec2(0.1f, 0), Vec2(0, 0.1f)}).A[0];
    };
    for (const float u : {-0.4f, 0.1f, 0.33f, 0.71f, 1.2f}) {
      const Color with = A("with_", u, 0.3f), without = A("without_", u, 0.3f);
      for (int c = 0; c < 3; ++c) EXPECT_EQ(with[c], without[c]);
    }
  }
}

}  // namespace
}  // namespace sateen_test
