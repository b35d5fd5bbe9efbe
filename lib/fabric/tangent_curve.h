#pragma once
#include <vector>

namespace sateen {

/// A thread's tangent curve as the continuous distribution that it is (cloth-model.md section 3): offsets
/// o_0 ... o_k in degrees, lengths l_0 ... l_{k-1}. Segment i has probability l_i / sum(l) and, within it, the offset is
/// uniform between o_i and o_{i+1}; equal neighbours are one tangent, a length of 0 is a jump.

/// One tangent of the quadrature: node `node` of the segment from `start` to `end`. The segment is kept because a
/// direction may see only a part of it, and the nodes then gather in that part.
struct Tangent {
  double start = 0, end = 0;  ///< the segment's offsets [radians], start <= end; equal for a flat piece
  double node = 0;            ///< place within the segment, 0 to 1
  double weight = 0;          ///< all weights of a curve sum to 1

  double offset() const { return start + (end - start) * node; }
};

struct QuadratureNode { double position = 0, weight = 0; };

/// Gauss-Legendre nodes and weights on [0, 1].
std::vector<QuadratureNode> gauss_legendre(int count);

/// Quadrature of the curve for lobes of width `gamma` [radians]: each sloping segment is cut into panels of at most
/// `panel_gammas` widths and each panel gets `nodes` Gauss-Legendre nodes. Flat pieces of one offset are merged.
std::vector<Tangent> tangent_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                        double gamma, double panel_gammas, int nodes);

/// The quadrature that the renderer uses: its error against a fine one is below 1e-3 of the lobe's peak for every
/// look (tests/fabric/quadrature_test.cpp).
std::vector<Tangent> render_quadrature(const std::vector<float>& offsets_deg, const std::vector<float>& lengths,
                                       double gamma);

/// Offset [radians] of the curve at u in [0, 1): u runs along the curve by length.
double tangent_offset(const std::vector<float>& offsets_deg, const std::vector<float>& lengths, double u);

}  // namespace sateen
