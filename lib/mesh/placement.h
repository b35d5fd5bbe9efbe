#pragma once
#include "math/vector.h"

namespace sateen {

struct ControlMesh;

/// Where a mesh as it is held lies in the scene of its author: scene = origin + held * unit. Floats of a size about
/// one, near the origin, neither overflow when they are squared nor round away what is small.
struct Placement {
  double unit = 1;        ///< scene units; a power of two
  Vec3d origin{0, 0, 0};  ///< scene units

  bool is_identity() const { return unit == 1 && origin == Vec3d(0, 0, 0); }
  Vec3 to_scene(const Vec3& held) const { return is_identity() ? held : Vec3(origin + Vec3d(held) * unit); }
  /// A distance in scene units as the mesh is held.
  float held_length(double scene_length) const { return float(scene_length / unit); }
};

/// Turns a cage whose z points upwards so that its y does: what faced -y faces +z, the camera's side.
void stand_up(ControlMesh& cage);

/// Moves and scales the cage's positions, and says so in its placement. A cage of 2^-7 to 2^10 units (0.0078 to
/// 1024) keeps its size, others get one of 1 to 2; one that lies 64 of its sizes from the origin is moved there. All
/// other cages keep their bits. Vertices that no face uses are put into the middle of those that are used.
void settle_placement(ControlMesh& cage);

}  // namespace sateen
