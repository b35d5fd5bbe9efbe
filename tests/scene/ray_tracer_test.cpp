#include "scene/ray_tracer.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "base/error.h"
#include "base/parallel.h"
#include "math/frame.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "scene/surface.h"

namespace sateen {
namespace {

Mesh mesh_of(std::vector<Vec3> positions, std::vector<std::array<std::uint32_t, 4>> quads) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.quads = std::move(quads);
  mesh.normals.assign(mesh.positions.size(), Vec3(0, 0, 1));
  mesh.dpdu.assign(mesh.positions.size(), Vec3(1, 0, 0));
  mesh.dpdv.assign(mesh.positions.size(), Vec3(0, 1, 0));
  for (const Vec3& p : mesh.positions) mesh.uvs.push_back(Vec2(p.x, p.y));
  return mesh;
}

/// A sphere of flat trapezoids, convex, with exact normals; `rows` by 2 rows.
Mesh round_mesh(int rows, double radius, const Vec3d& centre) {
  Mesh mesh;
  const int columns = 2 * rows;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const double theta = M_PI * j / rows, phi = 2 * M_PI * (i % columns) / columns;
      const Vec3d n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      mesh.positions.push_back(Vec3(centre + n * radius));
      mesh.normals.push_back(Vec3(n));
      mesh.dpdu.push_back(Vec3(float(-std::sin(phi)), 0, float(-std::cos(phi))));
      mesh.dpdv.push_back(cross(mesh.normals.back(), mesh.dpdu.back()));
      mesh.uvs.push_back(Vec2(float(i), float(j)));
    }
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t v = std::uint32_t(j * (columns + 1) + i), w = v + std::uint32_t(columns) + 1;
      if (j == 0)
        mesh.quads.push_back({v, w, w + 1, w + 1});
      else if (j == rows - 1)
        mesh.quads.push_back({v, w, v + 1, v + 1});
      else
        mesh.quads.push_back({v, w, w + 1, v + 1});
    }
  return mesh;
}

TEST(RayTracer, AHitInAPacketDoesNotDependOnItsCompanyAndAgreesWithTheSingleRay) {
  const Mesh mesh = round_mesh(60, 1, Vec3d(0.3, -0.2, 0.1));
  const RayTracer tracer(mesh);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> anywhere(-1.5f, 1.5f);
  for (int packet = 0; packet < 400; ++packet) {
    // Rays of one pixel, then rays from everywhere to everywhere; one of them broken.
    std::vector<Ray> rays(RayTracer::packet_size);
    const Vec3 eye(anywhere(random), anywhere(random), 5), to(anywhere(random), anywhere(random), 0);
    const float spread = packet % 2 ? 1e-3f : 1.0f;
    for (Ray& ray : rays) {
      ray.origin = packet % 4 == 3 ? Vec3(anywhere(random), anywhere(random), anywhere(random)) : eye;
      ray.direction = to - eye + Vec3(anywhere(random), anywhere(random), anywhere(random)) * spread;
    }
    if (packet % 5 == 0) rays[3].direction.y = std::numeric_limits<float>::quiet_NaN();
    Hit all[RayTracer::packet_size];
    bool found[RayTracer::packet_size];
    tracer.closest_hits(rays, all, found);
    for (size_t k = 0; k < rays.size(); ++k) {
      Hit alone;
      bool found_alone = false;
      tracer.closest_hits({&rays[k], 1}, &alone, &found_alone);
      ASSERT_EQ(found_alone, found[k]);
      const std::optional<Hit> single = tracer.closest_hit(rays[k]);
      ASSERT_EQ(single.has_value(), found[k]) << "packet " << packet << " ray " << k;
      if (!found[k]) continue;
      EXPECT_EQ(alone.quad, all[k].quad);
      EXPECT_EQ(alone.t, all[k].t);
      EXPECT_EQ(alone.u, all[k].u);
      EXPECT_EQ(alone.v, all[k].v);
      EXPECT_NEAR(single->t, all[k].t, 1e-5f * all[k].t);
    }
  }
}

