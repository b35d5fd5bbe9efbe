#include "fabric/threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "base/error.h"
#include "math/lane_functions.h"

namespace sateen {

namespace {

// The kernel is written once over V: Lanes for float arrays, double for the oracle.
template <class Real>
using Vector = std::conditional_t<std::is_same_v<Real, float>, Lanes, double>;
template <class Real>
constexpr int width = std::is_same_v<Real, float> ? Lanes::width : 1;

inline Lanes load(const float* p) { return Lanes::load(p); }
inline double load(const double* p) { return *p; }
inline void store(float* p, Lanes v) { v.store(p); }
inline void store(double* p, double v) { *p = v; }

// cos theta below 1e-12 is far below what a unit direction in float can state (6e-8). The floor only keeps end-on
// threads finite until M, which is 0 or finite there, decides the limit.
constexpr float smallest_cos2 = 1e-24f;
constexpr float smallest_projection2 = 1e-30f;

// The leading tangents of a curve that form whole panels of panel_nodes.
size_t count_panel_nodes(const std::vector<Tangent>& tangents) {
  size_t n = 0;
  const auto same = [](const Tangent& a, const Tangent& b) {
    return a.start == b.start && a.end == b.end && a.panel_from == b.panel_from && a.weight > 0;
  };
  for (; n + panel_nodes <= tangents.size() && tangents[n].start != tangents[n].end; n += panel_nodes) {
    const auto first = tangents.begin() + long(n);
    const bool longer = n + panel_nodes < tangents.size() && same(first[0], first[panel_nodes]);
    if (longer || !std::all_of(first, first + panel_nodes, [&](const Tangent& t) { return same(*first, t); })) break;
  }
  return n;
}

template <class Real>
void add_tangents(Threads<Real>& out, const ThreadFamily& family, bool warp, const Tangent* begin, const Tangent* end) {
  constexpr double to_radians = std::numbers::pi / 180;
  const double gamma_s = family.gamma_s_deg * to_radians, gamma_v = family.gamma_v_deg * to_radians;
  const double root = std::sqrt(2 * std::numbers::pi), eta = family.eta, k_d = family.k_d;
  const int index = warp ? 0 : 1;
  for (const Tangent* tangent = begin; tangent != end; ++tangent) {
    const Tangent& t = *tangent;
    const bool flat = t.start == t.end;
    out.start.push_back(Real(t.start));
    out.span.push_back(Real(t.end - t.start));
    out.node.push_back(Real(t.node));
    out.flat.push_back(flat ? 1 : 0);
    out.inverse_span.push_back(flat ? 0 : Real(1 / (t.end - t.start)));
    out.weight.push_back(Real(double(family.coverage) * t.weight));
    out.along_x.push_back(warp ? 1 : 0);
    if (!flat) {
      out.slope_from[index] = std::min(out.slope_from[index], Real(t.start));
      out.slope_to[index] = std::max(out.slope_to[index], Real(t.end));
    }
    out.eta2.push_back(Real(eta * eta));
    out.eta2_minus_1.push_back(Real(eta * eta - 1));
    out.surface_exponent.push_back(Real(1 / (2 * gamma_s * gamma_s)));
    out.surface_norm.push_back(Real(1 / (gamma_s * root)));
    out.volume_exponent.push_back(Real(1 / (2 * gamma_v * gamma_v)));
    out.volume_norm.push_back(Real((1 - k_d) / (gamma_v * root)));
    out.isotropic.push_back(Real(k_d));
  }
}

/// The panels of both families, each in a block of its own, then everything else.
template <class Real>
void add_families(Threads<Real>& out, const Look& look, const std::vector<Tangent>& warp,
                  const std::vector<Tangent>& weft) {
  const ThreadFamily* families[2] = {&look.warp, &look.weft};
  const std::vector<Tangent>* curves[2] = {&warp, &weft};
  for (const bool in_panels : {true, false})
    for (int family = 0; family < 2; ++family) {
      if (!(families[family]->coverage > 0)) continue;
      const Tangent* all = curves[family]->data();
      const size_t nodes = count_panel_nodes(*curves[family]);
      if (!in_panels) {
        add_tangents(out, *families[family], family == 0, all + nodes, all + curves[family]->size());
        continue;
      }
      add_tangents(out, *families[family], family == 0, all, all + nodes);
      out.panels[family] = int(nodes / panel_nodes);
      for (size_t n = 0; n < nodes; n += panel_nodes) {
        out.panel_from.push_back(Real(all[n].panel_from));
        out.panel_to.push_back(Real(all[n].panel_to));
      }
    }
  const SignChange rows = sign_change();
  for (int j = 0; j <= panel_nodes; ++j)
    for (int k = 0; k < panel_nodes; ++k) out.sign_change[j][k] = Real(rows[j][k]);
}

template <class Real>
void pad(Threads<Real>& t) {
  while (t.start.size() % 8) {
    for (std::vector<Real>* values :
         {&t.start, &t.span, &t.node, &t.flat, &t.inverse_span, &t.along_x, &t.eta2, &t.eta2_minus_1,
          &t.surface_exponent, &t.surface_norm, &t.volume_exponent, &t.volume_norm, &t.isotropic})
      values->push_back(values->back());
    t.weight.push_back(0);
  }
  t.count = int(t.start.size());
}

/// Angle of the projection of a direction into the plane of thread and normal, and the offsets that can face it.
template <class Real>
void facing(Real along, Real z, Real& from, Real& to) {
  // w.n_t = hypot(d, z) cos(psi + alpha): seen while alpha stays within a quarter turn of -psi.
  const Real psi = std::atan2(-along, std::max(z, Real(1e-30f)));
  from = psi - Real(std::numbers::pi / 2);
  to = psi + Real(std::numbers::pi / 2);
}

/// Fills the view terms of all tangents with the nodes gathered in view.from ... view.to.
template <class Real>
void fill_view(const Threads<Real>& t, ThreadView<Real>& view) {
  using V = Vector<Real>;
  view.threads = &t;
  const Real x = view.wo[0], y = view.wo[1], z = view.wo[2];
  const V wx = V(x), wy = V(y), wz = V(z), zero = V(Real(0)), half = V(Real(0.5));
  const V scale_warp = V(1 / std::sqrt(std::max(x * x + z * z, Real(smallest_projection2))));
  const V scale_weft = V(1 / std::sqrt(std::max(y * y + z * z, Real(smallest_projection2))));
  for (int block = 0; block * 8 < t.count; ++block) {
    bool alive = false;
    for (int k = block * 8; k < block * 8 + 8; k += width<Real>) {
      const V is_warp = load(&t.along_x[k]);
      const V d = select_less(half, is_warp, wx, wy), b = select_less(half, is_warp, wy, wx);
      const V scale = select_less(half, is_warp, scale_warp, scale_weft);

      const V flat = load(&t.flat[k]), a0 = load(&t.start[k]), a1 = a0 + load(&t.span[k]);
      const V from = max(a0, select_less(half, is_warp, V(view.from[0]), V(view.from[1])));
      const V to = min(a1, select_less(half, is_warp, V(view.to[0]), V(view.to[1])));
      const V seen = max(to - from, zero);
      const V offset = select_less(half, flat, a0, fma(seen, load(&t.node[k]), min(from, a1)));
      const V weight = load(&t.weight[k]) * fma(seen, load(&t.inverse_span[k]), flat);
      const V c = cos_quarter(offset), s = sin_quarter(offset);

      const V normal = max(fnma(d, s, wz * c), zero);
      const V cos_r = sqrt(max(fma(normal, normal, b * b), V(Real(smallest_cos2))));
      const V inverse = V(Real(1)) / cos_r;
      store(&view.cos_offset[k], c);
      store(&view.sin_offset[k], s);
      store(&view.weight_warp[k], weight * is_warp);
      store(&view.weight_weft[k], weight * (V(Real(1)) - is_warp));
      store(&view.sin_r[k], fma(d, c, wz * s));
      store(&view.cos_r[k], cos_r);
      store(&view.normal_r[k], normal * inverse);
      store(&view.binormal_r[k], b * inverse);
      store(&view.projected_r[k], normal * scale);
      alive = alive || sum(normal * weight) > 0;
    }
    view.alive[block] = alive;
  }
  for (int panel = 0; panel < t.panels[0] + t.panels[1]; ++panel) {
    const int family = panel < t.panels[0] ? 0 : 1;
    const Real start = t.start[panel * 8], end = start + t.span[panel * 8];
    const Real from = std::max(start, view.from[family]), seen = std::min(end, view.to[family]) - from;
    view.panel_start[panel] = from + seen * t.panel_from[panel];
    view.panel_inverse[panel] = seen > 0 ? 1 / (seen * (t.panel_to[panel] - t.panel_from[panel])) : Real(0);
  }
}

/// Offsets at which the minima in M and P of one family change their argument: m_i = m_r and p_i = p_r. Below them
/// m_r < m_i and p_r < p_i where `side` is 1, above where it is -1.
template <class Real>
struct Kinks {
  Real masking[2], projected[2], side[2];
};

template <class Real>
Kinks<Real> find_kinks(const ThreadView<Real>& view, Real x, Real y, Real z) {
  using V = Vector<Real>;
  const Real d_i[2] = {x, y}, z_r = view.wo[2];
  Kinks<Real> kinks;
  Real across[8] = {}, along[8] = {}, angle[8];
  for (int family = 0; family < 2; ++family) {
    const Real d_r = view.wo[family], b_i = std::abs(d_i[1 - family]), b_r = std::abs(view.wo[1 - family]);
    const Real side = d_i[family] * z_r > d_r * z ? Real(1) : Real(-1);
    kinks.side[family] = side;
    // cos phi_i = cos phi_r where n_i |b_r| = n_r |b_i|, and both are linear in sine and cosine of the offset.
    across[family] = side * (z * b_r - z_r * b_i);
    along[family] = side * (d_i[family] * b_r - d_r * b_i);
    // p is the cosine of psi plus the offset: the middle between the two.
    const Real scale = 1 / std::sqrt(std::max(d_i[family] * d_i[family] + z * z, Real(smallest_projection2)));
    across[2 + family] = -(d_i[family] * scale + view.across_d[family]);
    along[2 + family] = z * scale + view.across_n[family];
  }
  for (int k = 0; k < 4; k += width<Real>) {
    const V a = load(&across[k]), b = max(load(&along[k]), V(Real(0)));
    const V magnitude = atan_magnitude(a, b);
    store(&angle[k], select_less(a, V(Real(0)), V(Real(0)) - magnitude, magnitude));
  }
  for (int family = 0; family < 2; ++family) {
    kinks.masking[family] = angle[family];
    kinks.projected[family] = angle[2 + family];
  }
  return kinks;
}

/// sign(place - x) as the nodes of a panel have to show it: sign_change() at `place`.
template <class V, class Real>
V sign_at_nodes(const Threads<Real>& t, int lane, Real place) {
  const V y = V(2 * place - 1);
  V s = load(&t.sign_change[panel_nodes][lane]);
  for (int j = panel_nodes - 1; j >= 0; --j) s = fma(s, y, load(&t.sign_change[j][lane]));
  return s;
}

}  // namespace

namespace {

template <class Real>
Threads<Real> compile_curves(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft) {
  Threads<Real> threads;
  for (int family = 0; family < 2; ++family) threads.slope_from[family] = 10, threads.slope_to[family] = -10;
  add_families(threads, look, warp, weft);
  if (threads.start.empty()) throw InputError("the look has no threads: both coverages are 0");
  if (threads.start.size() + 8 > most_tangents)
    throw InputError(fmt::format("the tangent curves need {} tangents, at most {} are possible",
                                 threads.start.size(), most_tangents - 8),
                     "widen gamma_s_deg or gamma_v_deg, or give the curve fewer sloping pieces");
  pad(threads);
  for (int family = 0; family < 2; ++family) {
    // |psi| stays a quarter turn away from every sloping offset: tan(pi/2 - largest offset), infinite without slopes.
    const double largest = std::max(-double(threads.slope_from[family]), double(threads.slope_to[family]));
    const bool slopes = threads.slope_from[family] <= threads.slope_to[family];
    threads.clip_free[family] = slopes ? Real(std::tan(std::max(std::numbers::pi / 2 - largest, 0.0)))
                                       : std::numeric_limits<Real>::max();
  }
  const double sigma = look.masking_width_deg * std::numbers::pi / 180;
  threads.masking_exponent = Real(2 / (sigma * sigma));
  threads.gap = Real(std::max(0.0, 1.0 - double(look.warp.coverage) - double(look.weft.coverage)));
  if (threads.gap < Real(1e-6)) threads.gap = 0;  // .9 + .1 is 1
  return threads;
}

}  // namespace

template <class Real>
Threads<Real> compile_threads(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft) {
  Threads<Real> threads = compile_curves<Real>(look, warp, weft);
  const std::vector<Tangent> fine_warp = halve_panels(warp), fine_weft = halve_panels(weft);
  const size_t count = fine_warp.size() + fine_weft.size();
  if (count > warp.size() + weft.size() && count + 8 <= most_tangents)
    threads.grazing.push_back(compile_curves<Real>(look, fine_warp, fine_weft));
  return threads;
}

template <class Real>
void prepare_view(const Threads<Real>& t, Real x, Real y, Real z, ThreadView<Real>& view) {
  view.wo[0] = x, view.wo[1] = y, view.wo[2] = z;
  for (int family = 0; family < 2; ++family) {
    const Real d = view.wo[family];
    const Real inverse = 1 / std::sqrt(std::max(d * d + z * z, Real(smallest_projection2)));
    view.across_d[family] = d * inverse;
    view.across_n[family] = z * inverse;
    facing(d, z, view.from[family], view.to[family]);
  }
  fill_view(z < Real(grazing_z) && !t.grazing.empty() ? t.grazing.front() : t, view);
}

template <class Real>
ThreadSums<Real> scatter(const Threads<Real>& threads, const ThreadView<Real>& view_of_wo, Real x, Real y, Real z) {
  using V = Vector<Real>;
  ThreadSums<Real> out;
  if (!(z > 0) || !(view_of_wo.wo[2] > 0)) return out;

  // Where wi sees less of a sloping segment than wo does, the nodes gather in what both see.
  const bool fine = !threads.grazing.empty() && (z < Real(grazing_z) || view_of_wo.wo[2] < Real(grazing_z));
  const Threads<Real>& t = fine ? threads.grazing.front() : threads;
  const ThreadView<Real>* seen = &view_of_wo;
  ThreadView<Real> gathered;
  const Real along[2] = {x, y};
  bool clipped = view_of_wo.threads != &t;
  for (int family = 0; family < 2; ++family) {
    clipped = clipped || std::abs(along[family]) > t.clip_free[family] * z;
  }
  if (clipped) {
    std::copy(view_of_wo.wo, view_of_wo.wo + 3, gathered.wo);
    for (int family = 0; family < 2; ++family) {
      facing(along[family], z, gathered.from[family], gathered.to[family]);
      gathered.from[family] = std::max(gathered.from[family], view_of_wo.from[family]);
      gathered.to[family] = std::min(gathered.to[family], view_of_wo.to[family]);
      gathered.across_d[family] = view_of_wo.across_d[family];
      gathered.across_n[family] = view_of_wo.across_n[family];
    }
    fill_view(t, gathered);
    seen = &gathered;
  }
  const ThreadView<Real>& view = *seen;

  // psi_i and psi_r turn together with the tangent offset, so u(psi_d) belongs to the family, not to the tangent.
  const V wx = V(x), wy = V(y), wz = V(z), zero = V(Real(0)), half = V(Real(0.5)), quarter = V(Real(0.25));
  const V one = V(Real(1)), two = V(Real(2));
  const V fall = V(-t.masking_exponent);
  V scale_of[2], blend_of[2];
  for (int family = 0; family < 2; ++family) {
    const V d = family == 0 ? wx : wy;
    const V scale = one / sqrt(max(fma(d, d, wz * wz), V(Real(smallest_projection2))));
    const V e_d = d * scale, e_n = wz * scale;
    const V r_d = V(view.across_d[family]), r_n = V(view.across_n[family]);
    const V minus_d = e_d - r_d, minus_n = e_n - r_n, plus_d = e_d + r_d, plus_n = e_n + r_n;
    const V h2 = quarter * fma(plus_d, plus_d, plus_n * plus_n);
    const V q = quarter * fma(minus_d, minus_d, minus_n * minus_n);
    scale_of[family] = scale;
    blend_of[family] = exp_negative(fall * half_angle_squared(q, h2, sqrt(h2)));
  }

  const int panels = t.panels[0] + t.panels[1];
  Kinks<Real> kinks;
  if (panels > 0) kinks = find_kinks(view, x, y, z);

  V surface_warp = zero, surface_weft = zero, volume_warp = zero, volume_weft = zero, reweight = zero;
  for (int block = 0; block * 8 < t.count; ++block) {
    if (!view.alive[block]) continue;
    // min(a, b) is (a + b - |a - b|) / 2. Where the panel holds the place at which a - b changes its sign,
    // Gauss-Legendre nodes miss |a - b|, but not (a - b) times the sign that sign_at_nodes gives.
    Real masking_kink = 0, projected_kink = 0, side = 0;
    if (block < panels) {
      const int family = block < t.panels[0] ? 0 : 1;
      masking_kink = (kinks.masking[family] - view.panel_start[block]) * view.panel_inverse[block];
      projected_kink = (kinks.projected[family] - view.panel_start[block]) * view.panel_inverse[block];
      side = kinks.side[family];
    }
    const bool kink_in_m = masking_kink > 0 && masking_kink < 1, kink_in_p = projected_kink > 0 && projected_kink < 1;
    for (int k = block * 8; k < block * 8 + 8; k += width<Real>) {
      const V is_warp = load(&t.along_x[k]);
      const V d = select_less(half, is_warp, wx, wy), b = select_less(half, is_warp, wy, wx);
      const V c = load(&view.cos_offset[k]), s = load(&view.sin_offset[k]);

      // Inclination and azimuth of wi on this tangent.
      const V sin_i = fma(d, c, wz * s);
      const V normal = max(fnma(d, s, wz * c), zero);
      const V cos_i = sqrt(max(fma(normal, normal, b * b), V(Real(smallest_cos2))));
      const V inverse = one / cos_i;
      const V m_i = normal * inverse, b_i = b * inverse;
      const V m_r = load(&view.normal_r[k]), b_r = load(&view.binormal_r[k]);
      const V plus_n = m_i + m_r, plus_b = b_i + b_r, minus_n = m_i - m_r, minus_b = b_i - b_r;
      const V h2 = quarter * fma(plus_n, plus_n, plus_b * plus_b);     // cos^2(phi_d / 2)
      const V q = quarter * fma(minus_n, minus_n, minus_b * minus_b);  // sin^2(phi_d / 2)
      const V h = sqrt(h2);

      // M and P, each a blend by u between the independent and the fully correlated case.
      const V u = exp_negative(fall * half_angle_squared(q, h2, h));
      const V mm = m_i * m_r;
      V m_least = min(m_i, m_r);
      V sign_m, sign_p;
      if (kink_in_m) {
        sign_m = V(side) * sign_at_nodes<V>(t, k % 8, masking_kink);
        m_least = half * (m_i + m_r - (m_i - m_r) * sign_m);
      }
      const V masking = max(fma(u, m_least - mm, mm), zero);
      const V p_i = normal * select_less(half, is_warp, scale_of[0], scale_of[1]);
      const V p_r = load(&view.projected_r[k]);
      const V pp = p_i * p_r;
      V p_least = min(p_i, p_r);
      if (kink_in_p) {
        sign_p = V(side) * sign_at_nodes<V>(t, k % 8, projected_kink);
        p_least = half * (p_i + p_r - (p_i - p_r) * sign_p);
      }
      const V u_p = select_less(half, is_warp, blend_of[0], blend_of[1]);
      const V projected = max(fma(u_p, p_least - pp, pp), zero);
      V visible = masking * projected;
      if (kink_in_m && kink_in_p) {
        // The product of both signs is 1 but between the places: not the product of what the nodes show of each.
        const V between = V(masking_kink > projected_kink ? side : -side) * (sign_m - sign_p);
        const V product = one - between - sign_m * sign_p;
        visible = max(fma(quarter * u * u_p * (m_i - m_r), (p_i - p_r) * product, visible), zero);
      }

      // sin a + sin b over cos a + cos b is tan((a + b)/2), and the sum of their squares 4 cos^2((a - b)/2): both
      // half angles without a cancellation, even where wi and wo graze opposite ends of the thread.
      const V cos_sum = cos_i + load(&view.cos_r[k]), sin_sum = sin_i + load(&view.sin_r[k]);
      const V four_cos2_d = fma(cos_sum, cos_sum, sin_sum * sin_sum);
      const V theta_h2 = atan_squared(sin_sum, cos_sum);
      const V cos_d = half * sqrt(four_cos2_d);

      // Fresnel at cos(theta_d) cos(phi_d / 2). Transmittance from its own product: 1 - F_r would lose its digits.
      const V cosine = cos_d * h;
      const V eta2 = load(&t.eta2[k]), eta2_minus_1 = load(&t.eta2_minus_1[k]);
      const V g = sqrt(fma(cosine, cosine, eta2_minus_1));
      const V sum_s = cosine + g, sum_p = fma(eta2, cosine, g);
      const V inverse_both = one / max(sum_s * sum_p, V(Real(1e-30f)));
      const V inverse_s = sum_p * inverse_both, inverse_p = sum_s * inverse_both;
      const V r_s = eta2_minus_1 * inverse_s * inverse_s, r_p = (fma(eta2, cosine, zero - g)) * inverse_p;
      const V reflected = half * fma(r_s, r_s, r_p * r_p);
      const V transmitted = two * cosine * g * fma(eta2, inverse_p * inverse_p, inverse_s * inverse_s);

      const V g_s = load(&t.surface_norm[k]) * exp_negative(zero - theta_h2 * load(&t.surface_exponent[k]));
      const V g_v = fma(load(&t.volume_norm[k]), exp_negative(zero - theta_h2 * load(&t.volume_exponent[k])),
                        load(&t.isotropic[k]));

      // cos theta_i / cos^2 theta_d, then the thread's two terms; V keeps 1 / (cos theta_i + cos theta_r) beside F_t^2.
      const V inverse_sum = one / (four_cos2_d * cos_sum);
      const V common = visible * cos_i * V(Real(4)) * (inverse_sum * cos_sum);
      const V surface = common * reflected * h * g_s;
      const V volume = common * (transmitted * transmitted) * g_v * (inverse_sum * four_cos2_d);
      const V w_warp = load(&view.weight_warp[k]), w_weft = load(&view.weight_weft[k]);
      surface_warp = fma(surface, w_warp, surface_warp);
      surface_weft = fma(surface, w_weft, surface_weft);
      volume_warp = fma(volume, w_warp, volume_warp);
      volume_weft = fma(volume, w_weft, volume_weft);
      reweight = fma(projected, w_warp + w_weft, reweight);
    }
  }
  const Real q = sum(reweight);
  if (!(q > 0)) return out;  // every P is 0: F is 0 (cloth-model.md section 3)
  const Real inverse_q = 1 / (q + t.gap * view.wo[2]);
  out.surface = {sum(surface_warp) * inverse_q, sum(surface_weft) * inverse_q};
  out.volume = {sum(volume_warp) * inverse_q, sum(volume_weft) * inverse_q};
  return out;
}

template Threads<float> compile_threads(const Look&, const std::vector<Tangent>&, const std::vector<Tangent>&);
template Threads<double> compile_threads(const Look&, const std::vector<Tangent>&, const std::vector<Tangent>&);
template void prepare_view(const Threads<float>&, float, float, float, ThreadView<float>&);
template void prepare_view(const Threads<double>&, double, double, double, ThreadView<double>&);
template ThreadSums<float> scatter(const Threads<float>&, const ThreadView<float>&, float, float, float);
template ThreadSums<double> scatter(const Threads<double>&, const ThreadView<double>&, double, double, double);

}  // namespace sateen
