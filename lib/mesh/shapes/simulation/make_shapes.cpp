#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>

#include "mesh/shapes/simulation/cloth.h"
#include "mesh/shapes/simulation/self_contact.h"

// Makes lib/mesh/shapes/drape.obj and skirt.obj, the cages of the built-in shapes:
//   cmake --build build --target sateen_shapes && build/bin/sateen_shapes lib/mesh/shapes
// Two minutes on one core; the same files in every run.

namespace sateen {
namespace {

constexpr double tau = 2 * std::numbers::pi;
constexpr double coarse_step = 1.0 / 900, fine_step = 1.0 / 1500;  // [s]

Solid sphere(const Vec3d& centre, double radius, double friction) {
  return {[=](const Vec3d& p) -> SolidDistance {
            const Vec3d d = p - centre;
            const double length = d.length();
            return {length - radius, d / length};
          },
          friction};
}

/// Distance to first order, by the gradient of the implicit function.
Solid ellipsoid(const Vec3d& centre, const Vec3d& radii, double friction) {
  return {[=](const Vec3d& p) -> SolidDistance {
            const Vec3d q = (p - centre) / radii, gradient = q / radii;
            const double k = q.length(), g = gradient.length();
            return {k > 0 ? k * (k - 1) / g : -radii.y, g > 0 ? gradient / g : Vec3d(0, 1, 0)};
          },
          friction};
}

Solid floor_at(double height, double friction) {
  return {[=](const Vec3d& p) -> SolidDistance { return {p.y - height, {0, 1, 0}}; }, friction};
}

/// On the final grid: move, come to rest, then carry the weight without stretch. Returns the fastest speed [m/s].
double settle(Cloth& cloth, const ClothMaterial& satin, Surroundings around) {
  around.drag = 3;
  simulate(cloth, satin, around, 0.8, fine_step, 2, 0);
  around.drag = 10;
  simulate(cloth, satin, around, 0.6, fine_step, 2, 0.002);
  around.drag = 15;
  return simulate(cloth, satin, around, 0.9, 1.0 / 2000, 12, 0.001);
}

void report(const std::string& name, const Cloth& cloth, double speed) {
  double low = 1e30, high = 0, squares = 0;
  int count = 0;
  const auto edge = [&](int a, int b) {
    const double rest = (cloth.pattern[a] - cloth.pattern[b]).length();
    const double r = (cloth.positions[a] - cloth.positions[b]).length() / rest;
    low = std::min(low, r), high = std::max(high, r), squares += (r - 1) * (r - 1), ++count;
  };
  for (int j = 0; j < cloth.rows; ++j)
    for (int i = 0; i < cloth.columns; ++i) {
      if (i < cloth.quad_columns()) edge(cloth.at(i, j), cloth.at(i + 1, j));
      if (j + 1 < cloth.rows) edge(cloth.at(i, j), cloth.at(i, j + 1));
    }
  Vec3d from = cloth.positions[0], to = from;
  for (const Vec3d& p : cloth.positions)
    for (int k = 0; k < 3; ++k) from[k] = std::min(from[k], p[k]), to[k] = std::max(to[k], p[k]);
  fmt::print(
      "{}: {} x {}, edges {:.4f} to {:.4f} of rest (rms {:.4f}), crossings {}, box {:.3f} {:.3f} {:.3f} to "
      "{:.3f} {:.3f} {:.3f}, fastest {:.4f} m/s\n",
      name, cloth.columns, cloth.rows, low, high, std::sqrt(squares / count),
      count_crossings(cloth.positions, cloth_triangles(cloth)), from.x, from.y, from.z, to.x, to.y, to.z, speed);
  std::fflush(stdout);
}

void write_obj(const Cloth& cloth, const std::filesystem::path& path, const std::string& comment) {
  std::ofstream out(path);
  out << "# " << comment
      << "\n# Made by lib/mesh/shapes/simulation/make_shapes.cpp; metres, Y up, texture coordinates in metres.\n";
  const auto number = [](double x) {
    std::string s = fmt::format("{:.5f}", x);
    while (s.back() == '0') s.pop_back();
    if (s.back() == '.') s.pop_back();
    return s == "-0" ? std::string("0") : s;
  };
  for (const Vec3d& p : cloth.positions) out << fmt::format("v {} {} {}\n", number(p.x), number(p.y), number(p.z));
  for (const Vec2d& p : cloth.pattern) out << fmt::format("vt {} {}\n", number(p.x), number(p.y));
  for (int j = 0; j + 1 < cloth.rows; ++j)
    for (int i = 0; i < cloth.quad_columns(); ++i)
      out << fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", 1 + cloth.at(i, j), 1 + cloth.at(i + 1, j),
                         1 + cloth.at(i + 1, j + 1), 1 + cloth.at(i, j + 1));
  out.close();
  if (!out) throw std::runtime_error(fmt::format("could not write {}", path.string()));
}

Cloth grid(int columns, int rows, bool closed, const std::function<Vec2d(double, double)>& pattern_at) {
  Cloth cloth;
  cloth.columns = columns, cloth.rows = rows, cloth.closed = closed;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      cloth.pattern.push_back(pattern_at(double(i) / cloth.quad_columns(), double(j) / (rows - 1)));
  cloth.inverse_mass.assign(cloth.pattern.size(), 1.0);
  cloth.velocities.assign(cloth.pattern.size(), Vec3d(0));
  return cloth;
}

void turn_about_y(Cloth& cloth, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Vec3d& p : cloth.positions) p = {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}

/// Hangs freely over a ball first, so that the folds fall as they like; then the floor comes up under the hem.
Cloth make_drape() {
  constexpr double side = 1.15, top = 0.44, radius = 0.095, floor = -0.3, rise = 0.15;
  const auto pattern_at = [](double a, double b) { return Vec2d(side * a, side * b); };
  Cloth cloth = grid(51, 51, false, pattern_at);
  const double c = std::cos(1.0), s = std::sin(1.0);
  for (const Vec2d& p : cloth.pattern) {
    // Off the middle and a little uneven: the folds shall choose their own places.
    const double u = p.x - 0.5 * side + 0.05, v = p.y - 0.5 * side + 0.03;
    const double x = c * u - s * v, z = -(s * u + c * v);
    const double lift = 0.006 * std::sin(5.1 * x + 2.3 * z + 1.0) + 0.005 * std::sin(-3.7 * x + 6.3 * z + 0.4) +
                        0.004 * std::sin(9.1 * x + 4.9 * z + 2.2);
    cloth.positions.push_back({x, top + 0.015 + lift, z});
  }
  ClothMaterial satin;
  satin.bending = 5e-6;
  satin.least_radius = 0.024;
  satin.thickness = 0.009;
  Surroundings around;
  around.solids = {sphere({0, top - radius, 0}, radius, 0.25), floor_at(floor, 0.35)};
  around.drag = 5;
  simulate(cloth, satin, around, 2.0, coarse_step, 2, 0);
  around.solids[1].velocity = {0, rise, 0};
  simulate(cloth, satin, around, -floor / rise, coarse_step, 2, 0);
  around.solids[1] = floor_at(0, 0.35);
  simulate(cloth, satin, around, 0.7, coarse_step, 2, 0);
  around.drag = 6;
  double speed = simulate(cloth, satin, around, 0.3, coarse_step, 2, 0.002);
  report("drape, coarse", cloth, speed);

  cloth = refine(cloth, pattern_at);
  satin.least_radius = 0.018;
  satin.thickness = 0.006;
  speed = settle(cloth, satin, around);
  report("drape", cloth, speed);
  turn_about_y(cloth, 0.826 * std::numbers::pi);  // its best side to the front
  return cloth;
}

Cloth make_skirt() {
  constexpr double waist = 0.118, length = 0.6, height = 0.75;
  // Row 0 is the hem, so that columns and rows run counter-clockwise seen from outside.
  const auto pattern_at = [](double around_it, double up) {
    const double r = waist + length * (1 - up);
    return Vec2d(r * std::cos(tau * around_it), r * std::sin(tau * around_it));
  };
  const auto hold = [](Cloth& cloth) {
    // The waist is an ellipse of the ring's own length, its vertices at equal steps along it.
    constexpr int fine = 20000;
    const auto ellipse = [](double t) { return Vec3d(1.1 * std::cos(t), 0, -0.8953 * std::sin(t)) * waist; };
    std::vector<double> arc(fine + 1, 0.0);
    for (int k = 0; k < fine; ++k)
      arc[k + 1] = arc[k] + (ellipse(tau * (k + 1) / fine) - ellipse(tau * k / fine)).length();
    for (int i = 0, k = 0; i < cloth.columns; ++i) {
      while (arc[k] < arc[fine] * i / cloth.columns) ++k;
      const int v = cloth.at(i, cloth.rows - 1);
      cloth.positions[v] = ellipse(tau * k / fine) + Vec3d(0, height, 0);
      cloth.inverse_mass[v] = 0;
      cloth.velocities[v] = Vec3d(0);
    }
  };
  Cloth cloth = grid(112, 23, true, pattern_at);
  for (const Vec2d& p : cloth.pattern) {
    const double reach = p.length() - waist, angle = std::atan2(p.y, p.x);
    const double lift = reach * (0.08 * std::sin(2 * angle + 0.4) + 0.09 * std::sin(5 * angle + 2.1) +
                                 0.10 * std::sin(7 * angle + 1.3) + 0.08 * std::sin(11 * angle + 0.2));
    cloth.positions.push_back({p.x, height - 0.25 * reach + lift, -p.y});
  }
  hold(cloth);
  ClothMaterial satin;
  satin.shear = 200;  // rings and rays are not the threads: stiff in every direction
  satin.bending = 7e-6;
  satin.least_radius = 0.022;
  satin.thickness = 0.008;
  Surroundings around;
  around.solids = {ellipsoid({0, 0.55, 0}, {0.165, 0.23, 0.135}, 0.2)};
  around.spin = 1.5;
  simulate(cloth, satin, around, 2.5, coarse_step, 2, 0);
  around.drag = 8;
  double speed = simulate(cloth, satin, around, 0.5, coarse_step, 2, 0.002);
  report("skirt, coarse", cloth, speed);

  cloth = refine(cloth, pattern_at);
  hold(cloth);
  satin.least_radius = 0.018;
  satin.thickness = 0.006;
  speed = settle(cloth, satin, around);
  report("skirt", cloth, speed);
  return cloth;
}

}  // namespace
}  // namespace sateen

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: sateen_shapes FOLDER [drape | skirt]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const std::string only = argc > 2 ? argv[2] : "";
  try {
    if (only.empty() || only == "drape")
      sateen::write_obj(sateen::make_drape(), folder / "drape.obj", "A square of satin laid over a sphere.");
    if (only.empty() || only == "skirt")
      sateen::write_obj(sateen::make_skirt(), folder / "skirt.obj", "A circle skirt of satin.");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
