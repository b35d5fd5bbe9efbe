#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "command.h"
#include "commands.h"
#include "console.h"
#include "environment_text.h"
#include "exit_code.h"
#include "image/color.h"
#include "light_flags.h"
#include "look/json.h"
#include "look/json_writer.h"
#include "look/read.h"
#include "measured_look.h"
#include "mesh/check_cage.h"
#include "mesh/extent.h"
#include "mesh/obj.h"
#include "mesh/shapes.h"
#include "mesh/subdivide.h"
#include "mesh/weld.h"
#include "scene/environment_file.h"
#include "scene/environment_make.h"

namespace sateen::app {

namespace {
/// What the doctor says of one file: facts, what is odd and what to do about it, and what makes it unusable.
struct Finding {
  std::string path, kind;
  std::vector<std::string> facts, notices;
  std::string error;  ///< the message, as it would stop a rendering
  int code = done;
};

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

bool is_map_description(const std::string& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) return false;
  try {
    return parse_json(read_text_file(path, json_most_bytes), path).root.find("lights") != nullptr;
  } catch (const InputError&) {
    return false;  // then it is checked as a look, which tells what is wrong
  }
}

std::string kind_of(const std::string& name) {
  const std::string extension = lower_extension(name);
  if (extension == ".json") return is_map_description(name) ? "map description" : "look";
  if (extension == ".obj") return "mesh";
  if (extension == ".exr" || extension == ".hdr" || extension == ".tif" || extension == ".tiff" ||
      extension == ".png" || extension == ".jpg" || extension == ".jpeg")
    return "map";
  if (is_built_in_shape(name)) return "mesh";
  for (const LookEntry& entry : list_looks())
    if (entry.name == name) return "look";
  const std::vector<std::string> maps = environment_names();
  if (std::find(maps.begin(), maps.end(), name) != maps.end()) return "map";
  std::error_code code;
  if (!std::filesystem::exists(name, code))
    throw InputError(fmt::format("{}: no such file, and no look, mesh or map of that name", shown_name(name)),
                     "sateen look list and sateen env list show the names", InputError::Kind::unreadable);
  throw InputError(fmt::format("{}: neither a look (.json), a mesh (.obj) nor a map (.exr, .hdr, .tif, .png, .jpg)",
                               shown_name(name)),
                   extension.empty() ? "" : fmt::format("files of kind {} are not read", extension));
}

void check_look(Finding& f) {
  const Look look = read_look(f.path);
  const MeasuredLook measured = measure_look(look, false);
  f.facts.push_back(look.title.empty() ? look.name : look.title);
  if (!look.textures.empty()) f.facts.push_back(fmt::format("{} of its values are textures", look.textures.size()));
  f.notices.insert(f.notices.end(), measured.warnings.begin(), measured.warnings.end());
  if (measured.fabric.gap > 0)
    f.facts.push_back(fmt::format("{:.1f} % of its area are gaps that light passes", 100 * measured.fabric.gap));
  float brightest = 0;
  for (const PlaneDirection& view : table_views()) {
    const Color a = albedo_color(measured.fabric, view.direction());
    brightest = std::max(brightest, max_component(a));
    if (max_component(a) > 1)
      f.notices.push_back(fmt::format(
          "its albedo at {} degrees is {:.3f} {:.3f} {:.3f}, above 1: it glows there; lower A or the colour",
          view.text(), a.x, a.y, a.z));
  }
  f.facts.push_back(fmt::format("largest albedo {:.3f}", brightest));
  if (look.source.empty()) f.notices.push_back("it has no source: say in \"source\" where its numbers come from");
}

/// "9 vertices, 4 faces: 3 quads, 1 triangle"
std::string cage_text(const ControlMesh& cage) {
  long long triangles = 0, quads = 0;
  for (const int size : cage.face_sizes) triangles += size == 3, quads += size == 4;
  const long long faces = (long long)cage.face_sizes.size(), others = faces - triangles - quads;
  std::string kinds;
  const auto add = [&](long long count, const std::string& text) {
    if (count > 0) kinds += (kinds.empty() ? "" : ", ") + text;
  };
  add(quads, counted(quads, "quad"));
  add(triangles, counted(triangles, "triangle"));
  add(others, counted(others, "face") + " of five corners or more");
  std::vector<bool> used(cage.positions.size(), false);
  for (const int i : cage.position_indices) used[size_t(i)] = true;
  const long long vertices = std::count(used.begin(), used.end(), true), unused = (long long)used.size() - vertices;
  return fmt::format("{}{}, {}: {}", counted(vertices, "vertex"),
                     unused > 0 ? fmt::format(" ({} more that no face uses)", unused) : "", counted(faces, "face"),
                     kinds);
}

void check_mesh(Finding& f, bool weld) {
  ControlMesh cage = is_built_in_shape(f.path) ? built_in_shape(f.path) : read_obj(f.path);
  if (weld) {
    const Touching welded = weld_borders(cage);
    f.facts.push_back(
        fmt::format("welded along {}, {} fewer", counted(welded.edges, "edge"), counted(welded.vertices, "vertex")));
  } else if (const std::string touching = touching_text(touching_borders(cage)); !touching.empty()) {
    f.notices.push_back(touching);
  }
  f.facts.push_back("cage of " + cage_text(cage));
  if (!cage.creases.empty()) f.facts.push_back(counted((long long)cage.creases.size(), "creased edge"));
  if (!cage.corners.empty()) f.facts.push_back(counted((long long)cage.corners.size(), "sharp corner"));
  if (!cage.holes.empty())
    f.facts.push_back(counted((long long)cage.holes.size(), "face") +
                      (cage.holes.size() == 1 ? " cut out as a hole" : " cut out as holes"));
  settle_placement(cage);
  const Mesh mesh = subdivide(cage, 1);
  for (const std::string& told : check_extent(cage, mesh)) f.notices.push_back(told);
  const Vec3d size = Vec3d(mesh.bounds_max - mesh.bounds_min) * mesh.placement.unit;
  f.facts.push_back(fmt::format("limit surface {:.4g} x {:.4g} x {:.4g} scene units", size.x, size.y, size.z));
  for (const std::string& warning : mesh.warnings) f.notices.push_back(warning);
  if (cage.uvs.empty()) {
    f.notices.push_back(
        "it has no UVs: the warp follows the object's X axis; unwrap it so that u runs along the warp");
  } else if (mesh.fallback_warps > 0) {
    f.notices.push_back(
        fmt::format("{} of its {} vertices at level 1 have missing or degenerate UVs: the warp follows the object's "
                    "X axis there; "
                    "--aov warp shows where",
                    mesh.fallback_warps, mesh.positions.size()));
  }
}

void check_map(Finding& f, const std::string& layer) {
  const ColorManager colors;
  std::string space;
  EnvironmentFileOptions options;
  options.layer = layer;
  const Environment map = read_environment(f.path, colors, options, &space);
  const EnvironmentReport report = inspect_environment(map);
  f.facts.push_back(fmt::format("{} x {}, {}", report.width, report.height, space));
  f.facts.push_back(fmt::format("{:.1f} stops, largest over mean luminance {:.4g}, metered exposure {:+.2f} EV",
                                report.stops, report.largest_over_mean, report.metered_ev));
  for (const std::string& note : report.notes) f.facts.push_back(note);
  f.notices = colors.warnings();
  for (const std::string& notice : report.notices) f.notices.push_back(notice);
  const std::string extension = lower_extension(f.path);
  if (extension == ".png" || extension == ".jpg" || extension == ".jpeg")
    f.notices.push_back("a format without high dynamic range: lights are cut at white; use EXR or HDR");
}

Finding examine(const std::string& name, bool weld, const std::string& layer) {
  Finding f;
  f.path = name;
  try {
    f.kind = kind_of(name);
    if (f.kind == "look") check_look(f);
    if (f.kind == "mesh") check_mesh(f, weld);
    if (f.kind == "map") check_map(f, layer);
    if (f.kind == "map description") {
      const MapDescription d = read_map_description(name);
      f.facts.push_back(fmt::format("{} x {}, {} lights", d.width, d.height, d.lights.size()));
    }
  } catch (const InputError& error) {
    f.error = error.what();
    f.code = error.kind == InputError::Kind::unreadable ? unreadable : wrong_use;
  }
  return f;
}
}  // namespace

