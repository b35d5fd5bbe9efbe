// OBJ text through reader, welding, subdivision and Embree to a tiny picture. What is refused is refused by an error
// with a text; nothing is written outside, nothing is not finite.
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string_view>

#include "base/error.h"
#include "mesh/obj.h"
#include "mesh/subdivide.h"
#include "mesh/weld.h"
#include "render/assemble.h"
#include "render/render.h"

namespace {

using namespace sateen;

constexpr size_t longest = 8192;
constexpr std::int64_t most_quads = 20'000;

void require(bool good) {
  if (!good) std::abort();
}

/// Everything but the mesh, made once.
const Scene& stage() {
  static const Scene scene = [] {
    SceneSettings settings;
    settings.look = SATEEN_SOURCE_DIR "/looks/champagne_silk_satin.json";
    settings.environment = SATEEN_SOURCE_DIR "/envmaps/studio_softboxes.exr";
    settings.approximations.map_size = 64;
    settings.mesh = "swatch";
    settings.level = 0;
    settings.width = settings.height = 4;
    settings.threads = 1;
    SceneReport report;
    return assemble_scene(settings, ColorManager("built-in"), report);
  }();
  return scene;
}

void draw(std::shared_ptr<const Mesh> mesh) {
  Scene scene = stage();
  scene.rays = std::make_shared<const RayTracer>(*mesh, 1);
  scene.camera = frame_points(mesh->positions, {}, 4, 4);
  scene.mesh = std::move(mesh);
  set_stage(scene, {}, 1);
  RenderSettings settings;
  settings.stop.spp = 1;
  settings.light.bounces = 1;
  settings.threads = 1;
  settings.albedo_layer = false;  // a table of the look, which is the same for all meshes
  Film film(4, 4, true);
  render(scene, settings, film);
  for (const FilmPixel& pixel : film.pixels)
    for (const Vec3d& sum : pixel.beauty)
      require(std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z) && sum.x >= 0 && sum.y >= 0 &&
              sum.z >= 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > longest) return 0;
  try {
    ControlMesh cage = parse_obj({reinterpret_cast<const char*>(data), size}, "fuzz.obj");
    // What is not in the text: by its length, so that one file always does the same.
    if (size % 3 == 0) weld_borders(cage);
    if (size % 5 == 0) cage.scheme = ControlMesh::Scheme::bilinear;
    if (size % 5 == 1) cage.scheme = ControlMesh::Scheme::loop;
    settle_placement(cage);
    int level = int(size % 4);
    while (level > 0 && quads_at_level(cage, level) > most_quads) --level;
    if (quads_at_level(cage, level) > most_quads) return 0;
    draw(std::make_shared<const Mesh>(subdivide(cage, level, 1)));
  } catch (const InputError& error) {
    require(std::string_view(error.what()).size() > 0);
  }
  return 0;
}
