#include "render/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>

#include "base/error.h"
#include "base/files.h"
#include "base/memory.h"
#include "base/missing_file.h"
#include "base/nearest_name.h"
#include "base/parallel.h"
#include "look/describe.h"
#include "look/read.h"
#include "mesh/extent.h"
#include "mesh/obj.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "mesh/weld.h"
#include "render/exposure.h"
#include "scene/compile_cloth.h"
#include "scene/environment_file.h"
#include "scene/environment_inspect.h"
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
  // Positions far from the origin are read as they lie around it.
  if (!cage.placement.is_identity()) hash.add_bytes(&cage.placement.origin, sizeof cage.placement.origin);
  return hash.add(fmt::format("{} {} {}", int(cage.scheme), int(cage.boundary), int(cage.fvar_boundary))).hex();
}

// Nobody asked for a finer mesh: it may take half of the memory and no more triangles than Embree builds in seconds.
std::int64_t most_quads() {
  return std::min<std::int64_t>(20'000'000, memory_limit() / 2 / bytes_per_quad);
}

struct Cloth {
  std::unique_ptr<const Mesh> mesh;
  std::unique_ptr<const RayTracer> rays;
  Camera camera;
};

ControlMesh read_cage(const std::string& name) {
  if (is_built_in_shape(name)) return built_in_shape(name);
  const std::filesystem::path path = name;
  std::error_code code;
  if (std::filesystem::exists(path, code)) return read_obj(name);
  // A word without a folder or an extension was meant as a name.
  const bool is_word = name.find_first_of("/.") == std::string::npos;
  std::string help = missing_file_help(path, ".obj");
  if (help.empty()) help = suggestion(path.stem().string(), built_in_shapes()) + " (or the path of an OBJ)";
  throw InputError(is_word ? fmt::format("there is no mesh called {}", name) : fmt::format("{}: no such file", name),
                   help, InputError::Kind::unreadable);
}

Cloth build_cloth(const SceneSettings& settings, SceneReport& report) {
  const double start = now();
  ControlMesh cage = read_cage(settings.mesh);
  if (settings.up == "z") stand_up(cage);
  if (settings.weld) {
    const Touching touching = weld_borders(cage);
    if (touching.edges == 0)
      report.warnings.push_back(fmt::format("{}: no borders coincide: there is nothing to weld", settings.mesh));
  } else if (const std::string touching = touching_text(touching_borders(cage)); !touching.empty()) {
    report.warnings.push_back(settings.mesh + ": " + touching);
  }
  report.mesh_hash = hash_mesh(cage);
  report.cage_faces = std::int64_t(cage.face_sizes.size());
  settle_placement(cage);
  Cloth cloth;
  // The cage encloses the surface closely enough to choose the level by; the framing is then made exact.
  const Camera rough = frame_points(cage.positions, settings.camera, settings.width, settings.height);
  auto mesh = std::make_unique<Mesh>();
  report.level = settings.level;
  if (settings.level >= 0) {
    *mesh = subdivide(cage, settings.level, settings.threads);
  } else {
    const DetailView view = detail_view(rough, settings.from_all_around);
    DetailedMesh made = subdivide_for_view(cage, view, most_quads(), settings.threads);
    *mesh = std::move(made.mesh);
    report.level = made.level;
    if (made.level < made.wanted)
      report.warnings.push_back(fmt::format(
          "{}: refined to level {} where the view asks for {}, which would take {:.2g} GB: outlines may show facets "
          "(--level {} insists)",
          settings.mesh, made.level, made.wanted, double(quads_at_level(cage, made.wanted) * bytes_per_quad) * 1e-9,
          made.wanted));
  }
  report.triangles = mesh->triangles();
  report.metres_per_uv = settings.uv_metres > 0 ? settings.uv_metres : mesh->metres_per_uv;
  report.warnings.insert(report.warnings.end(), mesh->warnings.begin(), mesh->warnings.end());
  if (mesh->fallback_warps > 0)
    report.warnings.push_back(
        fmt::format("{}: {} of {} vertices have no usable UVs: their warp follows the object's X axis", settings.mesh,
                    mesh->fallback_warps, mesh->positions.size()));
  for (const std::string& told : check_extent(cage, *mesh)) report.warnings.push_back(settings.mesh + ": " + told);
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
  for (int y = 0; y < environment.height; ++y)
    for (int x = 0; x < environment.width; ++x) hash.add_bytes(&environment.radiance_at(x, y), sizeof(Color));
  return hash.add(fmt::format("{}x{}", environment.width, environment.height)).hex();
}

}  // namespace