TEST(RayTracer, WhatBlocksAShadowRayDoesNotDependOnTheOtherRaysOfItsStream) {
  const Mesh mesh = round_mesh(300, 1, Vec3d(0.3, -0.2, 0.1));
  const RayTracer tracer(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(-1, 1);
  int blocked = 0, rays_traced = 0;
  for (int stream = 0; stream < 500; ++stream) {
    std::vector<Ray> rays(size_t(1 + stream % RayTracer::stream_size));
    for (Ray& ray : rays) {
      // From points of the surface to everywhere, most of them grazing.
      const std::uint32_t vertex = std::uint32_t(random() % mesh.positions.size());
      const Vec3& n = mesh.normals[vertex];
      ray.direction = Vec3(anywhere(random), anywhere(random), anywhere(random));
      ray.direction -= n * dot(n, ray.direction) * (stream % 3 ? 0.999f : 0.5f);
      ray.origin = mesh.positions[vertex] + n * 1e-6f;
    }
    if (stream % 7 == 0) rays[0].origin.x = std::numeric_limits<float>::infinity();
    bool together[RayTracer::stream_size];
    tracer.occluded_each(rays, together);
    for (size_t k = 0; k < rays.size(); ++k) {
      bool alone;
      tracer.occluded_each({&rays[k], 1}, &alone);
      ASSERT_EQ(alone, together[k]) << "stream " << stream << " ray " << k;
      ASSERT_EQ(tracer.occluded(rays[k]), together[k]) << "stream " << stream << " ray " << k;
      blocked += alone;
    }
    rays_traced += int(rays.size());
  }
  EXPECT_GT(blocked, rays_traced / 10);
  EXPECT_LT(blocked, rays_traced * 9 / 10);
}

TEST(RayTracer, WhatPassesIsTheProductOverAllSurfacesThatARayMeetsOneAfterAnother) {
  const Mesh mesh = round_mesh(60, 1, Vec3d(0.3, -0.2, 0.1));
  const RayTracer tracer(mesh);
  const auto share = [](const Hit& hit, const Ray&) { return 0.2f + 0.7f * hit.u; };
  std::mt19937 random(6);
  std::uniform_real_distribution<float> anywhere(-1, 1);
  int met = 0;
  for (int stream = 0; stream < 200; ++stream) {
    std::vector<Ray> rays(size_t(1 + stream % RayTracer::stream_size));
    for (Ray& ray : rays) {
      ray.origin = Vec3(anywhere(random), anywhere(random), anywhere(random)) * 2.0f;
      ray.direction = Vec3(anywhere(random), anywhere(random), anywhere(random));
    }
    if (stream % 7 == 0) rays[0].origin.x = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> together(rays.size());
    tracer.passed_each(rays, share, together.data());
    for (size_t k = 0; k < rays.size(); ++k) {
      float alone;
      tracer.passed_each({&rays[k], 1}, share, &alone);
      ASSERT_EQ(alone, together[k]);
      float expected = 1;
      Ray ray = rays[k];
      while (const std::optional<Hit> hit = tracer.closest_hit(ray)) {
        expected *= share(*hit, ray);
        ray.origin = offset_origin(surface_point(mesh, *hit), ray.direction);
        ++met;
      }
      // The last bits of a place on a quad depend on where the ray began.
      ASSERT_NEAR(together[k], expected, 2e-4f);
    }
  }
  EXPECT_GT(met, 2000);
}

TEST(RayTracer, NothingPassesAnOpaqueSurfaceAndLessThanAMillionthIsNothing) {
  std::vector<Vec3> corners;
  std::vector<std::array<std::uint32_t, 4>> quads;
  for (std::uint32_t k = 0; k < 4; ++k) {
    for (const auto& [x, y] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
      corners.push_back({x, y, float(k)});
    quads.push_back({4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3});
  }
  const Mesh mesh = mesh_of(corners, quads);
  const RayTracer tracer(mesh);
  const Ray ray{{0.2f, 0.3f, -1}, {0, 0, 1}};
  const auto passed = [&](const RayTracer::ShareAt& share) {
    float result;
    tracer.passed_each({&ray, 1}, share, &result);
    return result;
  };
  EXPECT_EQ(passed([](const Hit&, const Ray&) { return 0.5f; }), 0.0625f);
  EXPECT_EQ(passed([](const Hit& hit, const Ray&) { return hit.quad == 2 ? 0.0f : 1.0f; }), 0);
  EXPECT_EQ(passed([](const Hit&, const Ray&) { return 1.0f; }), 1);
  EXPECT_EQ(passed([](const Hit&, const Ray&) { return 0.03f; }), 0) << "8.1e-7";
}

TEST(RayTracer, TheCornersOfAQuadHaveTheDocumentedCoordinates) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  const RayTracer tracer(mesh);
  for (const Vec2& p : {Vec2(0.1f, 0.1f), Vec2(0.9f, 0.05f), Vec2(0.95f, 0.9f), Vec2(0.02f, 0.9f), Vec2(0.3f, 0.3f),
                        Vec2(0.7f, 0.7f)}) {
    const auto hit = tracer.closest_hit({Vec3(2 * p.x, p.y, 3), Vec3(0, 0, -2)});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->quad, 0u);
    EXPECT_NEAR(hit->t, 1.5f, 1e-6);
    EXPECT_NEAR(hit->u, p.x, 1e-6);
    EXPECT_NEAR(hit->v, p.y, 1e-6);
  }
}

