#pragma once
#include <array>
#include <cmath>
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

/// Cosines and sines of angles, each as a number and what its rounding left out (0 in double).
template <class Real>
struct Turns {
  std::vector<Real> cosine, cosine_rest, sine, sine_rest;
  void add(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    cosine.push_back(Real(c)), cosine_rest.push_back(Real(c - double(Real(c))));
    sine.push_back(Real(s)), sine_rest.push_back(Real(s - double(Real(s))));
  }
};

/// All tangents of both families as arrays, compiled for one number type: float arrays run in PairLanes or WideLanes,
/// double arrays one by one as the oracle. cloth-model.md sections 1 to 3. Compiled and immutable.
template <class Real>
struct Threads {
  std::vector<Real> node;                ///< place in the segment, 0 to 1
  std::vector<Real> start, span;         ///< segment of a tangent that is in no panel [radians]; 0 for a flat piece
  std::vector<Real> flat, inverse_span;  ///< 1 and 0 for a flat piece, else 0 and 1 / span
  Turns<Real> own;                       ///< offsets of flat pieces; 0 for all others
  std::vector<Real> weight;              ///< coverage times quadrature weight
  std::vector<Real> along_x;             ///< 1 where the thread runs along x (warp), 0 along y (weft)
  std::vector<Real> eta2, eta2_minus_1;
  std::vector<Real> surface_exponent, surface_norm;  ///< 1 / (2 gamma_s^2), 1 / (gamma_s sqrt(2 pi))
  std::vector<Real> volume_exponent, volume_norm;    ///< the same of gamma_v; the norm times 1 - k_d
  std::vector<Real> isotropic;                       ///< k_d
  Real masking_exponent = 0;                         ///< 2 / sigma^2: u(x) = exp(-masking_exponent (x/2)^2)
  Real gap = 0;                                      ///< max(0, 1 - a_1 - a_2)
  int count = 0;                                     ///< padded to a multiple of 16; the padding has no weight
  int first[2] = {-1, -1};  ///< some tangent of warp and of weft, for its constants; -1: the family has none

  /// The first blocks of 8 tangents are panels of Gauss-Legendre nodes, `panels[0]` of the warp, then `panels[1]` of
  /// the weft: each panel's segment, the place of the panel's ends in it, and the integrals of sign_change(). Padded
  /// to a multiple of 8 with panels that have no span.
  int panels[2] = {0, 0};
  std::vector<Real> panel_from, panel_to, panel_span, panel_warp;
  std::vector<Real> panel_offset[2];  ///< start and end of the segment [radians]
  Turns<Real> ends[2];                ///< of both
  Real clip_free[2];          ///< wi sees all segments of warp or weft end to end while |wi.d| <= clip_free wi.z
  bool loose_slopes = false;  ///< some sloping segments are not in panels: finer rules that the tests measure with
  Real sign_change[panel_nodes + 1][panel_nodes];

  /// The same curves with panels of 4.5 degrees at most, for pairs with a direction that grazes the cloth: there
  /// everything turns faster along a thread. One entry, or none where all panels are that short.
  std::vector<Threads> grazing;
};

/// wi.z or wo.z below which `grazing` serves: 5.7 degrees. Errors between 1e-3 and 3e-3 of the peak were all below
/// it.
inline constexpr float grazing_z = 0.1f;

/// wi.z + wo.z below which it serves where wi and wo lie on opposite sides: the mirror images of low light, in which
/// all masking turns within some degrees. What was left of errors between 4e-4 and 1.4e-3 of the peak was there; one
/// pair in 40 of all.
inline constexpr float opposite_grazing_z = 0.5f;

/// Most tangents that one look may need: gamma 0.5 degrees over a full curve in both families takes 840.
inline constexpr int most_tangents = 1024;

/// Most panels: blocks of 8.
inline constexpr int most_panels = most_tangents / panel_nodes;

/// Size of the arrays over tangents: not a power of two, or they all would share a few sets of the cache.
inline constexpr int tangent_slots = most_tangents + 48;

/// What a direction sees of the panels' segments (panel_sight.h), for each panel.
template <class Real>
struct PanelSight {
  Real normal[2][most_panels], along[2][most_panels];  ///< w.n_t and w.t at start and end
  Real reach[most_panels];      ///< how far it sees from the end that it sees; 10 where from end to end [radians]
  Real elevation[most_panels];  ///< over the cloth in the panel's plane, 0 to pi/2 [radians]
};

/// The parts of their segments that the panels' nodes are gathered in, as offsets from a reference: the segment's
/// start (0), its end (1), or no offset (2). `seen` is 0 where there is no such part.
template <class Real>
struct PanelWindows {
  Real reference[most_panels], from[most_panels], seen[most_panels];  ///< the last two in radians
  Real along[most_panels], normal[most_panels];                       ///< wo.t and wo.n_t on the reference
  Real start[most_panels], inverse_width[most_panels];                ///< where the panel lies now [radians]
  Real changed[most_panels];  ///< above 0 where wi made another window of it than wo alone
};

/// Everything of a tangent that depends on the view alone, once per hit. Only the first `count` entries are filled.
/// The nodes of a sloping segment are spread over the part of it that faces the view, since the integrand has a
/// kink where that part ends; `scatter` gathers them once more where wi sees less, and corrects the panels for the
/// kinks that the minima in M and P have inside.
template <class Real>
struct ThreadView {
  Real cos_offset[tangent_slots], sin_offset[tangent_slots];    ///< of the offset from its panel's reference
  Real weight_warp[tangent_slots], weight_weft[tangent_slots];  ///< each in its own family's array, else 0
  Real sin_r[tangent_slots], cos_r[tangent_slots];              ///< inclination of wo on the thread
  Real normal_r[tangent_slots], binormal_r[tangent_slots];      ///< unit azimuth of wo; normal_r = cos phi_r >= 0
  Real projected_r[tangent_slots];                              ///< p_r = max(cos psi_r, 0)
  bool alive[most_panels];                                      ///< blocks of 8 in which some tangent faces the view
  Real scale[2];                                                ///< 1 / hypot(d, z) of wo for warp and weft
  Real across_d[2], across_n[2];  ///< unit (d, n) projection of wo for warp and weft: the angle psi_r
  Real from[2], to[2];            ///< offsets of the two families that can face the view, for loose slopes [radians]
  PanelSight<Real> sight;
  PanelWindows<Real> windows;
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
