#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "integrator/known_answers.h"
#include "integrator/vertex.h"

// Ground, lens and shutter against closed forms, a plain path tracer, and pictures that were rendered without them.

namespace sateen_test {
namespace {

using namespace sateen;

std::optional<Vertex> meet_any(const Scene& scene, const Ray& ray, const YTurn& object, const Ground* ground) {
  double choice = 0;
  return meet(scene, ray, object, ground,
              [&](const Hit& hit) { return bounced_cloth(scene, hit, ray, object, choice); });
}

void set_bounds(Mesh& mesh) {
  mesh.bounds_min = mesh.bounds_max = mesh.positions.empty() ? Vec3(0) : mesh.positions[0];
  for (const Vec3& p : mesh.positions)
    for (int k = 0; k < 3; ++k) {
      mesh.bounds_min[k] = std::min(mesh.bounds_min[k], p[k]);
      mesh.bounds_max[k] = std::max(mesh.bounds_max[k], p[k]);
    }
}

void put_ground(Scene& scene, GroundKind kind, const Color& color, float height) {
  scene.ground = compile_ground({kind, height, color}, *scene.mesh, scene.camera, scene.environment);
}

/// Nothing but ground, seen at a slant.
Scene bare(GroundKind kind, const Color& color, Environment map) {
  Scene scene = make_scene(Mesh(), fabric_of(bright("silk_crepe_de_chine")), std::move(map));
  scene.camera = distant_camera(Vec3(0, 0, 0), Vec3(0.2f, 0.6f, 1), 1e-4f);
  scene.ground = Ground{kind, 0, color};
  scene.ground->fade_from = 1e6f;
  scene.ground->fade_to = 2e6f;
  scene.ground->wall = 2;
  scene.ground->sweep = 1.5f;
  scene.ground->top = 3;
  scene.ground->open_sky = upward_irradiance(scene.environment) / pi;
  scene.ground->radius = 0.5f;
  return scene;
}

TEST(Floor, OfAlbedoOneUnderConstantWhiteIsWhite) {
  const Scene scene = bare(GroundKind::floor, Color(1), constant_map(1));
  for (const int bounces : {0, 3}) {
    const Estimate got = estimate(scene, {Strategy::mis_compensated, 4, bounces}, 16);
    for (const Batches& channel : got.channel) EXPECT_NEAR(channel.mean, 1, 1e-5);
    EXPECT_EQ(got.alpha, 1);
  }
}

// Light that has met the sweep often still adds up to one: false alarms 1e-4.
TEST(Cyclorama, OfAlbedoOneUnderConstantWhiteIsWhite) {
  Scene scene = bare(GroundKind::cyclorama, Color(1), constant_map(1));
  scene.camera = distant_camera(Vec3(0, 0.4f, -1.5f), Vec3(0.2f, 0.6f, 1), 1e-4f);
  const Estimate got = estimate(scene, {Strategy::mis_compensated, 4, 64}, 2048);
  expect_value(got, Color(1), sidak_deviate(1e-4, 3), 1e-5, "cyclorama");
  const Estimate once = estimate(scene, {Strategy::mis_compensated, 4, 0}, 2048);
  EXPECT_LT(once.channel[0].mean, 0.9) << "the sweep shades itself";
}

TEST(Floor, IsLitByEveryRayThatIsCounted) {
  const Scene scene = bare(GroundKind::floor, Color(0.5f), constant_map(1));
  const auto scratch = std::make_unique<PathScratch>();
  for (std::uint32_t k = 0; k < 10; ++k) trace_sample(scene, {}, 1, {0, 0, 0, k}, *scratch);
  EXPECT_EQ(scratch->counts.camera, 10);
  EXPECT_EQ(scratch->counts.shadow, 10);
}

// A square of cloth with sides of 1 at height h hides from the point below its middle the form factor of four
// quarters: 4 / (2 pi) (a / sqrt(1 + a^2) atan(b / sqrt(1 + a^2)) + ...), a = b = 1 / (2 h). False alarms 1e-4.
TEST(Catcher, TakesTheShareOfTheSkyThatIsHidden) {
  for (const float height : {0.2f, 0.5f, 2.0f}) {
    Mesh mesh = floor_quad();
    set_bounds(mesh);
    Scene scene = make_scene(std::move(mesh), fabric_of(bright("silk_crepe_de_chine")), constant_map(0.7f));
    // From below the cloth, so that the ground under it is seen.
    scene.camera = distant_camera(Vec3(0, -height, 0), Vec3(0.99f, 0.01f, 0), 1e-6f);
    scene.camera.position = Vec3(0.3f * height, -height + 0.01f * height, 0);
    scene.camera.forward = normalize(Vec3(0, -height, 0) - scene.camera.position);
    put_ground(scene, GroundKind::catcher, Color(0.4f), -height);
    const double a = 0.5 / double(height), r = std::sqrt(1 + a * a);
    const double hidden = 4 / (2 * M_PI) * 2 * a / r * std::atan(a / r);
    const auto scratch = std::make_unique<PathScratch>();
    Batches alpha;
    for (std::uint32_t b = 0; b < 16; ++b) {
      double sum = 0;
      for (std::uint32_t k = 0; k < 256; ++k) {
        const CameraSample s = trace_sample(scene, {}, b, {0, 0, int(k % 4), k / 4}, *scratch);
        EXPECT_EQ(s.total(), Color(0));
        sum += double(s.alpha) / 256;
      }
      alpha.add(sum);
    }
    EXPECT_LT(std::abs(difference_deviate(alpha, hidden)), sidak_deviate(1e-4, 3))
        << alpha.mean << ", expected " << hidden;
  }
}

TEST(Catcher, IsClearWhereNothingIsHidden) {
  const Scene scene = bare(GroundKind::catcher, Color(0.4f), soft_map());
  EXPECT_EQ(estimate(scene, {}, 16).alpha, 0);
}

struct PlainTracer {
  const Scene& scene;
  std::mt19937 random;