TEST(RayTracer, InterpolationOnABentQuadFollowsTheTriangleThatWasHit) {
  // Corner 2 is lifted: the triangle (1, 2, 3) slopes, (0, 1, 3) lies flat.
  Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2, 3}});
  const RayTracer tracer(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.001f, 0.999f);
  for (int i = 0; i < 1000; ++i) {
    const float x = uniform(random), y = uniform(random);
    const auto hit = tracer.closest_hit({Vec3(x, y, 3), Vec3(0, 0, -1)});
    ASSERT_TRUE(hit);
    const SurfacePoint point = surface_point(mesh, *hit);
    EXPECT_NEAR(point.position.x, x, 2e-6);
    EXPECT_NEAR(point.position.y, y, 2e-6);
    EXPECT_NEAR(point.position.z, std::max(0.0f, x + y - 1), 4e-6);
    EXPECT_NEAR(point.position.z, 3 - hit->t, 4e-6);
    EXPECT_NEAR(point.uv.x, x, 2e-6);
    EXPECT_NEAR(point.uv.y, y, 2e-6);
    const Vec3 normal = x + y > 1 ? Vec3(-1, -1, 1).normalized() : Vec3(0, 0, 1);
    if (std::abs(x + y - 1) > 1e-4f) {
      EXPECT_NEAR((point.geometric_normal - normal).length(), 0, 1e-6);
    }
  }
}

TEST(RayTracer, TrianglesRepeatTheirLastCorner) {
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 2}});
  const RayTracer tracer(mesh);
  const auto hit = tracer.closest_hit({Vec3(0.25f, 0.5f, 1), Vec3(0, 0, -1)});
  ASSERT_TRUE(hit);
  EXPECT_NEAR((surface_point(mesh, *hit).position - Vec3(0.25f, 0.5f, 0)).length(), 0, 1e-6);
  EXPECT_FALSE(tracer.closest_hit({Vec3(0.75f, 0.5f, 1), Vec3(0, 0, -1)}));
}

