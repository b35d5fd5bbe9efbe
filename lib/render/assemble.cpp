#include "render/assemble.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <future>

#include "base/error.h"
#include "base/files.h"
#include "base/nearest_name.h"
#include "base/parallel.h"
#include "look/describe.h"
#include "look/read.h"
#include "mesh/obj.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "scene/compile_cloth.h"
#include "scene/environment_file.h"
#include "scene/near_weave.h"

namespace sateen {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Values>
void hash_values(Hash& hash, const Values& values) {
  hash.add_bytes(values.data(), values.size() * sizeof(values[0]));
}

std::string hash_mesh(const ControlMesh& cage) {
  Hash hash;
  hash_values(hash, cage.positions);
  hash_values(hash, cage.uvs);
  hash_values(hash, cage.face_sizes);
  hash_values(hash, cage.position_indices);
  hash_values(hash, cage.uv_indices);
  hash_values(hash, cage.holes);
  for (const ControlMesh::Crease& crease : cage.creases) {
    hash_values(hash, crease.vertices);
    hash.add_bytes(&crease.sharpness, sizeof crease.sharpness);
  }
  for (const ControlMesh::Corner& corner : cage.corners) {
    hash.add_bytes(&corner.vertex, sizeof corner.vertex);
    hash.add_bytes(&corner.sharpness, sizeof corner.sharpness);
  }
  return hash.add(fmt::format("{} {} {}", int(cage.scheme), int(cage.boundary), int(cage.fvar_boundary))).hex();
}

// Vertices lie on the limit surface and carry its normals, so an edge of 3 pixels on a fold of 20 pixels' radius is
// off by a twentieth of a pixel at the silhouette and by nothing in the shading.
constexpr float longest_edge_pixels = 3;

struct Cloth {
  std::unique_ptr<const Mesh> mesh;
  std::unique_ptr<const RayTracer> rays;
  Camera camera;
};

ControlMesh read_cage(const std::string& name) {
  if (is_built_in_shape(name)) return built_in_shape(name);
  std::error_code code;
  // A word without a folder or an extension was meant as a name.
  if (!std::filesystem::exists(name, code) && name.find_first_of("/.") == std::string::npos)
    throw InputError(fmt::format("there is no mesh called {}", name),
                     suggestion(name, built_in_shapes()) + " (or the path of an OBJ)", InputError::Kind::unreadable);
  return read_obj(name);
}

Cloth build_cloth(const SceneSettings& settings, SceneReport& report) {
  const double start = now();
  const ControlMesh cage = read_cage(settings.mesh);
  report.mesh_hash = hash_mesh(cage);
  report.cage_faces = std::int64_t(cage.face_sizes.size());
  Cloth cloth;
  // The cage encloses the surface closely enough to choose the level by; the framing is then made exact.
  const Camera rough = frame_points(cage.positions, settings.camera, settings.width, settings.height);
  report.level = settings.level >= 0
                     ? settings.level
                     : automatic_level(
                           cage, [&](const Vec3& p) { return rough.pixel_size(p); }, longest_edge_pixels);
  auto mesh = std::make_unique<Mesh>(subdivide(cage, report.level, settings.threads));
  report.triangles = mesh->triangles();
  report.metres_per_uv = settings.uv_metres > 0 ? settings.uv_metres : mesh->metres_per_uv;
  report.warnings.insert(report.warnings.end(), mesh->warnings.begin(), mesh->warnings.end());
  if (mesh->fallback_warps > 0)
    report.warnings.push_back(
        fmt::format("{}: {} of {} vertices have no usable UVs: their warp follows the object's X axis", settings.mesh,
                    mesh->fallback_warps, mesh->positions.size()));
  cloth.camera = frame_points(mesh->positions, settings.camera, settings.width, settings.height);
  cloth.mesh = std::move(mesh);
  report.mesh_seconds = now() - start;
  cloth.rays = std::make_unique<const RayTracer>(*cloth.mesh, settings.threads);
  report.tracer_seconds = now() - start - report.mesh_seconds;
  report.tracer_bytes = cloth.rays->memory_bytes();
  return cloth;
}

float uv_metres(const SceneReport& report) {
  return report.metres_per_uv > 0 ? report.metres_per_uv : 1;
}

/// How large the cloth is and from how near its threads show.
void settle_weave(const SceneSettings& settings, bool sized_textures, Scene& scene, SceneReport& report) {
  scene.metres_per_uv = uv_metres(report);
  scene.near_weave_pixel = near_weave_pixel(scene);
  const bool threads = scene.near_weave_pixel > 0 && may_show_yarns(scene);
  if (report.metres_per_uv > 0 || !(threads || sized_textures)) return;
  report.warnings.push_back(
      fmt::format("{}: nothing says how large the cloth is; its {} as if one UV unit were a metre (--uv-metres)",
                  settings.mesh, sized_textures ? "textures are sized" : "threads are counted"));
}

std::string hash_environment(const Environment& environment) {
  Hash hash;
  for (const Environment::Texel& texel : environment.texels) hash.add_bytes(&texel.radiance, sizeof texel.radiance);
  return hash.add(fmt::format("{}x{}", environment.width, environment.height)).hex();
}

}  // namespace

