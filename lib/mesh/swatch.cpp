#include <cmath>
#include <numbers>

#include "mesh/shape_cages.h"

namespace sateen::shapes {

namespace {

constexpr double side = 0.3;  // metres
constexpr int cells = 36;
constexpr double tau = 2 * std::numbers::pi;

double bump(double x, double at, double width) {
  return std::exp(-(x - at) * (x - at) / (width * width));
}

// Height of the cloth towards +Z, in metres, over the flat pattern: x across (-0.15 to 0.15), y from the hem up.
// Swags of unequal depth hang between the upper corners, lowest a little right of the middle, so that warp and weft
// both bend; a fold runs down from the left corner, and the hem ripples. The figures were chosen by eye.
double height(double x, double y) {
  const double drop = 1 - y / side;  // 0 where it hangs, 1 at the hem
  const double off = x - 0.018;
  const double swag = y - 2.3 * off * off + 0.10 * off;
  const double across = 0.35 + 0.65 * bump(off, 0, 0.115);
  const double swags = 0.0130 * bump(swag, 0.236, 0.026) - 0.0070 * bump(swag, 0.196, 0.020) +
                       0.0170 * bump(swag, 0.152, 0.028) - 0.0090 * bump(swag, 0.104, 0.024) +
                       0.0120 * bump(swag, 0.052, 0.030);
  const double lean = x + 0.105 - 0.055 * drop;
  const double fold =
      0.0110 * bump(lean, 0, 0.026) * drop * (1 - 0.35 * drop) - 0.0045 * bump(lean, 0.042, 0.022) * drop;
  const double hem = 0.0045 * std::sin(tau * (2.1 * x / side + 0.2)) * bump(drop, 1.0, 0.22);
  const double belly = 0.012 * std::sin(std::numbers::pi * drop) * bump(x, 0.01, 0.16);
  return across * swags + fold + hem + belly;
}

}  // namespace

ControlMesh swatch() {
  ControlMesh mesh;
  mesh.name = "swatch";
  mesh.metres_per_uv = 1;
  // Along each thread the pattern's step d splits into the height's slope and what is left for the plane, so that the
  // thread keeps its length: dx = sqrt(1 - z_x^2) d. Integrated finely from the middle line and from the top.
  constexpr int fine = 16;
  constexpr double step = side / cells, small = step / fine;
  const auto kept = [](double dz) { return std::sqrt(std::max(0.0, small * small - dz * dz)); };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double a = i * step - side / 2, b = j * step;
      double x = 0, y = side;
      const int across = std::abs(i - cells / 2) * fine, down = (cells - j) * fine;
      const double way = a < 0 ? -1 : 1;
      for (int k = 0; k < across; ++k) x += way * kept(height(way * (k + 1) * small, b) - height(way * k * small, b));
      for (int k = 0; k < down; ++k) y -= kept(height(a, side - (k + 1) * small) - height(a, side - k * small));
      mesh.positions.push_back(Vec3(float(x), float(y), float(height(a, b))));
      mesh.uvs.push_back(Vec2(float(b), float(-a)));  // u up the warp; v to the left, so that the face looks to +Z
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int v = j * (cells + 1) + i;
      mesh.face_sizes.push_back(4);
      for (const int k : {v, v + 1, v + cells + 2, v + cells + 1}) {
        mesh.position_indices.push_back(k);
        mesh.uv_indices.push_back(k);
      }
    }
  }
  return mesh;
}

}  // namespace sateen::shapes
