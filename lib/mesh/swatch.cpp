#include <cmath>
#include <numbers>

#include "mesh/shape_cages.h"

namespace sateen::shapes {

namespace {

constexpr double side = 0.3;  // metres
constexpr int cells = 36;
constexpr double tau = 2 * std::numbers::pi;

double bump(double x, double at, double width) { return std::exp(-(x - at) * (x - at) / (width * width)); }

// Height of the cloth towards +Z, in metres, over the flat pattern: x across (-0.15 to 0.15), y from the hem up. Three
// folds of unequal width that lean a little and open downwards, a slack sag between two of them, and a fine ripple
// near one edge. The figures were chosen by eye.
double height(double x, double y) {
  const double drop = 1 - y / side;  // 0 where it hangs, 1 at the hem
  const double open = 0.30 + 0.70 * drop * drop * (3 - 2 * drop);
  const double lean = x - 0.030 * drop - 0.012 * std::sin(tau * (0.8 * drop + 0.1));
  const double folds = 0.0125 * bump(lean, -0.085, 0.034) + 0.0165 * bump(lean, 0.012, 0.043) +
                       0.0105 * bump(lean, 0.108, 0.030) - 0.0060 * bump(lean, -0.035, 0.026) -
                       0.0075 * bump(lean, 0.066, 0.028);
  const double sag = 0.0050 * std::sin(tau * (1.15 * x / side + 0.55 * drop + 0.15)) * drop * (1 - 0.45 * drop);
  const double ripple = 0.0016 * std::sin(tau * (3.1 * x / side - 1.3 * drop)) * bump(x, 0.12, 0.07) * drop;
  const double curl = 0.006 * bump(drop, 1.0, 0.16) * std::sin(tau * (0.7 * x / side + 0.3));
  return open * folds + sag + ripple + curl;
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
      for (int k = 0; k < across; ++k)
        x += way * kept(height(way * (k + 1) * small, b) - height(way * k * small, b));
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