int run_check(const std::vector<std::string>& words) {
  std::vector<std::string> names;
  std::string layer;
  Command command(
      "check", "Says what looks, meshes and HDR maps hold, what is wrong with them or was repaired, and what to do.",
      "FILE... [--json]");
  command.arguments("FILE", names, 1, 10000, "looks, meshes, maps and map descriptions in any mixture; names too");
  bool weld = false;
  command.flag("--weld", weld, "joins borders of meshes that coincide, as sateen render --weld does");
  add_layer_flag(command, layer);
  add_image_limit(command);
  command.flag("--json", voice.json, "the same as JSON");
  command.example("sateen check my_look.json dress.obj studio.hdr", "three files of three kinds");
  if (!command.parse(words)) return done;
  int code = done;
  JsonWriter w;
  w.open_object().key("files").open_list();
  for (const std::string& name : names) {
    const Finding f = examine(name, weld, layer);
    code = std::max(code, f.code);
    w.open_object().member("path", f.path).member("kind", f.kind).member("usable", f.error.empty());
    w.key("facts").open_list();
    for (const std::string& fact : f.facts) w.value(fact);
    w.close().key("notices").open_list();
    for (const std::string& notice : f.notices) w.value(notice);
    w.close();
    if (!f.error.empty()) w.member("error", f.error);
    w.close();
    if (voice.json) continue;
    std::string text = fmt::format("{}: {}\n", f.path,
                                   !f.error.empty()    ? "not usable"
                                   : f.notices.empty() ? f.kind + ", good"
                                                       : f.kind);
    for (const std::string& fact : f.facts) text += "  " + fact + "\n";
    for (const std::string& notice : f.notices) text += "  note: " + notice + "\n";
    print_result(text);
    if (!f.error.empty()) print_error(f.error);
  }
  w.close().member("exit_code", code).close();
  if (voice.json) print_result(w.text());
  return code;
}

}  // namespace sateen::app
