#pragma once
#include "mesh/control_mesh.h"

namespace sateen::shapes {

/// A square of 0.3 m, hung up facing +Z, its warp upright, with soft swags between its upper corners. The threads
/// keep their length along both families, as cloth does; it shears instead.
ControlMesh swatch();

/// Cloth stretched over a ball of radius 0.15 m that rests on y = 0. Two pieces, front (+Z) and back, each a round
/// pattern of equal area, sewn together along the outline that the default camera sees; warp upright in the middle.
/// The control points are placed so that the limit surface, not the cage, has the radius.
ControlMesh sphere();

/// A square of satin laid over a ball, its corners spread on the floor y = 0. Simulated: see shapes/simulation/.
ControlMesh drape();

/// A circle skirt of satin in a slow turn, its waist at a height of 0.75 m. Cut in one piece, without a seam; the
/// warp has one direction on the pattern and so turns around the body. Simulated: see simulation/.
ControlMesh skirt();

}  // namespace sateen::shapes
