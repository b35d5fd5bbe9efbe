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

template <class Real>
void add_family(Threads<Real>& out, const ThreadFamily& family, const std::vector<Tangent>& tangents, bool warp) {
  constexpr double to_radians = std::numbers::pi / 180;
  const double gamma_s = family.gamma_s_deg * to_radians, gamma_v = family.gamma_v_deg * to_radians;
  const double root = std::sqrt(2 * std::numbers::pi), eta = family.eta, k_d = family.k_d;
  const int index = warp ? 0 : 1;
  for (const Tangent& t : tangents) {
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
}

}  // namespace

template <class Real>
Threads<Real> compile_threads(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft) {
  Threads<Real> threads;
  for (int family = 0; family < 2; ++family) threads.slope_from[family] = 10, threads.slope_to[family] = -10;
  if (look.warp.coverage > 0) add_family(threads, look.warp, warp, true);
  if (look.weft.coverage > 0) add_family(threads, look.weft, weft, false);
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
  fill_view(t, view);
}

template <class Real>
ThreadSums<Real> scatter(const Threads<Real>& t, const ThreadView<Real>& view_of_wo, Real x, Real y, Real z) {
  using V = Vector<Real>;
  ThreadSums<Real> out;
  if (!(z > 0) || !(view_of_wo.wo[2] > 0)) return out;

  // Where wi sees less of a sloping segment than wo does, the nodes gather in what both see.
  const ThreadView<Real>* seen = &view_of_wo;
  ThreadView<Real> gathered;
  const Real along[2] = {x, y};
  bool clipped = false;
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

  V surface_warp = zero, surface_weft = zero, volume_warp = zero, volume_weft = zero, reweight = zero;
  for (int block = 0; block * 8 < t.count; ++block) {
    if (!view.alive[block]) continue;
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
      const V masking = fma(u, min(m_i, m_r) - mm, mm);
      const V p_i = normal * select_less(half, is_warp, scale_of[0], scale_of[1]);
      const V p_r = load(&view.projected_r[k]);
      const V pp = p_i * p_r;
      const V projected = fma(select_less(half, is_warp, blend_of[0], blend_of[1]), min(p_i, p_r) - pp, pp);

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
      const V common = masking * projected * cos_i * V(Real(4)) * (inverse_sum * cos_sum);
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
