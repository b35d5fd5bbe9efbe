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
                                        double gamma, double panel_gammas, double panel_radians, int nodes) {
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
        tangents.push_back({start, start, 0, share, 0, 0});
      continue;
    }
    const int panels =
        std::max(1, int(std::ceil((end - start) / std::min(panel_gammas * gamma, panel_radians) - 1e-6)));
    for (int k = 0; k < panels; ++k)
      for (const QuadratureNode& n : rule)
        tangents.push_back({start, end, (k + n.position) / panels, share * n.weight / panels, double(k) / panels,
                            double(k + 1) / panels});
  }
  std::stable_partition(tangents.begin(), tangents.end(), [](const Tangent& t) { return t.start != t.end; });
  return tangents;
}

std::vector<Tangent> render_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                       double gamma, double masking_width, double fineness) {
  const double widest = std::min(1.25 * masking_width, 25 * to_radians);
  return tangent_quadrature(offsets_deg, lengths, gamma, 8.0 / fineness, widest / fineness, panel_nodes);
}

std::vector<Tangent> table_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                      double gamma) {
  return tangent_quadrature(offsets_deg, lengths, gamma, 10.0, 60 * to_radians, panel_nodes);
}

std::vector<Tangent> cut_panels(const std::vector<Tangent>& tangents, double panel_radians) {
  std::vector<Tangent> cut;
  for (size_t i = 0; i < tangents.size();) {
    const Tangent& first = tangents[i];
    size_t end = i + 1;
    while (end < tangents.size() && first.start != first.end && tangents[end].start == first.start &&
           tangents[end].end == first.end && tangents[end].panel_from == first.panel_from)
      ++end;
    const double width = first.panel_to - first.panel_from;
    const int pieces = std::max(1, int(std::ceil(width * (first.end - first.start) / panel_radians - 1e-6)));
    for (int piece = 0; piece < pieces; ++piece) {
      const double from = first.panel_from + piece * width / pieces;
      for (size_t k = i; k < end; ++k) {
        Tangent t = tangents[k];
        t.node = from + (t.node - first.panel_from) / pieces;
        t.weight /= pieces;
        t.panel_from = from;
        t.panel_to = from + width / pieces;
        cut.push_back(t);
      }
    }
    i = end;
  }
  return cut;
}

SignChange sign_change() {
  const std::vector<QuadratureNode> rule = gauss_legendre(panel_nodes);
  SignChange rows{};
  for (int k = 0; k < panel_nodes; ++k) {
    // The node's Lagrange polynomial in y = 2x - 1.
    std::array<double, panel_nodes> lagrange{1};
    int degree = 0;
    for (int m = 0; m < panel_nodes; ++m) {
      if (m == k) continue;
      const double root = 2 * rule[m].position - 1, scale = 1 / (2 * (rule[k].position - rule[m].position));
      ++degree;
      for (int j = degree; j >= 0; --j)
        lagrange[j] = ((j > 0 ? lagrange[j - 1] : 0) - root * (j < degree ? lagrange[j] : 0)) * scale;
    }
    // Twice its integral from -1 to y, over the weight, less 1; dx = dy / 2.
    double at_minus_one = 0;
    for (int j = 0; j < panel_nodes; ++j) {
      rows[j + 1][k] = lagrange[j] / (j + 1) / rule[k].weight;
      at_minus_one += rows[j + 1][k] * (j % 2 ? 1 : -1);
    }
    rows[0][k] = -at_minus_one - 1;
  }
  return rows;
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
