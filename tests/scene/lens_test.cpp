#include "scene/lens.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace sateen_test {
namespace {

using namespace sateen;

Camera camera() {
  CameraSettings settings;
  settings.azimuth_deg = 30;
  settings.fov_deg = 40;
  return frame_points({Vec3(-1, -1, -1), Vec3(1, 1, 1)}, settings, 300, 200);
}

/// A batch of rays of one place on the film, through the lens.
std::vector<Ray> rays_of(const Camera& c, const Lens& lens, float x, float y) {
  SequenceBatch numbers;
  numbers.count = batch_size;
  for (std::uint32_t k = 0; k < batch_size; ++k) {
    numbers.seed[k] = pixel_sequence(5, 1, 2, 0).seed;
    numbers.index[k] = k;
  }
  std::vector<Ray> rays(batch_size, c.ray(x, y));
  through_lens(c, lens, draw2(numbers, Dimension::lens), rays);
  return rays;
}

TEST(Lens, SendsAllRaysOfAPlaceOnTheFilmThroughOnePointAtTheFocus) {
  const Camera c = camera();
  for (const int blades : {0, 3, 6}) {
    const Lens lens{0.2f, 7, blades};
    const Ray pinhole = c.ray(40, 170);
    for (const Ray& ray : rays_of(c, lens, 40, 170)) {
      EXPECT_LT(length(ray.origin + ray.direction * 7 - (pinhole.origin + pinhole.direction * 7)), 1e-5f);
      EXPECT_NEAR(dot(ray.direction, c.forward), 1, 1e-5) << "directions reach the plane at distance 1";
      EXPECT_LT(length(ray.origin - c.position), 0.2001f);
    }
  }
}

// Similar triangles: a point at distance d, in focus at f, is spread over R (1 / d - 1 / f) at distance 1.
TEST(Lens, SpreadsAPointOverTheCircleOfConfusion) {
  const Camera c = camera();
  const Lens lens{0.15f, 5, 0};
  for (const float distance : {2.0f, 4.0f, 5.0f, 9.0f, 100.0f}) {
    const Ray pinhole = c.ray(220, 60);
    float widest = 0;
    for (const Ray& ray : rays_of(c, lens, 220, 60)) {
      const Vec3 off = ray.origin + ray.direction * distance - (pinhole.origin + pinhole.direction * distance);
      widest = std::max(widest, length(off) / c.pixel_size(pinhole.origin + pinhole.direction * distance));
    }
    const float expected = 0.15f * std::abs(1 / distance - 1 / 5.0f) / (2 * c.tan_x) * 300;
    EXPECT_LT(widest, expected * 1.001f + 1e-3f);
    EXPECT_GT(widest, expected * 0.9f - 1e-3f) << "64 points come near to the edge";
  }
}

TEST(Lens, FollowsFromFieldOfViewAndStop) {
  const Camera c = camera();
  Mesh mesh;
  mesh.bounds_min = Vec3(-1);
  mesh.bounds_max = Vec3(1);
  const RayTracer rays(mesh, 1);
  LensSettings settings;
  settings.f_stop = 2;
  // 40 degrees before 36 mm: 18 mm / tan 20 = 49.45 mm.
  EXPECT_NEAR(compile_lens(settings, mesh, rays, c).radius, 0.04945f / 4, 1e-5);
  EXPECT_NEAR(compile_lens(settings, mesh, rays, c).focus, dot(-c.position, c.forward), 1e-4)
      << "the object's middle";
  settings.metres_per_unit = 0.01f;
  settings.focus = 3;
  EXPECT_NEAR(compile_lens(settings, mesh, rays, c).radius, 4.945f / 4, 1e-3);
  EXPECT_NEAR(compile_lens(settings, mesh, rays, c).focus, 300, 1e-3);
  settings.focus = -1;
  EXPECT_THROW(compile_lens(settings, mesh, rays, c), InputError);
}

TEST(Lens, OfASmallApertureIsAPinhole) {
  const Camera c = camera();
  const Ray pinhole = c.ray(100, 100);
  for (const Ray& ray : rays_of(c, {1e-6f, 5, 0}, 100, 100)) {
    EXPECT_LT(length(ray.origin - pinhole.origin), 2e-6f);
    EXPECT_LT(length(ray.direction - pinhole.direction), 1e-6f);
  }
}

}  // namespace
}  // namespace sateen_test
