#include "fabric/tangent_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sateen {

namespace {
constexpr double to_radians = std::numbers::pi / 180;

double total_length(const std::vector<float>& lengths) {
  double total = 0;
  for (const float l : lengths) total += l;
  return total;
}
}  // namespace

std::vector<QuadratureNode> gauss_legendre(int count) {
  std::vector<QuadratureNode> nodes;
  for (int i = 0; i < count; ++i) {
    // Newton's method on the Legendre polynomial from Tricomi's first guess.
    double x = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double p0 = 1, p1 = x;
      for (int k = 2; k <= count; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      if (count == 1) p0 = 1, p1 = x;
      slope = count * (x * p1 - p0) / (x * x - 1);
      const double step = p1 / slope;
      x -= step;
      if (std::abs(step) < 1e-15) break;
    }
    nodes.push_back({(1 - x) / 2, 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

std::vector<Tangent> tangent_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                        double gamma, double panel_gammas, int nodes) {
  const double total = total_length(lengths);
  const std::vector<QuadratureNode> rule = gauss_legendre(nodes);
  std::vector<Tangent> tangents;
  for (size_t i = 0; i < lengths.size(); ++i) {
    const double share = lengths[i] / total;
    if (!(share > 0)) continue;
    const double one = offsets_deg[i] * to_radians, other = offsets_deg[i + 1] * to_radians;
    const double start = std::min(one, other), end = std::max(one, other);
    if (start == end) {
      const auto same = std::find_if(tangents.begin(), tangents.end(),
                                     [&](const Tangent& t) { return t.start == start && t.end == start; });
      if (same != tangents.end())
        same->weight += share;
      else
        tangents.push_back({start, start, 0, share});
      continue;
    }
    const int panels = std::max(1, int(std::ceil((end - start) / (panel_gammas * gamma) - 1e-9)));
    for (int k = 0; k < panels; ++k)
      for (const QuadratureNode& n : rule)
        tangents.push_back({start, end, (k + n.position) / panels, share * n.weight / panels});
  }
  // Neighbours in offset share a block of lanes, so that whole blocks can face away from a view.
  std::sort(tangents.begin(), tangents.end(),
            [](const Tangent& a, const Tangent& b) { return a.offset() < b.offset(); });
  return tangents;
}

std::vector<Tangent> render_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                       double gamma) {
  return tangent_quadrature(offsets_deg, lengths, gamma, 8.0, 8);
}

double tangent_offset(const std::vector<float>& offsets_deg, const std::vector<float>& lengths, double u) {
  double left = u * total_length(lengths);
  size_t last = 0;
  for (size_t i = 0; i < lengths.size(); ++i) {
    if (!(lengths[i] > 0)) continue;
    last = i;
    if (left < lengths[i])
      return (offsets_deg[i] + (double(offsets_deg[i + 1]) - offsets_deg[i]) * left / lengths[i]) * to_radians;
    left -= lengths[i];
  }
  return offsets_deg[last + 1] * to_radians;
}

}  // namespace sateen
