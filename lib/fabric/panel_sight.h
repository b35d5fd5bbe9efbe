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

/// Eight panels side by side for the float kernels of both widths, or one.
template <class V>
using PanelLanes = std::conditional_t<Vector<V>::width == 1, V, Lanes>;

/// What a direction sees of the segments of some panels: one row of PanelSight.
template <class P>
struct Sight {
  P normal[2], along[2], reach, elevation;
};

/// w.n_t and w.t at the ends of the segments of the panels from p on.
template <class P, class Real>
Sight<P> see_ends(const Threads<Real>& t, int p, P along, P z) {
  Sight<P> sight;
  const auto load = [p](const std::vector<Real>& values) { return Vector<P>::load(&values[p]); };
  for (int end = 0; end < 2; ++end) {
    const Turns<Real>& turns = t.ends[end];
    const P c = load(turns.cosine), s = load(turns.sine);
    sight.normal[end] = across_thread(z, along, c, load(turns.cosine_rest), s, load(turns.sine_rest));
    sight.along[end] = fma(along, c, z * s);
  }
  return sight;
}

/// Adds how far it sees: w.n_t = 0 at the angle atan2(w.n_t, w.t) behind the start, or before the end with the other
/// sign of w.t.
template <class P>
void add_reach(P along_panel, P z, Sight<P>& sight) {
  using Real = typename Vector<P>::Real;
  const P zero = P(Real(0)), tiny = P(Real(1e-30f)), everything = P(Real(10)), half_turn = P(Real(2 * quarter_turn));
  const P first = sight.normal[0], last = sight.normal[1];
  const P normal = select_less(zero, first, first, max(last, zero));
  const P along = select_less(zero, first, sight.along[0], zero - sight.along[1]);
  const P acute = atan_magnitude(normal, max(abs(along), tiny));
  const P angle = select_less(along, zero, half_turn - acute, acute);
  sight.reach = select_less(zero, min(first, last), everything, angle);
  sight.elevation = atan_magnitude(z, max(abs(along_panel), tiny));
}

/// Both of the above.
template <class P, class Real>
Sight<P> see_panels(const Threads<Real>& t, int p, P along, P z) {
  Sight<P> sight = see_ends<P>(t, p, along, z);
  add_reach(along, z, sight);
  return sight;
}

/// What two directions both see of the segments of some panels: one row of PanelWindows.
template <class P>
struct Window {
  P reference, from, seen;
};

template <class P>
Window<P> common_window(P span, const Sight<P>& a, const Sight<P>& b) {
  using Real = typename Vector<P>::Real;
  const P zero = P(Real(0)), one = P(Real(1));
  const P start = min(a.normal[0], b.normal[0]), end = min(a.normal[1], b.normal[1]);
  const P either = max(min(a.normal[0], b.normal[1]), min(a.normal[1], b.normal[0]));
  const P near = min(span, min(a.reach, b.reach));
  const P across = select_less(zero, either, min(span, a.elevation + b.elevation), zero);
  const P from_across = zero - select_less(zero, a.normal[0], b.elevation, a.elevation);
  return {select_less(zero, start, zero, select_less(zero, end, one, one + one)),
          select_less(zero, start, zero, select_less(zero, end, zero - near, from_across)),
          select_less(zero, max(start, end), near, across)};
}

/// One of three by the reference of a window.
template <class P>
P by_reference(P reference, P start, P end, P none) {
  using Real = typename Vector<P>::Real;
  return select_less(reference, P(Real(0.5)), start, select_less(reference, P(Real(1.5)), end, none));
}

/// Where the panels from p on lie now.
template <class P, class Real>
void place_panels(const Threads<Real>& t, int p, const Window<P>& window, P& start, P& inverse_width) {
  const auto load = [p](const std::vector<Real>& values) { return Vector<P>::load(&values[p]); };
  const P zero = P(Real(0)), from = load(t.panel_from), width = window.seen * (load(t.panel_to) - from);
  const P offset = by_reference(window.reference, load(t.panel_offset[0]), load(t.panel_offset[1]), zero);
  start = offset + fma(window.seen, from, window.from);
  inverse_width = select_less(zero, window.seen, P(Real(1)) / max(width, P(Real(1e-30f))), zero);
}

/// Keeps a window for fill_blocks; `sight`, `along` and `z` are those of wo.
template <class P, class Real>
void store_window(int p, const Window<P>& window, const Sight<P>& sight, P along, P z, PanelWindows<Real>& windows) {
  using Panel = Vector<P>;
  Panel::store(&windows.from[p], window.from);
  Panel::store(&windows.seen[p], window.seen);
  Panel::store(&windows.along[p], by_reference(window.reference, sight.along[0], sight.along[1], along));
  Panel::store(&windows.normal[p], by_reference(window.reference, sight.normal[0], sight.normal[1], z));
}

/// Sight and windows of view.wo alone.
template <class P, class Real>
void view_panels(const Threads<Real>& t, ThreadView<Real>& view) {
  using Panel = Vector<P>;
  const P half = P(Real(0.5)), z = P(view.wo[2]);
  for (int p = 0; p < t.panels[0] + t.panels[1]; p += Panel::width) {
    const P d = select_less(half, Panel::load(&t.panel_warp[p]), P(view.wo[0]), P(view.wo[1]));
    const Sight<P> sight = see_panels<P>(t, p, d, z);
    for (int end = 0; end < 2; ++end) {
      Panel::store(&view.sight.normal[end][p], sight.normal[end]);
      Panel::store(&view.sight.along[end][p], sight.along[end]);
    }
    Panel::store(&view.sight.reach[p], sight.reach);
    Panel::store(&view.sight.elevation[p], sight.elevation);
    const Window<P> window = common_window(Panel::load(&t.panel_span[p]), sight, sight);
    P start, inverse_width;
    place_panels(t, p, window, start, inverse_width);
    store_window(p, window, sight, d, z, view.windows);
    Panel::store(&view.windows.reference[p], window.reference);
    Panel::store(&view.windows.start[p], start);
    Panel::store(&view.windows.inverse_width[p], inverse_width);
  }
}

}  // namespace

}  // namespace sateen