std::vector<std::string> compile_looks(const Look& look, const SceneSettings& settings, const ColorManager& colors,
                                       float metres_per_uv, Scene& scene) {
  FabricParts parts;
  parts.threads = settings.threads;
  parts.quadrature = settings.approximations.quadrature;
  parts.table_size = settings.approximations.table_size;
  CompiledSide front = compile_side(look, colors, parts, settings.warp_angle_deg, metres_per_uv);
  std::optional<CompiledSide> back;
  if (!look.back.empty()) back = compile_side(read_back(look), colors, parts, 0, metres_per_uv);
  std::vector<std::string> warnings = front.warnings;
  if (back) warnings.insert(warnings.end(), back->warnings.begin(), back->warnings.end());
  set_sides(scene, std::move(front), std::move(back));
  return warnings;
}

Environment read_light(const SceneSettings& settings, const ColorManager& colors) {
  EnvironmentFileOptions options;
  options.color_space = settings.environment_space;
  options.rotation_deg = settings.environment_rotation_deg;
  options.exposure_ev = settings.environment_ev;
  options.layer = settings.environment_layer;
  options.width = settings.approximations.map_size;
  return read_environment(settings.environment, colors, options);
}

Scene assemble_scene(const SceneSettings& settings, const ColorManager& colors, SceneReport& report) {
  const Look look = read_look(settings.look, settings.look_overrides);
  report.look = look;
  report.warnings = look.weave.draft_warnings;
  if (!look.textures.contains("warp_angle_deg")) report.look.warp_angle_deg += settings.warp_angle_deg;
  report.look_hash = look_hash(report.look);
  const auto add_hash = [&](const Look& other) {
    report.look_hash = Hash().add(report.look_hash).add(look_hash(other)).hex();
  };
  if (!look.back.empty()) add_hash(read_back(look));
  if (!look.pattern_look.empty()) add_hash(read_pattern(look));

  report.warnings.insert(report.warnings.end(), colors.warnings().begin(), colors.warnings().end());
  // Each part reports into fields of its own, the mesh alone into `warnings`.
  std::future<Cloth> cloth = std::async(std::launch::async, [&] { return build_cloth(settings, report); });
  std::future<Environment> environment = std::async(std::launch::async, [&] {
    const double start = now();
    Environment map = read_light(settings, colors);
    report.environment_hash = hash_environment(map);
    report.metered_ev = metered_towards(map, settings.camera.azimuth_deg, settings.environment_ev);
    report.environment_seconds = now() - start;
    return map;
  });
  Scene scene;
  const double start = now();
  std::exception_ptr failure;
  std::vector<std::string> warnings;
  bool sized_textures = false;
  try {
    sized_textures = has_sized_textures(look) || (!look.back.empty() && has_sized_textures(read_back(look)));
    if (sized_textures) cloth.wait();
    warnings = compile_looks(look, settings, colors, sized_textures ? uv_metres(report) : 1, scene);
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
  scene.filter = compile_filter(settings.approximations.filter);
  scene.environment = environment.get();
  scene.backdrop = settings.backdrop;
  scene.backdrop_color = settings.backdrop_color;
  settle_weave(settings, sized_textures, scene, report);
  for (const std::string& notice : environment_notices(scene.environment))
    report.warnings.push_back(settings.environment + ": " + notice);
  report.warnings.insert(report.warnings.end(), warnings.begin(), warnings.end());
  set_stage(scene, settings.stage, settings.threads);
  return scene;
}

}  // namespace sateen
