#include "integrator/made_scenes.h"

#include <map>
#include <utility>

#include "look/describe.h"
#include "look/read.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"

namespace sateen_test {

using namespace sateen;

const Look& shipped_look(const std::string& name) {
  static std::map<std::string, Look> read;
  const auto found = read.find(name);
  if (found != read.end()) return found->second;
  return read[name] = read_look(SATEEN_SOURCE_DIR "/looks/" + name + ".json");
}

Fabric fabric_of(const Look& look) {
  static std::map<std::string, Fabric> compiled;
  const auto [at, fresh] = compiled.try_emplace(look_hash(look));
  FabricParts parts;
  parts.threads = 2;
  if (fresh) at->second = compile_fabric(look, same_space, parts);
  return at->second;
}

Mesh shape(const std::string& name, int level) {
  return subdivide(built_in_shape(name), level, 2);
}

void add_quad(Mesh& mesh, const Vec3& middle, const Vec3& along, const Vec3& across, bool mirrored) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.quads.push_back({first, first + 1, first + 2, first + 3});
  const Vec3 normal = normalize(cross(along, across));
  const float v_way = mirrored ? -1.0f : 1.0f;
  for (const auto& [a, b] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}}) {
    mesh.positions.push_back(middle + along * (a - 0.5f) + across * (b - 0.5f));
    mesh.normals.push_back(normal);
    mesh.dpdu.push_back(along);
    mesh.dpdv.push_back(across * v_way);
    mesh.uvs.push_back(Vec2(a, mirrored ? 1 - b : b));
  }
}

Mesh floor_quad(float size) {
  Mesh mesh;
  add_quad(mesh, Vec3(0), Vec3(size, 0, 0), Vec3(0, 0, -size));
  return mesh;
}

Environment map_of(int width, int height, const std::function<Color(int, int)>& color, float rotation) {
  Image map(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = color(x, y)[c];
  EnvironmentOptions options;
  options.rotation = rotation;
  return build_environment(std::move(map), options);
}

Environment constant_map(float value) {
  return map_of(16, 8, [=](int, int) { return Color(value); });
}

Scene make_scene(Mesh mesh, Fabric front, Environment environment) {
  Scene scene;
  scene.mesh = std::make_unique<const Mesh>(std::move(mesh));
  scene.rays = std::make_unique<const RayTracer>(*scene.mesh, 2);
  scene.front = std::move(front);
  scene.environment = std::move(environment);
  scene.has_gaps = scene.front.gap > 0;
  renew_openness(scene);
  return scene;
}

Camera distant_camera(const Vec3& middle, const Vec3& towards, float extent, int width, int height) {
  const Vec3 back = normalize(towards);
  constexpr float far_away = 1e4f;
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.position = middle + back * far_away;
  camera.forward = -back;
  camera.right = normalize(cross(camera.forward, std::abs(back.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(0, 0, -1)));
  camera.up = cross(camera.right, camera.forward);
  camera.tan_x = camera.tan_y = extent / 2 / far_away;
  return camera;
}

std::vector<NamedSettings> all_settings(int bounces) {
  std::vector<NamedSettings> all;
  for (const std::string& name : strategy_names()) {
    const Strategy strategy = strategy_from_name(name);
    std::vector<CandidateCounts> candidates{8};
    if (strategy == Strategy::resampled) candidates = {1, 2, 8, {2, 16}, {8, 0}};
    for (const CandidateCounts& n : candidates)
      all.push_back({candidates.size() > 1 ? name + " of " + candidates_text(n) : name, {strategy, n, bounces}});
  }
  return all;
}

Look bright(const std::string& name) {
  Look look = shipped_look(name);
  for (ThreadFamily* f : {&look.warp, &look.weft}) {
    f->color.reset();
    f->A.value = Color(0.5f, 0.35f, 0.2f);
  }
  return look;
}

Environment soft_map() {
  return map_of(16, 8,
                [](int x, int y) { return Color(y < 4 ? 0.3f + 0.2f * float(x % 5) : 0.1f, 0.4f, 0.1f * float(y)); });
}

}  // namespace sateen_test
