#pragma once
#include <array>
#include <vector>

namespace sateen {

/// A thread's tangent curve as the continuous distribution that it is (cloth-model.md section 3): offsets
/// o_0 ... o_k in degrees, lengths l_0 ... l_{k-1}. Segment i has probability l_i / sum(l) and, within it, the offset
/// is uniform between o_i and o_{i+1}; equal neighbours are one tangent, a length of 0 is a jump.

/// One tangent of the quadrature: node `node` of the segment from `start` to `end`. The segment is kept because a
/// direction may see only a part of it, and the nodes then gather in that part.
struct Tangent {
  double start = 0, end = 0;            ///< the segment's offsets [radians], start <= end; equal for a flat piece
  double node = 0;                      ///< place within the segment, 0 to 1
  double weight = 0;                    ///< all weights of a curve sum to 1
  double panel_from = 0, panel_to = 0;  ///< ends within the segment of the panel of Gauss-Legendre nodes, 0 to 1

  double offset() const { return start + (end - start) * node; }
};

struct QuadratureNode {
  double position = 0, weight = 0;
};

/// Gauss-Legendre nodes and weights on [0, 1].
std::vector<QuadratureNode> gauss_legendre(int count);

/// Quadrature of the curve for lobes of width `gamma` [radians]: each sloping segment is cut into panels of at most
/// `panel_gammas` widths and `panel_radians`, and each panel gets `nodes` Gauss-Legendre nodes. Panel after panel,
/// then the flat pieces, those of one offset merged.
std::vector<Tangent> tangent_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                        double gamma, double panel_gammas, double panel_radians, int nodes);

/// Gauss-Legendre nodes of a panel that the renderer uses: one block of lanes.
inline constexpr int panel_nodes = 8;

/// The quadrature that the renderer uses: its error against a fine one is below 1e-3 of the peak of F at that view
/// for every look of the project (tests/fabric/precision_test.cpp; 1e-2 where a direction is within 0.6 degrees of
/// the horizon). Panels of 8 gamma, of 1.25 sigma (`masking_width` [radians], the width of u in M and P) and of 25
/// degrees at most: the lobe, the masking and the angles must each look like a polynomial within a panel. Panels are
/// `fineness` times as short.
std::vector<Tangent> render_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                       double gamma, double masking_width, double fineness = 1);

/// A quadrature with an error of about a hundredth of the peak, half as many nodes: enough for the direction table.
std::vector<Tangent> table_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                      double gamma);

/// The same curve with every panel cut into equal pieces of at most `panel_radians`, each with all the panel's nodes.
std::vector<Tangent> cut_panels(const std::vector<Tangent>& tangents, double panel_radians);

/// Integrals of an integrand that is smooth on a panel but for a change of sign: for h smooth,
///     integral of h(x) sign(c - x) over [0, 1]  ~  sum_k w_k h(x_k) S_k(2c - 1),   S_k(y) = sum_j row[j][k] y^j
/// for any place c in the panel, exact for polynomials below degree panel_nodes. (From the integrals of the nodes'
/// Lagrange polynomials; S_k is 1 where c is 1 and -1 where c is 0.)
using SignChange = std::array<std::array<double, panel_nodes>, panel_nodes + 1>;
SignChange sign_change();

/// Offset [radians] of the curve at u in [0, 1): u runs along the curve by length.
double tangent_offset(const std::vector<float>& offsets_deg, const std::vector<float>& lengths, double u);

}  // namespace sateen
