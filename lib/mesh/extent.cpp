#include "mesh/extent.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "mesh/box.h"

namespace sateen {

namespace {

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const auto& quad : mesh.quads) {
    const Vec3 &a = mesh.positions[quad[0]], &b = mesh.positions[quad[1]], &c = mesh.positions[quad[2]],
               &d = mesh.positions[quad[3]];
    area += Vec3d(c - a).cross(Vec3d(d - b)).length() + Vec3d(b - a).cross(Vec3d(c - a)).length();
  }
  return area;
}

const char* const far_apart_help =
    "parts that lie so far apart need files of their own; a vertex may have been put far away by mistake";

// A ribbon of a hundred thousand faces in a row keeps more.
constexpr double few_steps = 64;

/// In the units of the cage.
struct CageExtent {
  double area = 0, largest_face = 0, size = 0;
  /// Of floats of 24 bits over the whole, that fall on the largest face.
  double steps() const { return largest_face / size * 0x1p24; }
};

CageExtent extent_of(const ControlMesh& cage) {
  CageExtent out;
  Box all;
  size_t at = 0;
  for (const int corners : cage.face_sizes) {
    Box box;
    const auto corner = [&](int k) { return Vec3d(cage.positions[size_t(cage.position_indices[at + size_t(k)])]); };
    for (int k = 0; k < corners; ++k) {
      box.add(corner(k));
      all.add(corner(k));
      if (k >= 2) out.area += (corner(k - 1) - corner(0)).cross(corner(k) - corner(0)).length();
    }
    out.largest_face = std::max(out.largest_face, box.diagonal());
    at += size_t(corners);
  }
  out.size = all.diagonal();
  return out;
}

std::string count_of_faces(const ControlMesh& cage) {
  return cage.face_sizes.size() == 1 ? "its only face"
                                     : fmt::format("the largest of its {} faces", cage.face_sizes.size());
}

[[noreturn]] void refuse(const ControlMesh& cage, const CageExtent& extent) {
  // Faces that have an area, or may have had one before their corners were rounded.
  if (extent.size > 0 && (extent.area > 0 || extent.steps() < few_steps)) {
    const double unit = cage.placement.unit;
    throw InputError(
        fmt::format("{}: it spans {:.3g} units, beside which {}, {:.3g} across, is lost: nothing of it can be seen",
                    cage.name, extent.size * unit, count_of_faces(cage), extent.largest_face * unit),
        far_apart_help);
  }
  const std::string none = cage.face_sizes.size() == 1
                               ? "its only face has no area"
                               : fmt::format("none of its {} faces has an area", cage.face_sizes.size());
  throw InputError(fmt::format("{}: {}: nothing of it can be seen", cage.name, none),
                   extent.size > 0 ? "the corners of each lie on one line; export it anew"
                                   : "all corners lie in one point; export it anew");
}

}  // namespace

std::vector<std::string> check_extent(const ControlMesh& cage, const Mesh& mesh) {
  const CageExtent extent = extent_of(cage);
  if (!(area_of(mesh) > 0)) refuse(cage, extent);
  std::vector<std::string> told;
  if (const double steps = extent.steps(); steps < few_steps)
    told.push_back(
        fmt::format("it spans {:.3g} units, beside which floats have no more than {:.0f} steps across {}; {}",
                    extent.size * cage.placement.unit, steps, count_of_faces(cage), far_apart_help));
  const double size = double((mesh.bounds_max - mesh.bounds_min).length()) * mesh.placement.unit;
  const double away = mesh.placement.origin.length();
  // The file was read in double, but few programs write from more than floats of 24 bits.
  constexpr double far_away = 1000;
  if (away > far_away * size)
    told.push_back(fmt::format(
        "it lies {:.2g} times its own size from the origin, where a program that counts in floats has no more than "
        "{:.0f} steps across it; if its folds look stepped, export it at the origin",
        away / size, size / (away * 0x1p-24)));
  return told;
}

}  // namespace sateen