Scene assemble_scene(const SceneSettings& settings, const ColorManager& colors, SceneReport& report) {
  const Look look = read_look(settings.look, settings.look_overrides);
  report.look = look;
  if (!look.textures.contains("warp_angle_deg")) report.look.warp_angle_deg += settings.warp_angle_deg;
  report.look_hash = look_hash(report.look);
  const auto add_hash = [&](const Look& other) {
    report.look_hash = Hash().add(report.look_hash).add(look_hash(other)).hex();
  };
  if (!look.back.empty()) add_hash(read_back(look));
  if (!look.pattern_look.empty()) add_hash(read_pattern(look));

  // Each part reports into fields of its own, the mesh alone into `warnings`.
  std::future<Cloth> cloth = std::async(std::launch::async, [&] { return build_cloth(settings, report); });
  std::future<Environment> environment = std::async(std::launch::async, [&] {
    const double start = now();
    EnvironmentFileOptions options;
    options.color_space = settings.environment_space;
    options.rotation_deg = settings.environment_rotation_deg;
    options.exposure_ev = settings.environment_ev;
    Environment map = read_environment(settings.environment, colors, options);
    report.environment_seconds = now() - start;
    return map;
  });
  Scene scene;
  const double start = now();
  FabricParts parts;
  parts.threads = settings.threads;
  std::exception_ptr failure;
  std::vector<std::string> warnings;
  bool sized_textures = false;
  try {
    std::optional<Look> back_look;
    if (!look.back.empty()) back_look = read_back(look);
    sized_textures = has_sized_textures(look) || (back_look && has_sized_textures(*back_look));
    if (sized_textures) cloth.wait();
    const float metres = sized_textures ? uv_metres(report) : 1;
    CompiledSide front = compile_side(look, colors, parts, settings.warp_angle_deg, metres);
    std::optional<CompiledSide> back;
    if (back_look) back = compile_side(*back_look, colors, parts, 0, metres);
    warnings = front.warnings;
    if (back) warnings.insert(warnings.end(), back->warnings.begin(), back->warnings.end());
    set_sides(scene, std::move(front), std::move(back));
  } catch (...) {
    failure = std::current_exception();  // the other two still hold references to this frame
  }
  report.look_seconds = now() - start;
  cloth.wait();
  environment.wait();
  if (failure) std::rethrow_exception(failure);

  Cloth built = cloth.get();
  scene.mesh = std::move(built.mesh);
  scene.rays = std::move(built.rays);
  scene.camera = built.camera;
  scene.environment = environment.get();
  scene.backdrop = settings.backdrop;
  scene.backdrop_color = settings.backdrop_color;
  settle_weave(settings, sized_textures, scene, report);
  report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
  set_stage(scene, settings.stage, settings.threads);
  report.environment_hash = hash_environment(scene.environment);
  report.metered_ev = metered_exposure_ev(scene.environment);
  return scene;
}

}  // namespace sateen
