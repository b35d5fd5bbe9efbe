#include "scene/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace sateen {
namespace {

/// Film coordinates of a point as shares of the picture, 0 to 1 from the left and from the top.
Vec2 seen(const Camera& camera, const Vec3& point) {
  const Vec3d to = Vec3d(point) - Vec3d(camera.position);
  const double depth = to.dot(Vec3d(camera.forward));
  EXPECT_GT(depth, 0);
  return {float((to.dot(Vec3d(camera.right)) / depth / double(camera.tan_x) + 1) / 2),
          float((1 - to.dot(Vec3d(camera.up)) / depth / double(camera.tan_y)) / 2)};
}

std::vector<Vec3> cloud(std::mt19937& random, int count, const Vec3& size, const Vec3& middle) {
  std::vector<Vec3> points(static_cast<size_t>(count));
  const auto r = [&] { return float(random() % 20001) / 10000 - 1; };
  for (Vec3& p : points) p = middle + Vec3(r() * size.x, r() * size.y, r() * size.z);
  return points;
}

TEST(Framing, HoldsAllPointsInsideTheMarginAndTouchesIt) {
  std::mt19937 random(1);
  const auto pick = [&](double low, double high) {
    return float(low + (high - low) * double(random() % 10001) / 10000);
  };
  for (int run = 0; run < 2000; ++run) {
    CameraSettings settings;
    settings.azimuth_deg = pick(-180, 180);
    settings.elevation_deg = pick(-89, 89);
    settings.fov_deg = pick(1, 150);
    settings.margin = pick(0, 0.4);
    const float scale = std::pow(10.0f, pick(-3, 3));
    const std::vector<Vec3> points =
        cloud(random, 2 + int(random() % 200), Vec3(pick(0.01, 1), pick(0.01, 1), pick(0.01, 1)) * scale,
              Vec3(pick(-5, 5), pick(-5, 5), pick(-5, 5)) * scale);
    const int width = 1 + int(random() % 1000), height = 1 + int(random() % 1000);
    const Camera camera = frame_points(points, settings, width, height);
    EXPECT_EQ(camera.width, width);
    EXPECT_EQ(camera.height, height);
    float left = 1, right = 1, top = 1, bottom = 1;
    for (const Vec3& p : points) {
      const Vec2 at = seen(camera, p);
      left = std::min(left, at.x - settings.margin);
      right = std::min(right, 1 - settings.margin - at.x);
      top = std::min(top, at.y - settings.margin);
      bottom = std::min(bottom, 1 - settings.margin - at.y);
    }
    EXPECT_GT(std::min({left, right, top, bottom}), -2e-3f) << run;
    // Both sides of one direction touch: nearer or moved sideways, one of them would be cut. A very wide view may
    // come so close to one point that there is nothing left to touch.
    float nearest = 1e30f;
    for (const Vec3& p : points) nearest = std::min(nearest, dot(p - camera.position, camera.forward));
    if (nearest < 1e-3f * scale) {
      EXPECT_GT(settings.fov_deg, 60) << run;
      continue;
    }
    EXPECT_LT(std::min(std::max(left, right), std::max(top, bottom)), 2e-3f) << run;
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Framing, HoldsFarFromTheOrigin) {
  std::mt19937 random(2);
  for (const float offset : {1e3f, 1e4f, 1e5f}) {
    const std::vector<Vec3> points = cloud(random, 100, Vec3(1), Vec3(offset, -offset, offset));
    const Camera camera = frame_points(points, {}, 64, 48);
    const float grid = 4 * offset * 0x1p-23f;  // what the camera's own position can hold
    for (const Vec3& p : points) {
      const Vec2 at = seen(camera, p);
      EXPECT_GT(std::min({at.x, at.y, 1 - at.x, 1 - at.y}), 0.06f - grid - 1e-3f) << offset;
    }
  }
}

TEST(Framing, FollowsTheAngles) {
  const std::vector<Vec3> points{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  CameraSettings settings;
  settings.elevation_deg = 0;
  Camera camera = frame_points(points, settings, 10, 10);
  EXPECT_NEAR(camera.forward.z, -1, 1e-6) << "azimuth 0 looks along -Z";
  EXPECT_NEAR(camera.right.x, 1, 1e-6);
  settings.azimuth_deg = 90;
  camera = frame_points(points, settings, 10, 10);
  EXPECT_GT(camera.position.x, 1) << "a positive azimuth walks to the right";
  settings.elevation_deg = 60;
  camera = frame_points(points, settings, 10, 10);
  EXPECT_NEAR(camera.forward.y, -std::sin(radians(60)), 1e-6);
}

TEST(Framing, ZoomComesCloserToTheNearestPoint) {
  const std::vector<Vec3> points{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  CameraSettings settings;
  const Camera whole = frame_points(points, settings, 10, 10);
  settings.zoom = 2;
  const Camera close = frame_points(points, settings, 10, 10);
  const auto depth = [&](const Camera& c) {
    return std::min(dot(points[0] - c.position, c.forward), dot(points[1] - c.position, c.forward));
  };
  EXPECT_NEAR(depth(close), depth(whole) / 2, 1e-4f * depth(whole));
}

TEST(Framing, OfNothingAndOfOnePointIsStillACamera) {
  const std::vector<std::vector<Vec3>> clouds{
      {}, {Vec3(0)}, {Vec3(1, 2, 3)}, {Vec3(5), Vec3(5)}, {Vec3(1e-20f)}, {Vec3(1e6f)}};
  for (const auto& points : clouds) {
    const Camera camera = frame_points(points, {}, 64, 32);
    for (const Vec3& v : {camera.position, camera.right, camera.up, camera.forward})
      EXPECT_TRUE(std::isfinite(v.x + v.y + v.z));
    for (const Vec3& v : {camera.right, camera.up, camera.forward}) EXPECT_NEAR(length(v), 1, 1e-5f);
    const Vec3 direction = camera.ray(0.5f, 0.5f).direction;
    EXPECT_TRUE(std::isfinite(direction.x + direction.y + direction.z));
  }
}

TEST(CameraRays, LeadThroughThePixelsTheyAreAskedFor) {
  const std::vector<Vec3> points{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  const Camera camera = frame_points(points, {}, 200, 80);
  EXPECT_FLOAT_EQ(camera.tan_x / camera.tan_y, 2.5f) << "pixels are square";
  for (const auto& [x, y] : {std::pair(0.0f, 0.0f), {200.0f, 80.0f}, {100.0f, 40.0f}, {13.5f, 70.25f}}) {
    const Ray ray = camera.ray(x, y);
    const Vec2 at = seen(camera, ray.origin + ray.direction * 3);
    EXPECT_NEAR(at.x * 200, x, 2e-3);
    EXPECT_NEAR(at.y * 80, y, 2e-3);
  }
}

TEST(CameraRays, APixelsSizeIsTheDistanceBetweenNeighboursAtThePoint) {
  const std::vector<Vec3> points{Vec3(-1, -1, -1), Vec3(1, 1, 1)};
  const Camera camera = frame_points(points, {}, 200, 80);
  const Vec3 point(0.3f, -0.2f, 0.4f);
  const float size = camera.pixel_size(point);
  const Vec2 a = seen(camera, point), b = seen(camera, point + camera.right * size),
             c = seen(camera, point + camera.up * size);
  EXPECT_NEAR((b.x - a.x) * 200, 1, 1e-3);
  EXPECT_NEAR((a.y - c.y) * 80, 1, 1e-3);
  EXPECT_LE(camera.pixel_size(camera.position - camera.forward), 0);
}

}  // namespace
}  // namespace sateen