TEST(RayTracer, RaysThatAreNotFiniteMissWithoutReachingEmbree) {
  const Mesh mesh = mesh_of({{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}, {{0, 1, 2, 3}});
  const RayTracer tracer(mesh);
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Ray good{Vec3(0, 0, 1), Vec3(0, 0, -1)};
  ASSERT_TRUE(tracer.closest_hit(good));
  ASSERT_TRUE(tracer.occluded(good));
  for (const float bad : {nan, inf, -inf})
    for (int k = 0; k < 6; ++k) {
      Ray ray = good;
      (k < 3 ? ray.origin[k] : ray.direction[k - 3]) = bad;
      EXPECT_FALSE(tracer.closest_hit(ray));
      EXPECT_FALSE(tracer.occluded(ray));
    }
  for (Ray ray : {Ray{good.origin, good.direction, nan, 1}, Ray{good.origin, good.direction, 0, nan},
                  Ray{good.origin, good.direction, 2, 1}, Ray{good.origin, Vec3(0, 0, 0)}}) {
    EXPECT_FALSE(tracer.closest_hit(ray));
    EXPECT_FALSE(tracer.occluded(ray));
  }
  EXPECT_TRUE(tracer.occluded({Vec3(0, 0, 1), Vec3(0, 0, -1), 0, inf})) << "an endless ray is fine";
  EXPECT_FALSE(tracer.occluded({Vec3(0, 0, 1), Vec3(0, 0, -1), 0, 0.5f}));
  EXPECT_TRUE(tracer.closest_hit({Vec3(3e38f, 0, 0) * 1e-38f, Vec3(-3e38f, 0, 0) * 1e-38f}) == std::nullopt);
}

TEST(RayTracer, RefusesVerticesThatAreNotFiniteAndQuadsThatPointNowhere) {
  const auto error = [](const Mesh& mesh) {
    try {
      const RayTracer tracer(mesh);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error(mesh_of({{0, 0, 0}, {1, 0, 0}, {NAN, 1, 0}}, {{0, 1, 2, 2}})),
            "error: vertex 2 is at (nan, 1, 0), expected finite numbers below 1.8e18");
  EXPECT_EQ(error(mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2, 3}})),
            "error: quad 0 uses vertex 3, expected 0 to 2");
  EXPECT_EQ(error(mesh_of({}, {})), "no error");
}

TEST(RayTracer, AnEmptyMeshAndSliversAreMissedNotCrashedInto) {
  const Mesh empty;
  EXPECT_FALSE(RayTracer(empty).occluded({Vec3(0, 0, 1), Vec3(0, 0, -1)}));
  const Mesh sliver =
      mesh_of({{0, 0, 0}, {1e-20f, 0, 0}, {0, 1e-20f, 0}, {0, 0, 0}, {0, 0, 0}}, {{0, 1, 2, 2}, {3, 3, 4, 4}});
  const RayTracer tracer(sliver);
  const auto hit = tracer.closest_hit({Vec3(2e-21f, 2e-21f, 1), Vec3(0, 0, -1)});
  EXPECT_TRUE(!hit || std::isfinite(hit->t));
}

TEST(RayTracer, WatertightAlongSharedEdgesAndSplitSeams) {
  // From inside a closed shape, rays aimed at points on its edges never get out. Exactly through a vertex about 1 in
  // 100 do (Embree's robust mode promises edges only); without that mode it is 1 in 8 on edges, 1 in 3 at vertices.
  const Mesh mesh = subdivide(built_in_shape("sphere"), 2);
  const RayTracer tracer(mesh);
  const Vec3 centre(0.001f, 0.1503f, -0.002f);
  int edge_rays = 0, lost_at_edges = 0, lost_at_vertices = 0;
  for (const auto& q : mesh.quads)
    for (size_t k = 0; k < 4; ++k) {
      const Vec3 a = mesh.positions[q[k]], b = mesh.positions[q[(k + 1) % 4]];
      lost_at_vertices += !tracer.occluded({centre, a - centre});
      for (const float f : {0.137f, 0.5f, 0.9f}) {
        ++edge_rays;
        lost_at_edges += !tracer.occluded({centre, a + (b - a) * f - centre});
      }
    }
  EXPECT_GT(edge_rays, 70000);
  EXPECT_EQ(lost_at_edges, 0);
  EXPECT_LT(lost_at_vertices, edge_rays / 3 / 50);
  std::mt19937 random(8);
  std::normal_distribution<float> normal;
  int lost = 0;
  for (int i = 0; i < 300000; ++i)
    lost += !tracer.occluded({centre, Vec3(normal(random), normal(random), normal(random))});
  EXPECT_EQ(lost, 0);
}

