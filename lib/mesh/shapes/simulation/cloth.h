#pragma once
#include <array>
#include <functional>
#include <vector>

#include "math/vector.h"

namespace sateen {

using Vec2d = Imath::V2d;

/// A piece of cloth on a grid of quads: vertex (column i, row j) has index j * columns + i. All in SI units.
/// Closed cloth joins the last column to the first. Rows and columns run counter-clockwise seen from the face side.
struct Cloth {
  int columns = 0, rows = 0;
  bool closed = false;
  std::vector<Vec2d> pattern;        ///< flat, unstretched shape [m]
  std::vector<Vec3d> positions;      ///< [m]
  std::vector<Vec3d> velocities;     ///< [m/s]
  std::vector<double> inverse_mass;  ///< [1/kg]; 0 where the vertex is held

  int quad_columns() const { return closed ? columns : columns - 1; }
  int at(int column, int row) const { return row * columns + (closed ? (column + columns) % columns : column); }
};

/// What the cloth is made of. Defaults: a heavy (duchess) satin, 120 g/m2.
struct ClothMaterial {
  double density = 0.12;        ///< [kg/m2]
  double stretch = 900;         ///< along the threads [N/m]; real satins 300 to 2000
  double shear = 30;            ///< across the diagonal of the weave [N/m]; satins 20 to 60
  double bending = 2e-5;        ///< [N m]; with the density it sets the width of a fold, (bending / density g)^(1/3)
  double least_radius = 0.018;  ///< bending stiffens with the fourth power of (least_radius / radius) [m]
  double bending_damping = 2e-3;  ///< [s], relative to the bending stiffness
  double thickness = 0.005;  ///< distance kept between layers [m]: that of the rendered surfaces, not of a real satin
  double friction = 0.25;    ///< cloth on cloth
};

/// Signed distance [m] of a point to a solid (negative inside) and the unit normal that leads out.
struct SolidDistance {
  double distance = 0;
  Vec3d normal{0, 1, 0};
};
struct Solid {
  std::function<SolidDistance(const Vec3d&)> distance;
  double friction = 0.3;
  Vec3d velocity{0, 0, 0};  ///< [m/s]; the solid starts each call of simulate() where `distance` has it
};

/// Moving surroundings in the cloth's frame of reference.
struct Surroundings {
  std::vector<Solid> solids;
  double gap = 0.003;       ///< distance kept between cloth and solids [m]
  double drag = 3;          ///< rate at which the air stops the cloth [1/s]
  double spin = 0;          ///< turn of the frame around +y [rad/s]: centrifugal force and head wind
  double wind_share = 0.1;  ///< share of the drag that pulls towards the standing air of a turning frame
};

/// Advances the cloth by `seconds`; stops early once nothing moves faster than `rest_speed` [m/s]. Extended
/// position-based dynamics (Macklin et al. 2016) in small steps (Macklin et al. 2019), double precision, one thread,
/// always the same order: the same bits in every run.
/// `sweeps` Gauss-Seidel passes a step: 2 to move, 10 and more to carry the whole weight at rest without stretch.
/// Returns the fastest speed in the last step [m/s].
double simulate(Cloth& cloth, const ClothMaterial& material, const Surroundings& surroundings, double seconds,
                double time_step, int sweeps, double rest_speed);

/// Four-point interpolation to twice the cells in each direction; pattern by `pattern_at` (column, row as
/// fractions of the grid, 0 to 1).
Cloth refine(const Cloth& coarse, const std::function<Vec2d(double, double)>& pattern_at);

/// Two triangles a quad, counter-clockwise.
std::vector<std::array<int, 3>> cloth_triangles(const Cloth& cloth);

/// Weights w of a second derivative on the pattern: sum w x = 0 for every flat, undistorted placement.
struct Stencil {
  std::array<int, 9> vertices;
  std::array<double, 9> weights;
  double area;  ///< of the vertex in the middle [m2]
};
/// Three stencils a vertex inside the grid: d2/du2, sqrt(2) d2/dudv, d2/dv2 [1/m2], each times the square root of
/// the vertex's area, so that bending / 2 times the sum of squares is the energy of an inextensible sheet.
std::vector<Stencil> bending_stencils(const Cloth& cloth);

/// Area of the pattern that belongs to each vertex [m2].
std::vector<double> vertex_areas(const Cloth& cloth);

}  // namespace sateen
