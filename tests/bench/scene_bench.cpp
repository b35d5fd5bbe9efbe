#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "base/files.h"
#include "base/parallel.h"
#include "bench.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "render/assemble.h"
#include "render/render.h"
#include "scene/environment_file.h"
#include "scene/filter.h"

namespace sateen::bench {

namespace {

volatile float sink;

Scene scene_of(const std::string& look, const std::string& map, int level, int width, SceneReport* out = nullptr) {
  SceneSettings settings;
  settings.look = look;
  settings.environment = map;
  settings.level = level;
  settings.width = width;
  settings.height = width * 9 / 16;
  SceneReport report;
  const ColorManager colors;
  Scene scene = assemble_scene(settings, colors, report);
  if (out) *out = report;
  return scene;
}

/// Resident set of this process [bytes].
double resident() {
  std::ifstream in("/proc/self/statm");
  double pages = 0, rss = 0;
  in >> pages >> rss;
  return rss * 4096;
}

}  // namespace

void environment() {
  const ColorManager colors;
  fmt::print("{:<22}{:>14}{:>12}{:>12}{:>12}\n", "map", "read CPU-s", "sample ns", "look-up ns", "pdf error");
  for (const char* name : {"studio_softboxes", "overcast", "low_sun", "three_light_rig"}) {
    const double start = cpu_seconds();
    const Environment map = read_environment(name, colors);
    const double read = cpu_seconds() - start;
    double worst = 0;
    const Sequence sequence = pixel_sequence(3, 1, 1, 0);
    std::vector<Vec3> directions;
    for (std::uint32_t i = 0; i < 4096; ++i) {
      const auto u = draw2(sequence, Dimension::environment, i);
      const EnvironmentSample s = sample_environment(map, EnvironmentDensity::compensated, u[0], u[1]);
      directions.push_back(s.direction);
      worst = std::max(
          worst, std::abs(double(environment_pdf(map, EnvironmentDensity::compensated, s.direction)) / s.pdf - 1));
    }
    require(worst < 1e-6, "density of a sample against its look-up");
    const double sample_ns =
        nanoseconds(
            15, 3,
            [&] {
              for (std::uint32_t i = 0; i < 4096; ++i) {
                const double a = i * 0.618033988749895;
                sink =
                    sample_environment(map, EnvironmentDensity::compensated, a - std::floor(a), (i + 0.5) / 4096).pdf;
              }
            }) /
        4096;
    const double look_ns = nanoseconds(15, 3,
                                       [&] {
                                         float sum = 0;
                                         for (const Vec3& d : directions)
                                           sum += environment_texel(map, d).density->pdf_compensated;
                                         sink = sum;
                                       }) /
                           4096;
    fmt::print("{:<22}{:>14.3f}{:>12.1f}{:>12.1f}{:>12.1e}\n", name, read, sample_ns, look_ns, worst);
  }
}

void rays() {
  fmt::print("rays per CPU-second of a render over bare Embree on the very same rays, one thread, one by one\n");
  fmt::print("{:<28}{:>10}{:>30}{:>12}{:>12}{:>12}{:>16}\n", "look", "triangles", "strategy", "Mray/s", "bare Mray/s",
             "efficiency", "min to max");
  struct Case {
    const char* look;
    int level;
  };
  for (const auto& [look, level] : {Case{"polyester_satin_charmeuse", 2},
                                    {"polyester_satin_charmeuse", 3},
                                    {"silk_crepe_de_chine", 3},
                                    {default_look, 3}}) {
    const Scene scene = scene_of(look, "studio_softboxes", level, 960);
    for (const auto& [strategy, bounces] : {std::pair(Strategy::mis, 0), std::pair(Strategy::mis_compensated, 0),
                                            std::pair(LightSettings().strategy, 0), std::pair(Strategy::mis, 3),
                                            std::pair(LightSettings().strategy, 3)}) {
      LightSettings light;
      light.strategy = strategy;
      light.bounces = bounces;
      auto scratch = std::make_unique<PathScratch>();
      // The rays of the picture's first samples, in the batches that a pass makes of them.
      constexpr int samples = 4;
      std::vector<SampleId> ids;
      for (int y = 0; y < scene.camera.height; ++y)
        for (int x = 0; x < scene.camera.width; ++x)
          for (int i = 0; i < samples; ++i) ids.push_back({x, y, i % replicates, std::uint32_t(i / replicates)});
      const auto render_all = [&] {
        float sum = 0;
        std::array<CameraSample, batch_size> out;
        for (size_t first = 0; first < ids.size(); first += batch_size) {
          const size_t count = std::min(ids.size() - first, size_t(batch_size));
          trace_samples(scene, light, 1, {&ids[first], count}, *scratch, out.data());
          for (size_t k = 0; k < count; ++k) sum += out[k].alpha + out[k].direct.surface[0].x;
        }
        sink = sum;
      };
      RayLog log;
      std::vector<Ray> camera;
      scratch->counts.log = &log;
      render_all();
      scratch->counts.log = nullptr;
      for (const SampleId& id : ids) {
        const Vec2 at = sample_filter(*compile_filter(),
                                      draw2(pixel_sequence(1, id.x, id.y, id.replicate), Dimension::film, id.index));
        camera.push_back(scene.camera.ray(float(id.x) + 0.5f + at.x, float(id.y) + 0.5f + at.y));
      }
      const double count = double(camera.size() + log.shadow.size() + log.bounce.size());
      require(scratch->counts.camera == std::int64_t(camera.size()), "number of camera rays");
      require(scratch->counts.bounce == std::int64_t(log.bounce.size()), "number of rays that bounce");
      const Pair pair = interleaved(5, render_all, [&] {
        int hits = 0;
        for (const Ray& ray : camera) hits += scene.rays->closest_hit(ray).has_value();
        for (const Ray& ray : log.bounce) hits += scene.rays->closest_hit(ray).has_value();
        for (const Ray& ray : log.shadow) hits += scene.rays->occluded(ray);
        sink = float(hits);
      });
      const std::string name =
          bounces > 0 ? fmt::format("{}, {} bounces", strategy_name(strategy), bounces) : strategy_name(strategy);
      fmt::print("{:<28}{:>10}{:>30}{:>12.2f}{:>12.2f}{:>12.3f}{:>9.3f} {:>6.3f}\n", look, scene.mesh->triangles(),
                 name, count / pair.a * 1e-6, count / pair.b * 1e-6, 1 / pair.ratio, 1 / pair.high, 1 / pair.low);
    }
  }
}

void strategies() {
  fmt::print(
      "E^2 x CPU-seconds at 64 samples (smaller is better), 240x135, drape at level 2; * the least of a row\n");
  struct Entry {
    Strategy strategy;
    CandidateCounts candidates;
    const char* label;
  };
  const Entry entries[] = {{Strategy::table, 1, "table"},
                           {Strategy::environment, 1, "environment"},
                           {Strategy::mis_talk, 1, "mis-talk"},
                           {Strategy::mis, 1, "mis"},
                           {Strategy::mis_compensated, 1, "mis-comp"},
                           {Strategy::resampled, 1, "res 1"},
                           {Strategy::resampled, 2, "res 2"},
                           {Strategy::resampled, 4, "res 4"},
                           {Strategy::resampled, 8, "res 8"},
                           {Strategy::resampled, {8, 4}, "res 8+4"},
                           {Strategy::resampled, {4, 16}, "res 4+16"},
                           {Strategy::resampled, {2, 8}, "res 2+8"}};
  fmt::print("{:<28}{:<20}", "look", "map");
  for (const Entry& e : entries) fmt::print("{:>12}", e.label);
  fmt::print("\n");
  std::vector<std::string> maps{"studio_softboxes", "overcast", "low_sun", "three_light_rig"};
  const std::filesystem::path shared = data_folder().parent_path() / "shared" / "hdri";
  for (const char* name : {"apartment", "studio", "interior", "city", "sky"})
    if (std::filesystem::exists(shared / (std::string(name) + ".exr")))
      maps.push_back((shared / (std::string(name) + ".exr")).string());
  for (const char* look : {"polyester_satin_charmeuse", "silk_crepe_de_chine"})
    for (const std::string& map : maps) {
      const Scene scene = scene_of(look, map, 2, 240);
      std::vector<double> cost;
      for (const Entry& e : entries) {
        RenderSettings settings;
        settings.light.strategy = e.strategy;
        settings.light.candidates = e.candidates;
        settings.stop.spp = 64;
        Film film(scene.camera.width, scene.camera.height, false);
        const RenderResult result = render(scene, settings, film);
        require(result.rays.non_finite == 0, "finite samples");
        cost.push_back(result.error.error * result.error.error * result.cpu_seconds);
      }
      const double least = *std::min_element(cost.begin(), cost.end());
      fmt::print("{:<28}{:<20}", look, std::filesystem::path(map).stem().string());
      for (const double c : cost) fmt::print("{:>11.5f}{}", c, c == least ? '*' : ' ');
      fmt::print("\n");
    }
}

void memory() {
  fmt::print("{:<26}{:>12}{:>12}{:>16}{:>16}{:>16}\n", "mesh", "triangles", "CPU-s", "B/tri, mesh", "B/tri, Embree",
             "B/tri, process");
  for (const int level : {2, 4}) {
    // A square cage of 177 x 177 quads, waved: 1M triangles at level 2, 16M at level 4.
    ControlMesh cage;
    constexpr int n = 177;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const float u = float(i) / n, v = float(j) / n;
        cage.positions.emplace_back(u, 0.03f * std::sin(20 * u) * std::cos(13 * v), v);
        cage.uvs.emplace_back(u, v);
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = j * (n + 1) + i;
        cage.face_sizes.push_back(4);
        for (const int k : {a, a + n + 1, a + n + 2, a + 1})
          cage.position_indices.push_back(k), cage.uv_indices.push_back(k);
      }
    const double before = resident(), start = cpu_seconds();
    auto mesh = std::make_unique<const Mesh>(subdivide(cage, level));
    auto tracer = std::make_unique<RayTracer>(*mesh);
    const double seconds = cpu_seconds() - start, triangles = double(mesh->triangles());
    const double own =
        double(mesh->quads.capacity() * 16 + mesh->positions.capacity() * 12 + mesh->normals.capacity() * 12 +
               mesh->dpdu.capacity() * 12 + mesh->dpdv.capacity() * 12 + mesh->uvs.capacity() * 8);
    require(triangles == 2.0 * n * n * std::pow(4.0, level), "number of triangles");
    fmt::print("{:<26}{:>12.0f}{:>12.2f}{:>16.1f}{:>16.1f}{:>16.1f}\n", fmt::format("177x177 at level {}", level),
               triangles, seconds, own / triangles, double(tracer->memory_bytes()) / triangles,
               (resident() - before) / triangles);
  }
}

void whole() {
  const auto start = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  SceneReport report;
  const Scene scene = scene_of(default_look, default_environment, -1, 960, &report);
  RenderSettings settings;
  settings.stop.spp = 64;
  Film film(960, 540, false);
  double first = 0;
  const RenderResult result = render(scene, settings, film, [&](const RenderState& state) {
    if (state.samples == 1) first = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  });
  fmt::print("default picture 960x540: scene {:.2f} CPU-s, first pass complete {:.2f} s after the program's main\n",
             cpu_seconds() - cpu - result.cpu_seconds, first);
  fmt::print("64 samples: {:.2f} CPU-s, {:.2f} s, E {:.4f} ({:.4f} to {:.4f}), {} triangles\n", result.cpu_seconds,
             result.seconds, result.error.error, result.error.low, result.error.high, report.triangles);
}

}  // namespace sateen::bench