TEST(RayTracer, ReportsWhatEmbreeHolds) {
  const Mesh mesh = round_mesh(100, 1, Vec3d(0));
  const RayTracer tracer(mesh, 2);
  const double bytes = double(tracer.memory_bytes()) / double(mesh.triangles());
  EXPECT_GT(bytes, 20);
  EXPECT_LT(bytes, 60);
  EXPECT_GE(tracer.peak_memory_bytes(), tracer.memory_bytes());
}

TEST(RayTracer, WorksWhereTheMeshLeftNoRoomBehindItsLastPosition) {
  Mesh mesh = round_mesh(10, 1, Vec3d(0));
  mesh.positions.shrink_to_fit();
  ASSERT_EQ(mesh.positions.capacity(), mesh.positions.size());
  EXPECT_TRUE(RayTracer(mesh).occluded({Vec3(0, 0, 3), Vec3(0, 0, -1)}));
}

/// Rays that leave a convex shape on its outer side meet nothing; any hit is a self-hit.
void expect_no_self_hits(double radius, const Vec3d& centre, double least_cosine) {
  const Mesh mesh = round_mesh(64, radius, centre);
  const RayTracer tracer(mesh, 1);
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(0, 1);
  int tested = 0, self_hits = 0;
  while (tested < 40000) {
    const Vec3d from(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
    const Vec3 origin(centre + from.normalized() * (3 * radius)),
        target(centre + Vec3d(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5) * radius);
    const auto hit = tracer.closest_hit({origin, target - origin});
    if (!hit) continue;
    const SurfacePoint point = surface_point(mesh, *hit);
    const Frame frame = frame_from(point.geometric_normal, Vec3(1, 0, 0));
    // Half of them grazing, down to the least cosine.
    const float z =
        tested % 2 ? float(least_cosine) * (1 + 4 * uniform(random)) : std::max(uniform(random), float(least_cosine));
    const float phi = 2 * pi * uniform(random), r = std::sqrt(std::max(0.0f, 1 - z * z));
    const Vec3 direction = frame.to_world(Vec3(r * std::cos(phi), r * std::sin(phi), z));
    ++tested;
    const auto again = tracer.closest_hit({offset_origin(point, direction), direction});
    if (again) ++self_hits;
  }
  EXPECT_EQ(self_hits, 0) << "radius " << radius << ", centre " << centre.x;
}

TEST(Offset, NoRayMeetsTheSphereThatItLeavesAtAnyScale) {
  for (const double radius : {1e-6, 1e-3, 0.15, 1.0, 37.0, 1e3, 1e5}) expect_no_self_hits(radius, Vec3d(0), 1e-4);
}

TEST(Offset, NoRayMeetsTheSphereThatItLeavesFarFromTheOrigin) {
  // At d sizes from the origin the vertices themselves are rounded to d * 6e-8 of the size, which bends a quad of
  // 1/20 of the size by 20 times that: rays flatter than this truly meet the bent neighbour.
  for (const double radius : {1e-3, 1.0, 1e5})
    for (const double sizes : {10.0, 1e3, 1e4})
      expect_no_self_hits(radius, Vec3d(1, -0.7, 0.4) * (sizes * radius), std::max(1e-4, sizes * 1.2e-7 * 100));
}

TEST(Offset, IsAFewRoundingsAndNoMore) {
  const Mesh mesh = round_mesh(64, 1, Vec3d(0));
  const RayTracer tracer(mesh, 1);
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from = Vec3(normal(random), normal(random), normal(random)).normalized() * 2;
    const auto hit = tracer.closest_hit({from, -from});
    ASSERT_TRUE(hit);
    const SurfacePoint point = surface_point(mesh, *hit);
    const Vec3 out = offset_origin(point, from), in = offset_origin(point, -from);
    EXPECT_GT(dot(out - point.position, point.geometric_normal), 0);
    EXPECT_LT(dot(in - point.position, point.geometric_normal), 0);
    EXPECT_LT((out - point.position).length(), 1e-6);
    EXPECT_LT((in - point.position).length(), 1e-6);
  }
}

