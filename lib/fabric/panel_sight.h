#pragma once
#include <type_traits>

#include "fabric/kernel_vectors.h"
#include "fabric/threads.h"

// Which part of its panels' segments a direction sees, for thread_kernel.h. A direction that grazes the cloth may see
// a sliver of a segment and nothing else: then F is made of that sliver, and its width and the cosines in it have to
// be right to their last digits. So both are measured from the segment's end that the direction sees, never as a
// difference of angles.

namespace sateen {

namespace {

/// w.n_t = z cos - d sin, right to a few units in the last place whatever cancels: of rounded products and of rounded
/// sines and cosines what was left out is added.
template <class V>
V across_thread(V z, V d, V cosine, V cosine_rest, V sine, V sine_rest) {
  const V product = d * sine;
  const V left_out = fnma(d, sine, product);
  return (fma(z, cosine, V(typename Vector<V>::Real(0)) - product) + left_out) + fnma(d, sine_rest, z * cosine_rest);
}

/// Eight panels side by side, or one.
template <class V>
using PanelLanes = std::conditional_t<Vector<V>::width == 16, Lanes, V>;

/// w.n_t and w.t at the ends of all panels' segments; how far w sees where it does not see all of them, or where
/// `reach` asks for it.
template <class V, class Real>
void see_panels(const Threads<Real>& t, Real x, Real y, Real z, bool reach, PanelSight<Real>& sight) {
  using Vec = Vector<V>;
  using P = PanelLanes<V>;
  using Panel = Vector<P>;
  const int panels = t.panels[0] + t.panels[1];
  const V wx = V(x), wy = V(y), wz = V(z), none = V(Real(0)), half = V(Real(0.5));
  V least = V(Real(1));
  for (int k = 0; k < int(t.ends_warp.size()); k += Vec::width) {
    const V d = select_less(half, Vec::load(&t.ends_warp[k]), wx, wy);
    const V c = Vec::load(&t.ends.cosine[k]), s = Vec::load(&t.ends.sine[k]);
    const V normal = across_thread(wz, d, c, Vec::load(&t.ends.cosine_rest[k]), s, Vec::load(&t.ends.sine_rest[k]));
    Vec::store(&sight.normal[k], normal);
    Vec::store(&sight.along[k], fma(d, c, wz * s));
    least = min(least, normal);
  }
  for (int family = 0; family < 2; ++family) {
    sight.along[in_plane_slot(family)] = family == 0 ? x : y;
    sight.normal[in_plane_slot(family)] = z;
  }
  sight.whole = !(sum(select_less(none, least, none, V(Real(1)))) > 0);
  if (sight.whole && !reach) return;

  const P zero = P(Real(0)), tiny = P(Real(1e-30f)), everything = P(Real(10)), half_turn = P(Real(2 * quarter_turn));
  for (int k = 0; k < 2; k += Panel::width)
    Panel::store(&sight.elevation[k], atan_magnitude(P(z), max(abs(Panel::pair(x, y, k)), tiny)));
  // w.n_t = 0 at the angle atan2(w.n_t, w.t) behind the start, or before the end with the other sign of w.t.
  for (int p = 0; p < panels; p += Panel::width) {
    const int start = panel_slot(p, 0), end = panel_slot(p, 1);
    const P first = Panel::load(&sight.normal[start]), last = Panel::load(&sight.normal[end]);
    const P normal = select_less(zero, first, first, max(last, zero));
    const P along = select_less(zero, first, Panel::load(&sight.along[start]), zero - Panel::load(&sight.along[end]));
    const P acute = atan_magnitude(normal, max(abs(along), tiny));
    const P angle = select_less(along, zero, half_turn - acute, acute);
    Panel::store(&sight.reach[p], select_less(zero, min(first, last), everything, angle));
  }
}

/// What two directions both see of the panels' segments; `changed` is above 0 where that is another window than
/// `before`.
template <class V, class Real>
void common_windows(const Threads<Real>& t, const PanelSight<Real>& a, const PanelSight<Real>& b,
                    const PanelWindows<Real>& before, PanelWindows<Real>& out) {
  using P = PanelLanes<V>;
  using Panel = Vector<P>;
  const P zero = P(Real(0)), one = P(Real(1)), half = P(Real(0.5));
  for (int p = 0; p < t.panels[0] + t.panels[1]; p += Panel::width) {
    const int first = panel_slot(p, 0), last = panel_slot(p, 1);
    const P a0 = Panel::load(&a.normal[first]), a1 = Panel::load(&a.normal[last]);
    const P b0 = Panel::load(&b.normal[first]), b1 = Panel::load(&b.normal[last]);
    const P start = min(a0, b0), end = min(a1, b1), either = max(min(a0, b1), min(a1, b0));
    const P is_warp = Panel::load(&t.panel_warp[p]);
    const P rise_a = select_less(half, is_warp, P(a.elevation[0]), P(a.elevation[1]));
    const P rise_b = select_less(half, is_warp, P(b.elevation[0]), P(b.elevation[1]));
    const P near = min(Panel::load(&t.panel_span[p]), min(Panel::load(&a.reach[p]), Panel::load(&b.reach[p])));
    const P across = select_less(zero, either, rise_a + rise_b, zero);
    const P from_across = zero - select_less(zero, a0, rise_b, rise_a);
    const P seen = select_less(zero, max(start, end), near, across);
    const P reference = select_less(zero, start, zero, select_less(zero, end, one, one + one));
    Panel::store(&out.seen[p], seen);
    Panel::store(&out.from[p], select_less(zero, start, zero, select_less(zero, end, zero - near, from_across)));
    Panel::store(&out.reference[p], reference);
    Panel::store(&out.changed[p],
                 max(Panel::load(&before.seen[p]) - seen, abs(reference - Panel::load(&before.reference[p]))));
  }
}

}  // namespace

}  // namespace sateen
