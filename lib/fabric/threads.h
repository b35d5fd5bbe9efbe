#pragma once
#include <array>
#include <vector>

#include "fabric/tangent_curve.h"
#include "look/look.h"

namespace sateen {

/// The light that the two families send from wi to wo, before colour: F = (S_0 + S_1 + A_0 V_0 + A_1 V_1), each
/// already divided by Q and with the thread's cosine inside [1/sr].
template <class Real>
struct ThreadSums {
  std::array<Real, 2> surface{}, volume{};  ///< warp, weft
  Real reweight = 0;                        ///< Q, by which both are divided; 0 where every P is 0
};

/// All tangents of both families as arrays, compiled for one number type: float arrays run in PairLanes or WideLanes,
/// double arrays one by one as the oracle. cloth-model.md sections 1 to 3. Compiled and immutable.
template <class Real>
struct Threads {
  std::vector<Real> start, span, node;   ///< segment and place in it (tangent_curve.h) [radians, radians, 0 to 1]
  std::vector<Real> flat, inverse_span;  ///< 1 and 0 for a flat piece, else 0 and 1 / span
  std::vector<Real> weight;              ///< coverage times quadrature weight
  std::vector<Real> along_x;             ///< 1 where the thread runs along x (warp), 0 along y (weft)
  std::vector<Real> eta2, eta2_minus_1;
  std::vector<Real> surface_exponent, surface_norm;  ///< 1 / (2 gamma_s^2), 1 / (gamma_s sqrt(2 pi))
  std::vector<Real> volume_exponent, volume_norm;    ///< the same of gamma_v; the norm times 1 - k_d
  std::vector<Real> isotropic;                       ///< k_d
  Real masking_exponent = 0;                         ///< 2 / sigma^2: u(x) = exp(-masking_exponent (x/2)^2)
  Real gap = 0;                                      ///< max(0, 1 - a_1 - a_2)
  Real slope_from[2], slope_to[2];  ///< extent of the sloping segments of warp and weft; from > to where none
  Real clip_free[2];                ///< all of them face wi while |wi.d| <= clip_free wi.z
  int count = 0;                    ///< padded to a multiple of 16; the padding has no weight
  int first[2] = {-1, -1};          ///< some tangent of warp and of weft, for its constants; -1: the family has none

  /// The first blocks of 8 tangents are panels of Gauss-Legendre nodes, `panels[0]` of the warp, then `panels[1]` of
  /// the weft: place of each panel's ends in its segment, and the integrals of sign_change().
  int panels[2] = {0, 0};
  std::vector<Real> panel_from, panel_to;
  Real sign_change[panel_nodes + 1][panel_nodes];

  /// The same curves with panels of 8.5 degrees at most, for pairs with a direction that grazes the cloth: there
  /// everything turns faster along a thread. One entry, or none where all panels are that short.
  std::vector<Threads> grazing;
};

/// wi.z or wo.z below which `grazing` serves: 5.7 degrees. Errors between 1e-3 and 3e-3 of the peak were all below
/// it.
inline constexpr float grazing_z = 0.1f;

/// Most tangents that one look may need: gamma 0.5 degrees over a full curve in both families takes 840.
inline constexpr int most_tangents = 1024;

/// Everything of a tangent that depends on the view alone, once per hit. Only the first `count` entries are filled.
/// The nodes of a sloping segment are spread over the part of it that faces the view, since the integrand has a
/// kink where that part ends; `scatter` gathers them once more where wi sees less, and corrects the panels for the
/// kinks that the minima in M and P have inside.
template <class Real>
struct ThreadView {
  Real cos_offset[most_tangents], sin_offset[most_tangents];
  Real weight_warp[most_tangents], weight_weft[most_tangents];  ///< each in its own family's array, else 0
  Real sin_r[most_tangents], cos_r[most_tangents];              ///< inclination of wo on the thread
  Real normal_r[most_tangents], binormal_r[most_tangents];      ///< unit azimuth of wo; normal_r = cos phi_r >= 0
  Real projected_r[most_tangents];                              ///< p_r = max(cos psi_r, 0)
  bool alive[most_tangents / 8];                                ///< blocks of 8 in which some tangent faces the view
  Real scale[2];                                                ///< 1 / hypot(d, z) of wo for warp and weft
  Real across_d[2], across_n[2];  ///< unit (d, n) projection of wo for warp and weft: the angle psi_r
  Real from[2], to[2];            ///< offsets of the two families that can face the view [radians]
  Real panel_start[most_tangents / 8], panel_inverse[most_tangents / 8];  ///< where a panel lies now; 1 / its width
  Real wo[3] = {0, 0, 0};
  const Threads<Real>* threads = nullptr;  ///< those that the arrays belong to: the look's own or their `grazing`
};

/// Compiles the quadratures of the two families. InputError when they need more than most_tangents.
template <class Real>
Threads<Real> compile_threads(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft);

/// View terms for a unit wo in the cloth frame.
template <class Real>
void prepare_view(const Threads<Real>& threads, Real x, Real y, Real z, ThreadView<Real>& view);

/// F of cloth-model.md section 3 for a unit wi in the cloth frame; all zero unless wi.z > 0 and wo.z > 0, or where
/// every P is 0.
template <class Real>
ThreadSums<Real> scatter(const Threads<Real>& threads, const ThreadView<Real>& view, Real x, Real y, Real z);

}  // namespace sateen