TEST(Offset, LayersThatLieCloseTogetherStillShadowOneAnother) {
  for (const float scale : {1e-3f, 1.0f, 1e5f}) {
    for (const float gap : {1e-4f, 1e-5f}) {
      std::vector<Vec3> p;
      for (const float z : {0.0f, gap})
        for (const Vec2& c : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
          p.push_back(Vec3(c.x, c.y, z + 0.37f * c.x) * scale);
      const Mesh mesh = mesh_of(std::move(p), {{0, 1, 2, 3}, {4, 5, 6, 7}});
      const RayTracer tracer(mesh, 1);
      std::mt19937 random(2);
      std::uniform_real_distribution<float> uniform(0.1f, 0.9f);
      int lit = 0;
      for (int i = 0; i < 5000; ++i) {
        const auto hit = tracer.closest_hit({Vec3(uniform(random), uniform(random), -2) * scale, Vec3(0, 0, 1)});
        ASSERT_TRUE(hit);
        ASSERT_EQ(hit->quad, 0u);
        const SurfacePoint point = surface_point(mesh, *hit);
        const Vec3 direction(0.2f, -0.1f, 1);
        lit += !tracer.occluded({offset_origin(point, direction), direction});
        EXPECT_FALSE(tracer.occluded({offset_origin(point, -direction), -direction}));
      }
      EXPECT_EQ(lit, 0) << "scale " << scale << " gap " << gap;
    }
  }
}

TEST(Offset, LargeFacesAreNotMetNearTheOriginEither) {
  // Near the origin a position rounds to next to nothing, but Embree still computes with corners a size away.
  const Mesh mesh =
      mesh_of({{-1, -1.03f, 0.27f}, {1, -0.97f, -0.31f}, {1, 1.02f, -0.29f}, {-1, 0.99f, 0.3f}}, {{0, 1, 2, 3}});
  const RayTracer tracer(mesh, 1);
  std::mt19937 random(4);
  std::uniform_real_distribution<float> uniform(-1, 1);
  int self_hits = 0;
  for (int i = 0; i < 100000; ++i) {
    const float x = uniform(random) * std::pow(10.0f, -6 * std::abs(uniform(random)));
    const auto hit = tracer.closest_hit({Vec3(x, 0.5f * x, 2), Vec3(0, 0, -1)});
    if (!hit) continue;
    const SurfacePoint point = surface_point(mesh, *hit);
    const Frame frame = frame_from(point.geometric_normal, Vec3(1, 0, 0));
    const float phi = pi * uniform(random), z = 0.05f;
    const Vec3 direction = frame.to_world(Vec3(std::cos(phi), std::sin(phi), z));
    const auto again = tracer.closest_hit({offset_origin(point, direction), direction, 0, 0.01f});
    self_hits += again.has_value();
  }
  EXPECT_EQ(self_hits, 0);
}

TEST(RayTracer, OfOneThreadDoesNotHoldEverybodyElseToOne) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor";
  const Mesh mesh = mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}});
  const RayTracer tracer(mesh, 1);
  std::atomic<int> under_way = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto late = [&] { return std::chrono::steady_clock::now() - start > std::chrono::seconds(20); };
  parallel_for(2, 2, [&](int) {
    ++under_way;
    while (under_way < 2 && !late()) std::this_thread::yield();
  });
  EXPECT_FALSE(late()) << "the second call waited for the first";
}

}  // namespace
}  // namespace sateen