  double uniform() { return double(random()) * 0x1p-32; }

  Vec3 uniform_direction() {
    const auto z = float(1 - uniform());
    const float r = std::sqrt(1 - z * z), angle = float(2 * M_PI * uniform());
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

  Color arriving(const Vec3& origin, const Vec3& direction, int bounces) {
    const std::optional<Vertex> met = meet_any(scene, {origin, direction}, {}, solid_ground(scene));
    if (!met) return environment_radiance(scene.environment, direction);
    const auto* cloth = std::get_if<ClothPoint>(&*met);
    Color light(0);
    if (bounces > 0) light += leaving(*met, bounces - 1);
    if (cloth && cloth->fabric->gap > 0)
      light += arriving(offset_origin(cloth->surface, direction), direction, bounces) * cloth->fabric->gap;
    return light;
  }

  Color leaving(const Vertex& vertex, int bounces) {
    const Vec3 wi = uniform_direction();
    if (const auto* ground = std::get_if<GroundPoint>(&vertex)) {
      const Vec3 world = frame_from(ground->normal, Vec3(0, 0, 1)).to_world(wi);
      return scene.ground->albedo * arriving(ground->position, world, bounces) * (2 * wi.z);
    }
    const ClothPoint& point = std::get<ClothPoint>(vertex);
    const Vec3 world = point.frame.to_world(wi);
    if (dot(world, point.facing) <= 0) return Color(0);
    const Color f = scattered(*point.fabric, wi, point.wo);
    return f * arriving(offset_origin(point.surface, world), world, bounces) * (2 * pi);
  }
};

/// A sloping square of cloth above the ground; the camera sees a place of the one or of the other.
Scene sloped(Fabric fabric, GroundKind kind, bool see_ground) {
  Mesh mesh;
  add_quad(mesh, Vec3(0, 0.4f, 0), Vec3(0.8f, 0.3f, 0), Vec3(0, 0.2f, -0.9f));
  set_bounds(mesh);
  Scene scene = make_scene(std::move(mesh), std::move(fabric), soft_map());
  scene.camera = see_ground ? distant_camera(Vec3(0.25f, 0, 0.55f), Vec3(0.1f, 0.7f, 1), 0.01f)
                            : distant_camera(Vec3(-0.2f, 0.3f, 0.1f), Vec3(-0.3f, 1, 0.9f), 0.01f);
  put_ground(scene, kind, Color(0.7f, 0.5f, 0.3f), 0);
  return scene;
}

// False alarms 1e-4 for each test, Sidak over places, strategies, numbers of bounces and channels.
void expect_plain_answer(const Fabric& fabric, GroundKind kind, const std::string& name) {
  const std::vector<NamedSettings> all = all_settings();
  const std::vector<int> bounces{0, 1, 3};
  const double bound = sidak_deviate(1e-4, double(2 * all.size() * bounces.size() * 3));
  for (const bool see_ground : {false, true}) {
    const Scene scene = sloped(fabric, kind, see_ground);
    const Ray ray = scene.camera.ray(0.5f, 0.5f);
    const std::optional<Vertex> first = meet_any(scene, ray, {}, solid_ground(scene));
    ASSERT_TRUE(first);
    ASSERT_EQ(std::holds_alternative<GroundPoint>(*first), see_ground);
    for (const int n : bounces) {
      PlainTracer plain{scene, std::mt19937(11)};
      Batches expected[3];
      for (int b = 0; b < 64; ++b) {
        Vec3d sum(0);
        constexpr int samples = 2000;
        for (int k = 0; k < samples; ++k) sum += Vec3d(plain.leaving(*first, n));
        for (int c = 0; c < 3; ++c) expected[c].add(sum[c] / samples);
      }
      // What is seen through gaps of the first layer is no part of what leaves it.
      for (NamedSettings settings : all) {
        settings.light.bounces = n;
        const Estimate got = estimate(scene, settings.light, 256);
        for (int c = 0; c < 3; ++c)
          EXPECT_LT(std::abs(difference_deviate(got.channel[c], expected[c])), bound)
              << name << (see_ground ? ", ground, " : ", cloth, ") << settings.name << ", " << n
              << " bounces, channel " << c << ": " << got.channel[c].mean << " +- "
              << std::sqrt(got.channel[c].variance_of_mean()) << ", expected " << expected[c].mean << " +- "
              << std::sqrt(expected[c].variance_of_mean());
      }
    }
  }
}

TEST(Ground, AgreesWithAPlainPathTracerOnAFloor) {
  expect_plain_answer(fabric_of(bright("silk_crepe_de_chine")), GroundKind::floor, "floor");
}

TEST(Ground, AgreesWithAPlainPathTracerInACyclorama) {
  expect_plain_answer(fabric_of(bright("silk_crepe_de_chine")), GroundKind::cyclorama, "cyclorama");
}

// Light that passes sheer cloth meets the floor, and the floor's passes it on the way back. Seen is the floor alone.
TEST(Ground, AgreesWithAPlainPathTracerUnderSheerCloth) {
  Look look = bright("linen_plain");
  look.warp.coverage = 0.4f;
  look.weft.coverage = 0.25f;
  const Scene scene = sloped(fabric_of(look), GroundKind::floor, true);
  const std::optional<Vertex> first = meet_any(scene, scene.camera.ray(0.5f, 0.5f), {}, solid_ground(scene));
  PlainTracer plain{scene, std::mt19937(12)};
  Batches expected[3];
  for (int b = 0; b < 64; ++b) {
    Vec3d sum(0);
    for (int k = 0; k < 4000; ++k) sum += Vec3d(plain.leaving(*first, 2));
    for (int c = 0; c < 3; ++c) expected[c].add(sum[c] / 4000);
  }
  const Estimate got = estimate(scene, {Strategy::mis_compensated, 4, 2}, 1024);
  for (int c = 0; c < 3; ++c)
    EXPECT_LT(std::abs(difference_deviate(got.channel[c], expected[c])), sidak_deviate(1e-4, 3))
        << got.channel[c].mean;
}

/// Mean of a small picture, a batch a seed.
Batches picture_mean(const Scene& scene, const LightSettings& light, int samples, int batches = 16,
                     std::uint32_t first_seed = 5) {
  const auto scratch = std::make_unique<PathScratch>();
  Batches mean;
  for (int b = 0; b < batches; ++b) {
    double sum = 0;
    for (int y = 0; y < scene.camera.height; ++y)
      for (int x = 0; x < scene.camera.width; ++x)
        for (int k = 0; k < samples; ++k)
          sum += double(mean_component(
              trace_sample(scene, light, first_seed + std::uint32_t(b), {x, y, k % 4, std::uint32_t(k / 4)}, *scratch)
                  .total()));
    mean.add(sum / (scene.camera.width * scene.camera.height * samples));
  }
  return mean;
}

// Cloth takes light away: over a white floor under constant white no picture is brighter than white. False alarms
// 1e-4; the cloth's share of a tenth at least makes sure that the test can fail.
TEST(Ground, GivesNoMoreLightThanThereIs) {
  Scene scene = make_scene(shape("drape", 0), fabric_of(bright("silk_crepe_de_chine")), constant_map(1));
  scene.camera = frame_points(scene.mesh->positions, {}, 16, 9);
  scene.ground = compile_ground({GroundKind::floor, {}, Color(1)}, *scene.mesh, scene.camera, scene.environment);
  scene.backdrop = Backdrop::environment;
  const Batches dim = picture_mean(scene, {Strategy::mis_compensated, 4, 0}, 16);
  const Batches lit = picture_mean(scene, {Strategy::mis_compensated, 4, 16}, 16);
  EXPECT_LT(lit.mean, 1);
  EXPECT_GT(difference_deviate(lit, dim), 4) << "the floor lights the cloth";
  EXPECT_LT(dim.mean, 0.95);
}

// A picture through a lens stopped down converges to the pinhole's: the same numbers give nearly the same picture.
TEST(Lens, StoppedDownGivesThePinholesPicture) {
  Scene scene = make_scene(shape("drape", 1), fabric_of(bright("silk_crepe_de_chine")), soft_map());
  scene.camera = frame_points(scene.mesh->positions, {}, 24, 16);
  const Batches pinhole = picture_mean(scene, {}, 4, 4);
  double before = 1e9;
  for (const float f_stop : {0.5f, 8.0f, 1000.0f}) {
    LensSettings lens;
    lens.f_stop = f_stop;
    scene.lens = compile_lens(lens, *scene.mesh, *scene.rays, scene.camera);
    const auto scratch = std::make_unique<PathScratch>();
    double off = 0;
    Scene* s = &scene;
    const Lens kept = *scene.lens;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 24; ++x) {
        s->lens = kept;
        const Color through = trace_sample(scene, {}, 3, {x, y, 0, 0}, *scratch).total();
        s->lens.reset();
        off += double(std::abs(mean_component(through - trace_sample(scene, {}, 3, {x, y, 0, 0}, *scratch).total())));
      }
    off /= 16 * 24 * pinhole.mean;
    EXPECT_LT(off, before) << f_stop;
    before = off;
  }
  EXPECT_LT(before, 0.02);
}

// A turning sphere of a matte look that does not know its warp looks as one that stands still, whatever the light and
// however the ground takes its shadow; the mesh is round to a hundredth. False alarms 1e-4.
TEST(Shutter, LeavesABodyOfRevolutionAsItIs) {
  Look look = bright("silk_crepe_de_chine");
  Scene scene = make_scene(shape("sphere", 3), fabric_of(look), soft_map());
  scene.camera = frame_points(scene.mesh->positions, {}, 24, 16);
  put_ground(scene, GroundKind::cyclorama, Color(0.5f), scene.mesh->bounds_min.y - 0.1f);
  const LightSettings light{Strategy::mis_compensated, 4, 1};
  const Batches still = picture_mean(scene, light, 16);
  scene.shutter = Shutter{(scene.mesh->bounds_min + scene.mesh->bounds_max) * 0.5f, 2 * pi, 0};
  const Batches moving = picture_mean(scene, light, 16);
  EXPECT_NE(still.mean, moving.mean);
  EXPECT_NEAR(moving.mean, still.mean,
              0.003 * still.mean + 4 * std::sqrt(still.variance_of_mean() + moving.variance_of_mean()));
}

Mesh turned_mesh(Mesh mesh, const Vec3& pivot, double angle) {
  const YTurn t = turn_by(angle);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions[i] = pivot + turned(mesh.positions[i] - pivot, t);
    for (std::vector<Vec3>* v : {&mesh.normals, &mesh.dpdu, &mesh.dpdv}) (*v)[i] = turned((*v)[i], t);
  }
  return mesh;
}

// The mean of stills of a mesh that was really turned, over 64 angles, with bounces, gaps and ground; and of a camera
// that walks. False alarms 1e-4; what 64 angles miss of the mean is far below a hundredth.
TEST(Shutter, GivesTheMeanOfTheStills) {
  Look look = bright("linen_plain");
  look.warp.coverage = 0.6f;
  look.weft.coverage = 0.5f;
  Mesh mesh;
  add_quad(mesh, Vec3(0.3f, 0.4f, 0), Vec3(0.8f, 0.3f, 0), Vec3(0, 0.2f, -0.9f));
  set_bounds(mesh);
  const Vec3 pivot(0.1f, 0, 0.2f);
  constexpr float angle = 1.2f;
  constexpr int steps = 64;
  const LightSettings light{Strategy::mis_compensated, 4, 2};
  const auto scene_of_mesh = [&](const Mesh& m) {
    Scene scene = make_scene(m, fabric_of(look), soft_map());
    scene.backdrop = Backdrop::environment;
    scene.camera = distant_camera(Vec3(0.6f, 0.5f, 0), Vec3(0.1f, 0.7f, 1), 0.4f, 3, 3);
    scene.ground = Ground{GroundKind::cyclorama, 0, Color(0.7f, 0.5f, 0.3f)};
    scene.ground->wall = 1.5f;
    scene.ground->sweep = 0.5f;
    scene.ground->top = 2;
    return scene;
  };
  for (const bool camera : {false, true}) {
    Batches expected;
    std::vector<double> sums(4, 0.0);
    for (int k = 0; k < steps; ++k) {
      const double at = ((k + 0.5) / steps - 0.5) * double(angle);
      Scene still = scene_of_mesh(camera ? mesh : turned_mesh(mesh, pivot, at));
      if (camera) {
        const YTurn t = turn_by(at);
        Camera& c = still.camera;
        c.position = pivot + turned(c.position - pivot, t);
        for (Vec3* axis : {&c.right, &c.up, &c.forward}) *axis = turned(*axis, t);
      }
      sums[size_t(k % 4)] += picture_mean(still, light, 64, 4, 1000 + 4 * std::uint32_t(k)).mean * 4 / steps;
    }
    for (const double sum : sums) expected.add(sum);
    Scene moving = scene_of_mesh(mesh);
    moving.shutter = camera ? Shutter{pivot, 0, angle} : Shutter{pivot, angle, 0};
    const Batches got = picture_mean(moving, light, 256);
    // Every fourth angle sees the whole motion: their scatter is the error of the mean, and of its coarse angles.
    EXPECT_NEAR(got.mean, expected.mean, 4 * std::sqrt(got.variance_of_mean() + expected.variance_of_mean()))
        << (camera ? "camera" : "object");
    EXPECT_LT(std::sqrt(expected.variance_of_mean()), 0.01 * expected.mean);
    moving.shutter.reset();
    EXPECT_GT(std::abs(difference_deviate(picture_mean(moving, light, 256), got)), 5) << "the turn is seen";
  }
}

// Batches of any size and the scratch's past do not matter, with everything on.
TEST(Stage, HasTheSameBitsInAnyBatch) {
  Scene scene = make_scene(shape("drape", 1), fabric_of(bright("linen_plain")), soft_map());
  scene.camera = frame_points(scene.mesh->positions, {}, 12, 8);
  put_ground(scene, GroundKind::floor, Color(0.5f), scene.mesh->bounds_min.y - 0.01f);
  scene.lens = Lens{0.05f, 3, 5};
  scene.shutter = Shutter{Vec3(0), 0.3f, 0.1f};
  std::vector<SampleId> ids;
  for (int k = 0; k < batch_size; ++k) ids.push_back({k % 12, k / 12, k % 4, std::uint32_t(k)});
  const auto scratch = std::make_unique<PathScratch>();
  std::vector<CameraSample> together(ids.size());
  const LightSettings light{Strategy::resampled, 4, 2};
  trace_samples(scene, light, 9, ids, *scratch, together.data());
  for (size_t k = ids.size(); k-- > 0;) {
    const CameraSample alone = trace_sample(scene, light, 9, ids[k], *scratch);
    EXPECT_EQ(alone.total(), together[k].total()) << k;
    EXPECT_EQ(alone.alpha, together[k].alpha) << k;
  }
}

}  // namespace
}  // namespace sateen_test
