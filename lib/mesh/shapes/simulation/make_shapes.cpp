#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "mesh/shapes/simulation/cloth.h"
#include "mesh/shapes/simulation/self_contact.h"

// Makes lib/mesh/shapes/drape.obj and skirt.obj, the cages of the built-in shapes:
//   cmake --build build --target sateen_shapes && build/bin/sateen_shapes lib/mesh/shapes
// A few minutes on one core; the same bits in every run with the same compiler.

namespace sateen {
namespace {

constexpr double tau = 2 * std::numbers::pi;

Solid sphere(const Vec3d& centre, double radius, double friction) {
  return {[=](const Vec3d& p) -> SolidDistance {
            const Vec3d d = p - centre;
            const double length = d.length();
            return {length - radius, d / length};
          },
          friction};
}

Solid floor_at_zero(double friction) {
  return {[](const Vec3d& p) -> SolidDistance { return {p.y, {0, 1, 0}}; }, friction};
}

void report(const std::string& name, const Cloth& cloth) {
  double low = 1e30, high = 0, squares = 0;
  int count = 0;
  const auto edge = [&](int a, int b) {
    const double r = (cloth.positions[a] - cloth.positions[b]).length() / (cloth.pattern[a] - cloth.pattern[b]).length();
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
  fmt::print("{}: {} x {}, edges {:.4f} to {:.4f} of rest (rms {:.4f}), crossings {}, box {:.3f} {:.3f} {:.3f} to "
             "{:.3f} {:.3f} {:.3f}\n",
             name, cloth.columns, cloth.rows, low, high, std::sqrt(squares / count),
             count_crossings(cloth.positions, cloth_triangles(cloth)), from.x, from.y, from.z, to.x, to.y, to.z);
  std::fflush(stdout);
}

void write_obj(const Cloth& cloth, const std::filesystem::path& path, const std::string& comment) {
  std::ofstream out(path);
  out << "# " << comment << "\n# Made by lib/mesh/shapes/simulation/make_shapes.cpp; metres, Y up, texture coordinates in metres.\n";
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
  if (!out) throw std::runtime_error("could not write " + path.string());
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

Cloth make_drape() {
  constexpr double side = 1.1;
  const auto pattern_at = [](double a, double b) { return Vec2d(side * a, side * b); };
  Cloth cloth = grid(51, 51, false, pattern_at);
  const double turn = 0.62, c = std::cos(turn), s = std::sin(turn);
  for (const Vec2d& p : cloth.pattern) {
    const double u = p.x - 0.5 * side + 0.035, v = p.y - 0.5 * side - 0.02;
    const double x = c * u - s * v, z = -(s * u + c * v);
    // A little unevenness, so that the folds choose their own places.
    const double lift = 0.006 * std::sin(5.1 * x + 2.3 * z + 1.0) + 0.005 * std::sin(-3.7 * x + 6.3 * z + 0.4) +
                        0.004 * std::sin(9.1 * x + 4.9 * z + 2.2);
    cloth.positions.push_back({x, 0.43 + lift, z});
  }
  ClothMaterial satin;
  Surroundings around;
  around.solids = {sphere({0, 0.26, 0}, 0.16, 0.25), floor_at_zero(0.35)};
  satin.thickness = 0.008;
  around.drag = 3;
  double speed = simulate(cloth, satin, around, 2.5, 1.0 / 800, 0);
  around.drag = 8;
  speed = simulate(cloth, satin, around, 1.0, 1.0 / 800, 2e-3);
  report(fmt::format("drape, coarse, speed {:.4f}", speed), cloth);
  cloth = refine(cloth, pattern_at);
  satin.thickness = 0.005;
  around.drag = 3;
  speed = simulate(cloth, satin, around, 1.0, 1.0 / 1500, 2e-3);
  around.drag = 12;
  speed = simulate(cloth, satin, around, 1.0, 1.0 / 1500, 1e-3);
  report(fmt::format("drape, fine, speed {:.4f}", speed), cloth);
  smooth(cloth, 4);
  report("drape, smoothed", cloth);
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
    for (int i = 0; i < cloth.columns; ++i) {
      const int v = cloth.at(i, cloth.rows - 1);
      const double angle = tau * i / cloth.columns;
      cloth.positions[v] = {1.1 * waist * std::cos(angle), height, -0.888 * waist * std::sin(angle)};
      cloth.inverse_mass[v] = 0;
      cloth.velocities[v] = Vec3d(0);
    }
  };
  Cloth cloth = grid(112, 23, true, pattern_at);
  for (const Vec2d& p : cloth.pattern) {
    const double reach = p.length() - waist, angle = std::atan2(p.y, p.x);
    const double lift = reach * (0.05 * std::sin(3 * angle + 0.4) + 0.05 * std::sin(5 * angle + 2.1) +
                                 0.07 * std::sin(8 * angle + 1.3) + 0.05 * std::sin(11 * angle + 0.2));
    cloth.positions.push_back({p.x, height - 0.25 * reach + lift, -p.y});
  }
  hold(cloth);
  ClothMaterial satin;
  satin.shear = 200;
  Surroundings around;
  around.solids = {{[](const Vec3d& p) -> SolidDistance {
                      // Hips: an ellipsoid; distance by the gradient of its implicit function.
                      const Vec3d centre(0, 0.56, 0), radii(0.17, 0.24, 0.14);
                      const Vec3d q = (p - centre) / radii;
                      const Vec3d gradient = q / radii;
                      const double k = q.length(), g = gradient.length();
                      return {k > 0 ? k * (k - 1) / g : -0.1, g > 0 ? gradient / g : Vec3d(0, 1, 0)};
                    },
                    0.2}};
  around.spin = 1.5;
  satin.thickness = 0.008;
  around.drag = 3;
  double speed = simulate(cloth, satin, around, 2.5, 1.0 / 800, 0);
  around.drag = 8;
  speed = simulate(cloth, satin, around, 1.0, 1.0 / 800, 2e-3);
  report(fmt::format("skirt, coarse, speed {:.4f}", speed), cloth);
  cloth = refine(cloth, pattern_at);
  hold(cloth);
  satin.thickness = 0.005;
  around.drag = 3;
  speed = simulate(cloth, satin, around, 1.0, 1.0 / 1500, 2e-3);
  around.drag = 12;
  speed = simulate(cloth, satin, around, 1.0, 1.0 / 1500, 1e-3);
  report(fmt::format("skirt, fine, speed {:.4f}", speed), cloth);
  smooth(cloth, 4);
  report("skirt, smoothed", cloth);
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
