#include "mesh/placement.h"

#include <cmath>
#include <vector>

#include "mesh/box.h"
#include "mesh/control_mesh.h"
#include "mesh/wanted_placement.h"

namespace sateen {

namespace {
constexpr double least_size = 0x1p-7, largest_size = 0x1p10;  // as people model: a button to a stage in centimetres
constexpr double far_from_origin = 64;                        // sizes: what floats lose by then is a step of 2^-17

/// Of the vertices that faces use.
Box box_of(const ControlMesh& cage) {
  Box box;
  for (const int i : cage.position_indices) box.add(Vec3d(cage.positions[size_t(i)]));
  return box;
}

Placement placement_in(const Box& box) {
  Placement placement;
  const Vec3d extent = box.high - box.low, middle = box.middle();
  const double size = std::max({extent.x, extent.y, extent.z});
  if (size > 0 && (size < least_size || size > largest_size)) placement.unit = std::exp2(std::floor(std::log2(size)));
  if (std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)}) > far_from_origin * size)
    placement.origin = Vec3d(Vec3(middle));
  return placement;
}
}  // namespace

Placement wanted_placement(const ControlMesh& cage) {
  return cage.position_indices.empty() ? Placement{} : placement_in(box_of(cage));
}

void stand_up(ControlMesh& cage) {
  for (Vec3& p : cage.positions) p = Vec3(p.x, p.z, -p.y);
  Vec3d& origin = cage.placement.origin;
  origin = Vec3d(origin.x, origin.z, -origin.y);
}

void settle_placement(ControlMesh& cage) {
  if (cage.position_indices.empty()) return;
  const Box box = box_of(cage);
  std::vector<bool> used(cage.positions.size(), false);
  for (const int i : cage.position_indices) used[size_t(i)] = true;
  for (size_t i = 0; i < used.size(); ++i)
    if (!used[i]) cage.positions[i] = Vec3(box.middle());
  const Placement placement = placement_in(box);
  if (placement.is_identity()) return;
  // In double, so that what lies far out loses nothing before it is near.
  for (Vec3& p : cage.positions) p = Vec3((Vec3d(p) - placement.origin) / placement.unit);
  cage.placement.origin += placement.origin * cage.placement.unit;
  cage.placement.unit *= placement.unit;
}

}  // namespace sateen
