#include "fabric/threads.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "math/lane_functions.h"

namespace sateen {

namespace {

// The kernel is written once over V: Lanes for float arrays, double for the oracle.
template <class Real>
using Vector = std::conditional_t<std::is_same_v<Real, float>, Lanes, double>;
template <class Real>
constexpr int width = std::is_same_v<Real, float> ? Lanes::width : 1;

inline Lanes load(const float* p) {
  return Lanes::load(p);
}
inline double load(const double* p) {
  return *p;
}
inline void store(float* p, Lanes v) {
  v.store(p);
}
inline void store(double* p, double v) {
  *p = v;
}

// cos theta below 1e-12 is far below what a unit direction in float can state (6e-8). The floor only keeps end-on
// threads finite until M, which is 0 or finite there, decides the limit.
constexpr float smallest_cos2 = 1e-24f;
constexpr float smallest_projection2 = 1e-30f;

/// Angle of the projection of a direction into the plane of thread and normal, and the offsets that can face it.
template <class Real>
void facing(Real along, Real z, Real& from, Real& to) {
  // w.n_t = hypot(d, z) cos(psi + alpha): seen while alpha stays within a quarter turn of -psi.
  const Real psi = std::atan2(-along, std::max(z, Real(1e-30f)));
  from = psi - Real(std::numbers::pi / 2);
  to = psi + Real(std::numbers::pi / 2);
}

/// Fills the view terms of one block of tangents with its nodes gathered in view.from ... view.to.
template <class Real>
void fill_block(const Threads<Real>& t, int block, ThreadView<Real>& view) {
  using V = Vector<Real>;
  const Real x = view.wo[0], y = view.wo[1], z = view.wo[2];
  const V wx = V(x), wy = V(y), wz = V(z), zero = V(Real(0)), half = V(Real(0.5));
  bool alive = false;
  for (int k = block * 8; k < block * 8 + 8; k += width<Real>) {
    const V is_warp = load(&t.along_x[k]);
    const V d = select_less(half, is_warp, wx, wy), b = select_less(half, is_warp, wy, wx);
    const V scale = select_less(half, is_warp, V(view.scale[0]), V(view.scale[1]));

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
  if (block < t.panels[0] + t.panels[1]) {
    const int family = block < t.panels[0] ? 0 : 1;
    const Real start = t.start[block * 8], end = start + t.span[block * 8];
    const Real from = std::max(start, view.from[family]), seen = std::min(end, view.to[family]) - from;
    view.panel_start[block] = from + seen * t.panel_from[block];
    view.panel_inverse[block] = seen > 0 ? 1 / (seen * (t.panel_to[block] - t.panel_from[block])) : Real(0);
  }
}

/// A pair of numbers, of warp and weft: in the first two lanes, or number k alone.
inline Lanes both(float warp, float weft, int) {
  return Lanes::of(warp, weft, 1, 1);
}
inline double both(double warp, double weft, int k) {
  return k == 0 ? warp : weft;
}

/// What a light direction has in common for all tangents of a family.
template <class Real>
struct FamilyTerms {
  // Offsets at which the minima in M and P change their argument: m_i = m_r and p_i = p_r. Below them m_r < m_i and
  // p_r < p_i where `side` is 1, above where it is -1.
  Real masking_kink[8], projected_kink[8], side[8];
  Real scale[8];  ///< 1 / hypot(d, z)
  Real blend[8];  ///< u(psi_d): psi_i and psi_r turn together with the offset, so it belongs to the family
};

template <class Real>
void family_terms(const Threads<Real>& t, const ThreadView<Real>& view, Real x, Real y, Real z,
                  FamilyTerms<Real>& terms) {
  using V = Vector<Real>;
  const V z_i = V(z), z_r = V(view.wo[2]), zero = V(Real(0)), quarter = V(Real(0.25));
  const auto signed_angle = [&](V across, V along) {
    const V magnitude = atan_magnitude(across, max(along, V(Real(1e-30f))));
    return select_less(across, zero, zero - magnitude, magnitude);
  };
  for (int k = 0; k < 2; k += width<Real>) {
    const V d_i = both(x, y, k), d_r = both(view.wo[0], view.wo[1], k);
    const V b_i = abs(both(y, x, k)), b_r = abs(both(view.wo[1], view.wo[0], k));
    const V r_d = both(view.across_d[0], view.across_d[1], k), r_n = both(view.across_n[0], view.across_n[1], k);
    const V scale = V(Real(1)) / sqrt(max(fma(d_i, d_i, z_i * z_i), V(Real(smallest_projection2))));
    const V e_d = d_i * scale, e_n = z_i * scale;
    const V plus_d = e_d + r_d, plus_n = e_n + r_n, minus_d = e_d - r_d, minus_n = e_n - r_n;
    const V h2 = quarter * fma(plus_d, plus_d, plus_n * plus_n);
    const V q = quarter * fma(minus_d, minus_d, minus_n * minus_n);
    store(&terms.scale[k], scale);
    store(&terms.blend[k], exp_negative(V(-t.masking_exponent) * half_angle_squared(q, h2, sqrt(h2))));
    // cos phi_i = cos phi_r where n_i |b_r| = n_r |b_i|, and both are linear in sine and cosine of the offset.
    const V side = select_less(d_r * z_i, d_i * z_r, V(Real(1)), V(Real(-1)));
    store(&terms.side[k], side);
    store(&terms.masking_kink[k], signed_angle(side * (z_i * b_r - z_r * b_i), side * (d_i * b_r - d_r * b_i)));
    // p is the cosine of psi plus the offset: the middle between the two.
    store(&terms.projected_kink[k], signed_angle(zero - plus_d, plus_n));
  }
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

template <class Real>
void prepare_view(const Threads<Real>& threads, Real x, Real y, Real z, ThreadView<Real>& view) {
  const Threads<Real>& t = z < Real(grazing_z) && !threads.grazing.empty() ? threads.grazing.front() : threads;
  view.threads = &t;
  view.wo[0] = x, view.wo[1] = y, view.wo[2] = z;
  for (int family = 0; family < 2; ++family) {
    const Real d = view.wo[family];
    view.scale[family] = 1 / std::sqrt(std::max(d * d + z * z, Real(smallest_projection2)));
    view.across_d[family] = d * view.scale[family];
    view.across_n[family] = z * view.scale[family];
    facing(d, z, view.from[family], view.to[family]);
  }
  for (int block = 0; block * 8 < t.count; ++block) fill_block(t, block, view);
}

template <class Real>
ThreadSums<Real> scatter(const Threads<Real>& threads, const ThreadView<Real>& view_of_wo, Real x, Real y, Real z) {
  using V = Vector<Real>;
  ThreadSums<Real> out;
  if (!(z > 0) || !(view_of_wo.wo[2] > 0)) return out;

  const bool fine = !threads.grazing.empty() && (z < Real(grazing_z) || view_of_wo.wo[2] < Real(grazing_z));
  const Threads<Real>& t = fine ? threads.grazing.front() : threads;
  const int panels = t.panels[0] + t.panels[1];

  // Where wi sees less of a sloping segment than wo does, the nodes gather in what both see.
  ThreadView<Real> gathered;
  const Real along[2] = {x, y};
  const bool other = view_of_wo.threads != &t;
  bool clipped = other;
  for (int family = 0; family < 2; ++family) clipped = clipped || std::abs(along[family]) > t.clip_free[family] * z;
  if (clipped) {
    std::copy(view_of_wo.wo, view_of_wo.wo + 3, gathered.wo);
    for (int family = 0; family < 2; ++family) {
      facing(along[family], z, gathered.from[family], gathered.to[family]);
      gathered.from[family] = std::max(gathered.from[family], view_of_wo.from[family]);
      gathered.to[family] = std::min(gathered.to[family], view_of_wo.to[family]);
      gathered.scale[family] = view_of_wo.scale[family];
    }
  }
  const auto regathers = [&](int block) {
    if (!clipped || other || block >= panels) return other;
    const int family = block < t.panels[0] ? 0 : 1;
    const Real start = t.start[block * 8], end = start + t.span[block * 8];
    return gathered.from[family] > std::max(start, view_of_wo.from[family]) ||
           gathered.to[family] < std::min(end, view_of_wo.to[family]);
  };

  FamilyTerms<Real> terms;
  family_terms(t, view_of_wo, x, y, z, terms);
  const V wx = V(x), wy = V(y), wz = V(z), zero = V(Real(0)), half = V(Real(0.5)), quarter = V(Real(0.25));
  const V one = V(Real(1)), two = V(Real(2)), fall = V(-t.masking_exponent);
  V surface_warp = zero, surface_weft = zero, volume_warp = zero, volume_weft = zero, reweight = zero;
  for (int block = 0; block * 8 < t.count; ++block) {
    const bool regather = regathers(block);
    if (!regather && !view_of_wo.alive[block]) continue;
    if (regather) {
      fill_block(t, block, gathered);
      if (!gathered.alive[block]) continue;
    }
    const ThreadView<Real>& view = regather ? gathered : view_of_wo;
    // min(a, b) is (a + b - |a - b|) / 2. Where the panel holds the place at which a - b changes its sign,
    // Gauss-Legendre nodes miss |a - b|, but not (a - b) times the sign that sign_at_nodes gives.
    Real masking_kink = 0, projected_kink = 0, side = 0;
    if (block < panels) {
      const int family = block < t.panels[0] ? 0 : 1;
      masking_kink = (terms.masking_kink[family] - view.panel_start[block]) * view.panel_inverse[block];
      projected_kink = (terms.projected_kink[family] - view.panel_start[block]) * view.panel_inverse[block];
      side = terms.side[family];
    }
    const bool kink_in_m = masking_kink > 0 && masking_kink<1, kink_in_p = projected_kink> 0 && projected_kink < 1;
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
      const V p_i = normal * select_less(half, is_warp, V(terms.scale[0]), V(terms.scale[1]));
      const V p_r = load(&view.projected_r[k]);
      const V pp = p_i * p_r;
      V p_least = min(p_i, p_r);
      if (kink_in_p) {
        sign_p = V(side) * sign_at_nodes<V>(t, k % 8, projected_kink);
        p_least = half * (p_i + p_r - (p_i - p_r) * sign_p);
      }
      const V u_p = select_less(half, is_warp, V(terms.blend[0]), V(terms.blend[1]));
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

      // cos theta_i / cos^2 theta_d, then the thread's two terms; V keeps 1 / (cos theta_i + cos theta_r) beside
      // F_t^2.
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
  // Every P is 0: F is 0 (cloth-model.md section 3). So too for a denormal, whose inverse is infinite.
  if (!(q >= std::numeric_limits<Real>::min())) return out;
  const Real inverse_q = 1 / (q + t.gap * view_of_wo.wo[2]);
  out.surface = {sum(surface_warp) * inverse_q, sum(surface_weft) * inverse_q};
  out.volume = {sum(volume_warp) * inverse_q, sum(volume_weft) * inverse_q};
  return out;
}

template void prepare_view(const Threads<float>&, float, float, float, ThreadView<float>&);
template void prepare_view(const Threads<double>&, double, double, double, ThreadView<double>&);
template ThreadSums<float> scatter(const Threads<float>&, const ThreadView<float>&, float, float, float);
template ThreadSums<double> scatter(const Threads<double>&, const ThreadView<double>&, double, double, double);

}  // namespace sateen
