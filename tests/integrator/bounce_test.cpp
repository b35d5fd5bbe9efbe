#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "integrator/known_answers.h"

// Light that meets cloth again, against a plain recursive path tracer: random numbers instead of sequences, uniform
// directions, no strategies, no Russian roulette, both ways followed at every sheer layer.

namespace sateen_test {
namespace {

using namespace sateen;

struct PlainTracer {
  const Scene& scene;
  std::mt19937 random;

  double uniform() { return double(random()) * 0x1p-32; }

  Color arriving(const Vec3& origin, const Vec3& direction, int bounces) {
    const std::optional<Hit> hit = scene.rays->closest_hit({origin, direction});
    if (!hit) return environment_radiance(scene.environment, direction);
    const ClothPoint point = cloth_point(scene, *hit, direction);
    Color light(0);
    if (bounces > 0) light += leaving(point, bounces - 1);
    if (point.fabric->gap > 0)
      light += arriving(offset_origin(point.surface, direction), direction, bounces) * point.fabric->gap;
    return light;
  }

  Color leaving(const ClothPoint& point, int bounces) {
    const auto z = float(1 - uniform());
    const float r = std::sqrt(1 - z * z), angle = float(2 * M_PI * uniform());
    const Vec3 wi(r * std::cos(angle), r * std::sin(angle), z), world = point.frame.to_world(wi);
    if (dot(world, point.facing) <= 0) return Color(0);
    const Color f = scattered(*point.fabric, wi, point.wo);
    return f * arriving(offset_origin(point.surface, world), world, bounces) * (2 * pi);
  }
};

/// A floor in the corner of two walls.
Scene corner(Fabric fabric, Environment map) {
  Mesh mesh = floor_quad();
  add_quad(mesh, Vec3(-0.5f, 0.5f, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  add_quad(mesh, Vec3(0, 0.5f, -0.5f), Vec3(1, 0, 0), Vec3(0, 1, 0));
  Scene scene = make_scene(std::move(mesh), std::move(fabric), std::move(map));
  scene.camera = distant_camera(Vec3(-0.35f, 0, -0.3f), Vec3(0.3f, 1, 0.5f), 0.01f);
  return scene;
}

// False alarms 1e-4 for each test, Sidak over strategies, numbers of bounces and channels.
void expect_plain_answer(const Scene& scene, const std::vector<int>& bounces, const std::string& name) {
  const std::vector<NamedSettings> all = all_settings();
  const double bound = sidak_deviate(1e-4, double(all.size() * bounces.size() * 3));
  const Ray ray = scene.camera.ray(0.5f, 0.5f);
  const ClothPoint point = cloth_point(scene, *scene.rays->closest_hit(ray), ray.direction);
  for (const int n : bounces) {
    PlainTracer plain{scene, std::mt19937(11)};
    Batches expected[3];
    for (int b = 0; b < 64; ++b) {
      Vec3d sum(0);
      constexpr int samples = 2000;
      for (int k = 0; k < samples; ++k) sum += Vec3d(plain.leaving(point, n));
      for (int c = 0; c < 3; ++c) expected[c].add(sum[c] / samples);
    }
    for (NamedSettings settings : all) {
      settings.light.bounces = n;
      const Estimate got = estimate(scene, settings.light, 512);
      for (int c = 0; c < 3; ++c) {
        EXPECT_LT(std::abs(difference_deviate(got.channel[c], expected[c])), bound)
            << name << ", " << settings.name << ", " << n << " bounces, channel " << c << ": " << got.channel[c].mean
            << " +- " << std::sqrt(got.channel[c].variance_of_mean()) << ", expected " << expected[c].mean << " +- "
            << std::sqrt(expected[c].variance_of_mean());
      }
      if (n == 0)
        EXPECT_EQ(got.indirect, Vec3d(0));
      else
        EXPECT_GT(got.indirect.x, 0);
    }
  }
}

TEST(Bounces, AgreeWithAPlainPathTracer) {
  expect_plain_answer(corner(fabric_of(bright("silk_crepe_de_chine")), soft_map()), {0, 1, 2, 6}, "crepe");
}

TEST(Bounces, AgreeWithAPlainPathTracerThroughSheerWalls) {
  Look look = bright("linen_plain");
  look.warp.coverage = 0.4f;
  look.weft.coverage = 0.25f;
  expect_plain_answer(corner(fabric_of(look), soft_map()), {1, 3}, "sheer linen");
}

// Bright cloth all around but above: half of the light has met it more than three times, and roulette plays.
TEST(Bounces, AgreeWithAPlainPathTracerInADeepBox) {
  Look look = bright("silk_crepe_de_chine");
  for (ThreadFamily* f : {&look.warp, &look.weft}) {
    f->eta = 1;
    f->k_d = 1;
    f->offsets_deg = {0, 0};
    f->lengths = {1};
    f->A.value = Color(0.45f, 0.4f, 0.2f);
  }
  Mesh mesh = floor_quad();
  for (const float side : {-0.5f, 0.5f}) {
    add_quad(mesh, Vec3(side, 1, 0), Vec3(0, 2, 0), Vec3(0, 0, side < 0 ? 1.0f : -1.0f));
    add_quad(mesh, Vec3(0, 1, side), Vec3(side < 0 ? 1.0f : -1.0f, 0, 0), Vec3(0, 2, 0));
  }
  Scene scene = make_scene(std::move(mesh), fabric_of(look), soft_map());
  scene.camera = distant_camera(Vec3(-0.35f, 0, -0.3f), Vec3(0.02f, 1, 0.03f), 0.01f);
  expect_plain_answer(scene, {10}, "box");
}

}  // namespace
}  // namespace sateen_test
