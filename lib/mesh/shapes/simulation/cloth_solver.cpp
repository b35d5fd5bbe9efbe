#include <algorithm>
#include <cmath>

#include "mesh/shapes/simulation/cloth.h"
#include "mesh/shapes/simulation/self_contact.h"

namespace sateen {
namespace {

constexpr double gravity = 9.81;

struct Spring {
  int a, b;
  double rest, compliance;
  double lambda = 0;
};

std::vector<Spring> springs_of(const Cloth& cloth, const ClothMaterial& material) {
  std::vector<Spring> springs;
  const auto add = [&](int a, int b, double stiffness) {
    springs.push_back({a, b, (cloth.pattern[a] - cloth.pattern[b]).length(), 1 / stiffness});
  };
  for (int j = 0; j < cloth.rows; ++j)
    for (int i = 0; i < cloth.columns; ++i) {
      const bool right = i < cloth.quad_columns(), up = j + 1 < cloth.rows;
      if (right) add(cloth.at(i, j), cloth.at(i + 1, j), material.stretch);
      if (up) add(cloth.at(i, j), cloth.at(i, j + 1), material.stretch);
      if (right && up) {
        add(cloth.at(i, j), cloth.at(i + 1, j + 1), material.shear);
        add(cloth.at(i + 1, j), cloth.at(i, j + 1), material.shear);
      }
    }
  return springs;
}

struct Step {
  Cloth& cloth;
  const ClothMaterial& material;
  const Surroundings& around;
  double dt;
  int sweeps;
  std::vector<Spring> springs;
  std::vector<Stencil> stencils;
  SelfContact self_contact;
  std::vector<Vec3d> before;
  double time = 0;

  void predict() {
    time += dt;
    const double keep = std::exp(-around.drag * dt);
    for (std::size_t i = 0; i < before.size(); ++i) {
      before[i] = cloth.positions[i];
      if (cloth.inverse_mass[i] == 0) continue;
      const Vec3d& x = cloth.positions[i];
      Vec3d& v = cloth.velocities[i];
      const Vec3d outward(x.x, 0, x.z), wind = Vec3d(-x.z, 0, x.x) * (around.spin * around.wind_share);
      v = wind + (v - wind) * keep;
      v += (Vec3d(0, -gravity, 0) + outward * (around.spin * around.spin)) * dt;
      cloth.positions[i] += v * dt;
    }
  }

  void bend() {
    const double damping = material.bending_damping / dt;
    std::vector<Vec3d>& x = cloth.positions;
    for (const Stencil& s : stencils) {
      Vec3d c(0), change(0);
      double sum = 0;
      for (int k = 0; k < 9; ++k) {
        const int v = s.vertices[k];
        c += x[v] * s.weights[k];
        change += (x[v] - before[v]) * s.weights[k];
        sum += s.weights[k] * s.weights[k] * cloth.inverse_mass[v];
      }
      const double sharpness = c.length2() * (material.least_radius * material.least_radius / s.area);
      const double stiffness = material.bending * (1 + sharpness * sharpness), compliance = 1 / (stiffness * dt * dt);
      const Vec3d lambda = (c + change * damping) * (-1 / ((1 + damping) * sum + compliance));
      for (int k = 0; k < 9; ++k) x[s.vertices[k]] += lambda * (s.weights[k] * cloth.inverse_mass[s.vertices[k]]);
    }
  }

  void stretch(Spring& s) {
    Vec3d &a = cloth.positions[s.a], &b = cloth.positions[s.b];
    const double wa = cloth.inverse_mass[s.a], wb = cloth.inverse_mass[s.b];
    const Vec3d d = a - b;
    const double length = d.length(), alpha = s.compliance / (dt * dt);
    if (wa + wb == 0 || length == 0) return;
    const double change = -(length - s.rest + alpha * s.lambda) / (wa + wb + alpha);
    s.lambda += change;
    a += d * (wa * change / length);
    b -= d * (wb * change / length);
  }

  void collide() {
    for (const Solid& solid : around.solids)
      for (std::size_t i = 0; i < before.size(); ++i) {
        if (cloth.inverse_mass[i] == 0) continue;
        Vec3d& x = cloth.positions[i];
        const SolidDistance d = solid.distance(x - solid.velocity * time);
        const double depth = around.gap - d.distance;
        if (depth <= 0) continue;
        x += d.normal * depth;
        const Vec3d slip = x - before[i] - solid.velocity * dt, along = slip - d.normal * slip.dot(d.normal);
        const double s = along.length();
        if (s > 0) x -= along * (std::min(solid.friction * depth, s) / s);
      }
  }

  double advance() {
    predict();
    for (Spring& s : springs) s.lambda = 0;
    bend();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      if (sweep % 2 == 0)  // to and fro, so that no direction of the grid is favoured
        for (auto s = springs.begin(); s != springs.end(); ++s) stretch(*s);
      else
        for (auto s = springs.rbegin(); s != springs.rend(); ++s) stretch(*s);
      self_contact.resolve(cloth.positions, before, cloth.inverse_mass);
      collide();
    }
    double fastest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      cloth.velocities[i] = (cloth.positions[i] - before[i]) / dt;
      fastest = std::max(fastest, cloth.velocities[i].length());
    }
    return fastest;
  }
};

}  // namespace

double simulate(Cloth& cloth, const ClothMaterial& material, const Surroundings& surroundings, double seconds,
                double time_step, int sweeps, double rest_speed) {
  const std::vector<double> areas = vertex_areas(cloth);
  for (std::size_t i = 0; i < areas.size(); ++i)
    if (cloth.inverse_mass[i] > 0) cloth.inverse_mass[i] = 1 / (material.density * areas[i]);
  Step step{cloth,
            material,
            surroundings,
            time_step,
            sweeps,
            springs_of(cloth, material),
            bending_stencils(cloth),
            SelfContact(cloth, material.thickness, material.friction),
            std::vector<Vec3d>(cloth.positions.size())};
  const int steps = int(std::ceil(seconds / time_step));
  double fastest = 0;
  for (int n = 0; n < steps; ++n) {
    fastest = step.advance();
    if (fastest < rest_speed) break;
  }
  return fastest;
}

}  // namespace sateen
