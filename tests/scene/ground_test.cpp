#include "scene/ground.h"

#include <gtest/gtest.h>

#include <random>

#include "scene/maps.h"

namespace sateen_test {
namespace {

using namespace sateen;

Environment constant(const Color& value, int width = 16, int height = 8) {
  return build_environment(make_map(width, height, [&](int, int) { return value; }));
}

Environment random_map(int width, int height) {
  std::mt19937 random(5);
  const auto r = [&] { return float(random()) * 0x1p-32f; };
  return build_environment(make_map(width, height, [&](int, int) { return Color(r(), r(), r()); }));
}

struct Draw {
  std::mt19937 random{3};
  float operator()(double low, double high) { return float(low + (high - low) * double(random()) * 0x1p-32); }
};

Ground stage(GroundKind kind) {
  Ground g;
  g.kind = kind;
  g.height = -0.3f;
  g.middle = Vec3(0.2f, 0.4f, -0.1f);
  g.away = normalize(Vec3(0.3f, 0, -1));
  g.wall = 3;
  g.sweep = 1.2f;
  g.top = 4;
  g.fade_from = 5;
  g.fade_to = 16;
  return g;
}

// How far a place is inside the space before a cyclorama; negative behind it.
double inside(const Ground& g, const Vec3& p) {
  const double s = dot(p - g.middle, g.away), y = double(p.y) - double(g.height);
  const double x = s - double(g.wall - g.sweep), down = y - double(g.sweep);
  if (x > 0 && down < 0) return double(g.sweep) - std::hypot(x, down);
  return std::min(y, double(g.wall) - s);
}

TEST(Ground, OfAFloorIsMetWhereARayFallsToItsHeight) {
  const Ground g = stage(GroundKind::floor);
  Draw draw;
  for (int k = 0; k < 1000; ++k) {
    const Vec3 origin(draw(-5, 5), draw(-0.3, 5), draw(-5, 5)), direction(draw(-1, 1), draw(-1, 1), draw(-1, 1));
    const auto point = meet_ground(g, origin, direction, 1e30f);
    ASSERT_EQ(point.has_value(), direction.y < 0);
    if (!point) continue;
    EXPECT_EQ(point->position.y, g.height);
    EXPECT_EQ(point->normal, Vec3(0, 1, 0));
    EXPECT_NEAR(point->t, (g.height - origin.y) / direction.y, 1e-5 * point->t + 1e-6);
    EXPECT_FALSE(meet_ground(g, origin, direction, point->t * 0.999f));
  }
  EXPECT_FALSE(meet_ground(g, Vec3(0, -1, 0), Vec3(0, 1, 0.2f), 1e30f)) << "from below there is no floor";
}

TEST(Ground, OfACycloramaIsLeftByARayJustWhereItIsMet) {
  const Ground g = stage(GroundKind::cyclorama);
  Draw draw;
  int met[3] = {0, 0, 0};
  for (int k = 0; k < 20000; ++k) {
    const Vec3 origin = g.middle + Vec3(draw(-4, 4), draw(-0.7, 2.5), draw(-4, 4));
    if (inside(g, origin) <= 0) continue;
    const Vec3 direction = normalize(Vec3(draw(-1, 1), draw(-1, 1), draw(-1, 1)));
    const auto point = meet_ground(g, origin, direction, 1e30f);
    if (!point) {
      // Upwards away from the wall, or over its edge.
      const double ds = dot(direction, g.away), at = ds > 0 ? (g.wall - dot(origin - g.middle, g.away)) / ds : 0;
      ASSERT_GE(direction.y, 0);
      EXPECT_TRUE(ds <= 0 || origin.y + at * direction.y >= g.top - 1e-4);
      continue;
    }
    EXPECT_NEAR(inside(g, point->position), 0, 1e-5 * (1 + point->t));
    EXPECT_GT(inside(g, origin + direction * (point->t * 0.99f)), -1e-6);
    EXPECT_LT(inside(g, origin + direction * (point->t * 1.01f)), 1e-6);
    EXPECT_LT(dot(point->normal, direction), 0);
    EXPECT_NEAR(length(point->normal), 1, 1e-5);
    ++met[point->normal.y == 1 ? 0 : point->normal.y == 0 ? 1 : 2];
    // A ray that leaves it never meets the same place again.
    Vec3 out(draw(-1, 1), draw(-1, 1), draw(-1, 1));
    if (dot(out, point->normal) < 0) out = -out;
    const auto next = meet_ground(g, point->position, out, 1e30f);
    if (next && dot(normalize(out), point->normal) > 0.01f) {
      EXPECT_GT(next->t * length(out), 1e-3);
    }
  }
  for (const int n : met) EXPECT_GT(n, 500);
}

TEST(Ground, OfAFloorFadesAndNothingElseDoes) {
  EXPECT_EQ(ground_opacity(stage(GroundKind::floor), Vec3(1, -0.3f, 2)), 1);
  EXPECT_NEAR(ground_opacity(stage(GroundKind::floor), Vec3(10.7f, -0.3f, -0.1f)), 0.5, 1e-5);
  EXPECT_EQ(ground_opacity(stage(GroundKind::floor), Vec3(40, -0.3f, 2)), 0);
  EXPECT_EQ(ground_opacity(stage(GroundKind::cyclorama), Vec3(40, -0.3f, 2)), 1);
}

TEST(Ground, IsPlacedUnderAndBehindTheObject) {
  Mesh mesh;
  mesh.bounds_min = Vec3(-1, 2, -0.5f);
  mesh.bounds_max = Vec3(1, 4, 0.5f);
  for (const float azimuth : {0.0f, 70.0f, -160.0f}) {
    CameraSettings settings;
    settings.azimuth_deg = azimuth;
    settings.elevation_deg = 5;
    settings.zoom = 0.3f;
    const Camera camera = frame_points({mesh.bounds_min, mesh.bounds_max}, settings, 160, 90);
    GroundSettings ground;
    ground.kind = GroundKind::cyclorama;
    const Ground g = compile_ground(ground, mesh, camera, constant(Color(1)));
    EXPECT_LT(g.height, 2);
    EXPECT_GT(g.height, 1.999f);
    EXPECT_GT(dot(g.away, camera.forward), 0.99f);
    for (int y = 0; y <= 90; y += 10)
      for (int x = 0; x <= 160; x += 10) {
        const Ray ray = camera.ray(float(x), float(y));
        EXPECT_TRUE(meet_ground(g, ray.origin, ray.direction, 1e30f)) << "it fills the frame: " << x << ' ' << y;
      }
    ground.height = 1.5f;
    EXPECT_EQ(compile_ground(ground, mesh, camera, constant(Color(1))).height, 1.5f);
  }
}

TEST(UpwardIrradiance, IsTheIntegralOfCosine) {
  for (const int height : {1, 2, 3, 8, 31}) {
    const Color flat = upward_irradiance(constant(Color(1, 2, 3), 2 * height, height));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(flat[c], pi * float(c + 1), 1e-5 * flat[c]);
  }
  const Environment map = random_map(16, 9);
  Vec3d sum(0);
  constexpr int n = 1000;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double cosine = std::sqrt((i + 0.5) / n), sine = std::sqrt(1 - cosine * cosine),
                   a = 2 * M_PI * (j + 0.5) / n;
      const Vec3 d(float(sine * std::cos(a)), float(cosine), float(sine * std::sin(a)));
      sum += Vec3d(environment_radiance(map, d)) * (M_PI / n / n);
    }
  const Color exact = upward_irradiance(map);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(exact[c], sum[c], 2e-3 * sum[c]);
}

}  // namespace
}  // namespace sateen_test
