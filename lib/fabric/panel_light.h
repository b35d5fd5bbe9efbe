#pragma once
#include "fabric/panel_sight.h"

// What a light direction has in common for all tangents of a family, and for all nodes of a panel, for
// thread_kernel.h: eight panels at a time.

namespace sateen {

namespace {

/// What a light direction has in common for all tangents of a family.
template <class Real>
struct FamilyTerms {
  // Offsets at which the minima in M and P change their argument: m_i = m_r and p_i = p_r. Below them m_r < m_i and
  // p_r < p_i where `side` is 1, above where it is -1.
  Real masking_kink[8], projected_kink[8], side[8];
  Real scale[8];  ///< 1 / hypot(d, z)
  Real blend[8];  ///< u(psi_d): psi_i and psi_r turn together with the offset, so it belongs to the family
};

template <class P, class Real>
void family_terms(const Threads<Real>& t, const ThreadView<Real>& view, Real x, Real y, Real z,
                  FamilyTerms<Real>& terms) {
  using Pair = Vector<P>;
  const P z_i = P(z), z_r = P(view.wo[2]), zero = P(Real(0)), quarter = P(Real(0.25));
  for (int k = 0; k < 2; k += Pair::width) {
    const P d_i = Pair::pair(x, y, k), d_r = Pair::pair(view.wo[0], view.wo[1], k);
    const P b_i = abs(Pair::pair(y, x, k)), b_r = abs(Pair::pair(view.wo[1], view.wo[0], k));
    const P r_d = Pair::pair(view.across_d[0], view.across_d[1], k);
    const P r_n = Pair::pair(view.across_n[0], view.across_n[1], k);
    const P scale = P(Real(1)) / sqrt(max(fma(d_i, d_i, z_i * z_i), P(Real(smallest_projection2))));
    const P e_d = d_i * scale, e_n = z_i * scale;
    const P plus_d = e_d + r_d, plus_n = e_n + r_n, minus_d = e_d - r_d, minus_n = e_n - r_n;
    const P h2 = quarter * fma(plus_d, plus_d, plus_n * plus_n);
    const P q = quarter * fma(minus_d, minus_d, minus_n * minus_n);
    Pair::store(&terms.scale[k], scale);
    Pair::store(&terms.blend[k], exp_negative(P(-t.masking_exponent) * half_angle_squared(q, h2, sqrt(h2))));
    // cos phi_i = cos phi_r where n_i |b_r| = n_r |b_i|, and both are linear in sine and cosine of the offset.
    const P side = select_less(d_r * z_i, d_i * z_r, P(Real(1)), P(Real(-1)));
    Pair::store(&terms.side[k], side);
    Pair::store(&terms.masking_kink[k], signed_angle(side * (z_i * b_r - z_r * b_i), side * (d_i * b_r - d_r * b_i)));
    // p is the cosine of psi plus the offset: the middle between the two. Of the two forms of the tangent of half a
    // sum the one that does not cancel: of nearly opposite directions the sums are nothing but rounding.
    const P apart = select_less(minus_d, zero, zero - minus_n, minus_n);
    const P across = select_less(h2, q, apart, zero - plus_d), along = select_less(h2, q, abs(minus_d), plus_n);
    Pair::store(&terms.projected_kink[k], signed_angle(across, along));
  }
}

/// What wi has in common with the nodes of each panel.
template <class Real>
struct PanelLight {
  Real along[most_panels], normal[most_panels];  ///< wi.t and wi.n_t on the panel's reference
  // Where the minima in M and P change their argument, as places in the panel; 0 where that is outside of it.
  Real masking[most_panels], projected[most_panels];
  Real side[most_panels];     ///< that of the family
  Real between[most_panels];  ///< what side is between the two places
};

template <class P, class Real>
Sight<P> load_sight(const PanelSight<Real>& sight, int p) {
  const auto load = [p](const Real* values) { return Vector<P>::load(values + p); };
  return {{load(sight.normal[0]), load(sight.normal[1])},
          {load(sight.along[0]), load(sight.along[1])},
          load(sight.reach),
          load(sight.elevation)};
}

/// Fills `light`, and where wi may see less than wo also what view terms of both need to be gathered anew: the
/// windows of `gathered`.
template <class P, class Real>
void light_panels(const Threads<Real>& t, const ThreadView<Real>& view_of_wo, Real x, Real y, Real z, bool clipped,
                  const FamilyTerms<Real>& terms, PanelLight<Real>& light, ThreadView<Real>& gathered) {
  using Panel = Vector<P>;
  const P half = P(Real(0.5)), zero = P(Real(0)), one = P(Real(1)), wz = P(z);
  const bool other = view_of_wo.threads != &t;
  for (int p = 0; p < t.panels[0] + t.panels[1]; p += Panel::width) {
    const P is_warp = Panel::load(&t.panel_warp[p]);
    const auto of_family = [&](Real warp, Real weft) { return select_less(half, is_warp, P(warp), P(weft)); };
    const P d = of_family(x, y);
    Sight<P> sight = see_ends<P>(t, p, d, wz);
    P reference, start, inverse_width;
    if (clipped) {
      add_reach(d, wz, sight);
      const P d_r = of_family(view_of_wo.wo[0], view_of_wo.wo[1]), z_r = P(view_of_wo.wo[2]);
      const Sight<P> sight_of_wo = other ? see_panels<P>(t, p, d_r, z_r) : load_sight<P>(view_of_wo.sight, p);
      const Window<P> window = common_window(Panel::load(&t.panel_span[p]), sight, sight_of_wo);
      store_window(p, window, sight_of_wo, d_r, z_r, gathered.windows);
      place_panels(t, p, window, start, inverse_width);
      reference = window.reference;
      const PanelWindows<Real>& before = view_of_wo.windows;
      P changed = one;
      if (!other)
        changed = max(Panel::load(&before.seen[p]) - window.seen, abs(reference - Panel::load(&before.reference[p])));
      Panel::store(&gathered.windows.changed[p], changed);
    } else {
      reference = Panel::load(&view_of_wo.windows.reference[p]);
      start = Panel::load(&view_of_wo.windows.start[p]);
      inverse_width = Panel::load(&view_of_wo.windows.inverse_width[p]);
    }
    Panel::store(&light.along[p], by_reference(reference, sight.along[0], sight.along[1], d));
    Panel::store(&light.normal[p], by_reference(reference, sight.normal[0], sight.normal[1], wz));

    const auto place = [&](const Real* kinks) {
      const P at = (of_family(kinks[0], kinks[1]) - start) * inverse_width;
      return select_less(at, one, max(at, zero), zero);
    };
    const P masking = place(terms.masking_kink), projected = place(terms.projected_kink);
    const P side = of_family(terms.side[0], terms.side[1]);
    Panel::store(&light.masking[p], masking);
    Panel::store(&light.projected[p], projected);
    Panel::store(&light.side[p], side);
    Panel::store(&light.between[p], select_less(projected, masking, side, zero - side));
  }
}

}  // namespace

}  // namespace sateen
