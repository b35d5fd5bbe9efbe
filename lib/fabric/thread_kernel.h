#pragma once
#include "fabric/panel_light.h"

// The kernel of threads.h, written once over its vector type: PairLanes or WideLanes over float arrays, double alone
// for the oracle. Included by one source file an instruction set; the unnamed namespace keeps what one compiled out
// of the other.

namespace sateen {

namespace {

/// 1 in the second of two blocks: in the block pair where panels end, the flat pieces.
template <class Real>
constexpr Real second_block[2] = {0, 1};

/// w.t and w.n_t of a direction on the references of some tangents: those are tilted against them by the offsets in
/// ThreadView.
template <class V>
struct OnReference {
  V along, normal;
};

/// Of the tangents from k on, in the blocks from `block` on: panels have one reference each, flat pieces their own.
template <class V, class Real>
OnReference<V> on_reference(const Threads<Real>& t, const Real* along, const Real* normal, int block, int k, V x, V y,
                            V z) {
  using Vec = Vector<V>;
  const int panels = t.panels[0] + t.panels[1];
  if (block + blocks_at_once<V> <= panels) return {Vec::by_block(along + block), Vec::by_block(normal + block)};

  const V half = V(Real(0.5)), d = select_less(half, Vec::load(&t.along_x[k]), x, y);
  const V c = Vec::load(&t.own.cosine[k]), s = Vec::load(&t.own.sine[k]);
  const V across = across_thread(z, d, c, Vec::load(&t.own.cosine_rest[k]), s, Vec::load(&t.own.sine_rest[k]));
  const OnReference<V> own{fma(d, c, z * s), across};
  if (block >= panels) return own;
  const V second = Vec::by_block(second_block<Real>);
  return {select_less(half, second, own.along, Vec::by_block(along + block)),
          select_less(half, second, own.normal, Vec::by_block(normal + block))};
}

/// Offsets that face a direction, of both families.
template <class Real>
void facing(const Real (&along)[2], Real z, Real (&from)[2], Real (&to)[2]) {
  for (int family = 0; family < 2; ++family) {
    const Real elevation = std::atan2(z, std::abs(along[family]));
    from[family] = along[family] < 0 ? -elevation : Real(-quarter_turn);
    to[family] = along[family] > 0 ? elevation : Real(quarter_turn);
  }
}

/// Fills the view terms of the blocks from `block` on that V takes at once, with their nodes gathered in
/// view.windows, those of loose slopes in view.from ... view.to.
template <class V, class Real>
void fill_blocks(const Threads<Real>& t, int block, ThreadView<Real>& view) {
  using Vec = Vector<V>;
  constexpr int at_once = blocks_at_once<V>;
  const int panels = t.panels[0] + t.panels[1];
  const V wx = V(view.wo[0]), wy = V(view.wo[1]), wz = V(view.wo[2]);
  const V zero = V(Real(0)), half = V(Real(0.5)), one = V(Real(1)), two = V(Real(2));
  const PanelWindows<Real>& windows = view.windows;
  bool alive = false;
  for (int k = block * 8; k < (block + at_once) * 8; k += Vec::width) {
    const V is_warp = Vec::load(&t.along_x[k]), node = Vec::load(&t.node[k]);
    const V b = select_less(half, is_warp, wy, wx);
    const V scale = select_less(half, is_warp, V(view.scale[0]), V(view.scale[1]));
    V offset = zero, share = zero;
    if (block < panels) {
      const V width = Vec::by_block(windows.seen + block);
      offset = fma(width, node, Vec::by_block(windows.from + block));
      share = width * Vec::load(&t.inverse_span[k]);
    }
    if (block + at_once > panels) {
      // Flat pieces have neither start nor span.
      const V flat = block < panels ? Vec::by_block(second_block<Real>) : one;
      const V a0 = Vec::load(&t.start[k]), a1 = a0 + Vec::load(&t.span[k]);
      V from = a0, seen = a1 - a0;
      if (t.loose_slopes) {
        from = max(a0, select_less(half, is_warp, V(view.from[0]), V(view.from[1])));
        seen = max(min(a1, select_less(half, is_warp, V(view.to[0]), V(view.to[1]))) - from, zero);
        from = select_less(half, Vec::load(&t.flat[k]), zero, min(from, a1));
      }
      const V part = fma(seen, Vec::load(&t.inverse_span[k]), Vec::load(&t.flat[k]));
      offset = select_less(half, flat, fma(seen, node, from), offset);
      share = select_less(half, flat, part, share);
    }
    const V weight = Vec::load(&t.weight[k]) * share;
    // An offset from an end of its segment may be more than a quarter turn.
    const V sine = sin_quarter(half * offset), cosine = cos_quarter(half * offset);
    const V c = fnma(two * sine, sine, one), s = two * sine * cosine;

    const OnReference<V> w = on_reference(t, windows.along, windows.normal, block, k, wx, wy, wz);
    const V normal = max(fnma(w.along, s, w.normal * c), zero);
    const V cos_r = sqrt(max(fma(normal, normal, b * b), V(Real(smallest_cos2))));
    const V inverse = one / cos_r;
    Vec::store(&view.cos_offset[k], c);
    Vec::store(&view.sin_offset[k], s);
    Vec::store(&view.weight_warp[k], weight * is_warp);
    Vec::store(&view.weight_weft[k], weight * (one - is_warp));
    Vec::store(&view.sin_r[k], fma(w.along, c, w.normal * s));
    Vec::store(&view.cos_r[k], cos_r);
    Vec::store(&view.normal_r[k], normal * inverse);
    Vec::store(&view.binormal_r[k], b * inverse);
    Vec::store(&view.projected_r[k], normal * scale);
    alive = alive || sum(normal * weight) > 0;
  }
  for (int n = 0; n < at_once; ++n) view.alive[block + n] = alive;
}

/// sign(place - x) as the nodes of a panel have to show it: sign_change() at `place`.
template <class V, class Real>
V sign_at_nodes(const Threads<Real>& t, int lane, V place) {
  using Vec = Vector<V>;
  const V y = V(Real(2)) * place - V(Real(1));
  V s = Vec::every_block(&t.sign_change[panel_nodes][0], lane);
  for (int j = panel_nodes - 1; j >= 0; --j) s = fma(s, y, Vec::every_block(&t.sign_change[j][0], lane));
  return s;
}

/// Minimum of a and b at the nodes: (a + b - |a - b|) / 2. Where the panel holds the place at which a - b changes its
/// sign, Gauss-Legendre nodes miss |a - b|, but not (a - b) times the sign that sign_at_nodes gives; elsewhere the
/// plain minimum stands.
template <class V>
V least(V a, V b, V place, V sign) {
  using Real = typename Vector<V>::Real;
  return select_less(V(Real(0)), place, V(Real(0.5)) * (a + b - (a - b) * sign), min(a, b));
}

template <class V, class Real>
void prepare_view_in(const Threads<Real>& threads, Real x, Real y, Real z, ThreadView<Real>& view) {
  const Threads<Real>& t = z < Real(grazing_z) && !threads.grazing.empty() ? threads.grazing.front() : threads;
  view.threads = &t;
  view.wo[0] = x, view.wo[1] = y, view.wo[2] = z;
  for (int family = 0; family < 2; ++family) {
    const Real d = view.wo[family];
    view.scale[family] = 1 / std::sqrt(std::max(d * d + z * z, Real(smallest_projection2)));
    view.across_d[family] = d * view.scale[family];
    view.across_n[family] = z * view.scale[family];
  }
  if (t.loose_slopes) facing({x, y}, z, view.from, view.to);
  view_panels<PanelLanes<V>>(t, view);
  for (int block = 0; block * 8 < t.count; block += blocks_at_once<V>) fill_blocks<V>(t, block, view);
}

template <class V, class Real>
ThreadSums<Real> scatter_in(const Threads<Real>& threads, const ThreadView<Real>& view_of_wo, Real x, Real y,
                            Real z) {
  using Vec = Vector<V>;
  constexpr int at_once = blocks_at_once<V>;
  ThreadSums<Real> out;
  if (!(z > 0) || !(view_of_wo.wo[2] > 0)) return out;

  const Real* wo = view_of_wo.wo;
  const bool opposite = x * wo[0] + y * wo[1] < 0 && z + wo[2] < Real(opposite_grazing_z);
  const bool grazes = opposite || z < Real(grazing_z) || wo[2] < Real(grazing_z);
  const bool fine = grazes && !threads.grazing.empty();
  const Threads<Real>& t = fine ? threads.grazing.front() : threads;
  const int panels = t.panels[0] + t.panels[1];

  // Where wi sees less of a sloping segment than wo does, the nodes gather in what both see.
  ThreadView<Real> gathered;
  const bool other = view_of_wo.threads != &t;
  const bool clipped =
      other || t.loose_slopes || std::abs(x) > t.clip_free[0] * z || std::abs(y) > t.clip_free[1] * z;
  if (clipped) {
    std::copy(wo, wo + 3, gathered.wo);
    std::copy(view_of_wo.scale, view_of_wo.scale + 2, gathered.scale);
  }
  if (t.loose_slopes) {
    Real from[2], to[2];
    facing({x, y}, z, from, to);
    facing({wo[0], wo[1]}, wo[2], gathered.from, gathered.to);
    for (int family = 0; family < 2; ++family) {
      gathered.from[family] = std::max(gathered.from[family], from[family]);
      gathered.to[family] = std::min(gathered.to[family], to[family]);
    }
  }

  FamilyTerms<Real> terms;
  family_terms<PanelLanes<V>>(t, view_of_wo, x, y, z, terms);
  PanelLight<Real> light;
  light_panels<PanelLanes<V>>(t, view_of_wo, x, y, z, clipped, terms, light, gathered);
  const V wx = V(x), wy = V(y), wz = V(z), zero = V(Real(0)), half = V(Real(0.5)), quarter = V(Real(0.25));
  const V one = V(Real(1)), two = V(Real(2)), fall = V(-t.masking_exponent);
  // Odd blocks have sums of their own in Lanes, so that the bits are those of WideLanes.
  constexpr int sums = at_once == 2 ? 1 : 2;
  V surface_warp[sums], surface_weft[sums], volume_warp[sums], volume_weft[sums], reweight[sums];
  for (int n = 0; n < sums; ++n)
    surface_warp[n] = surface_weft[n] = volume_warp[n] = volume_weft[n] = reweight[n] = zero;
  // Of the panels in the blocks that are held.
  const auto any = [](const Real* values) { return (at_once == 2 ? std::max(values[0], values[1]) : values[0]) > 0; };
  for (int block = 0; block * 8 < t.count; block += at_once) {
    bool regather = other || (t.loose_slopes && block + at_once > panels);
    if (!regather && !view_of_wo.alive[block]) continue;
    const bool has_panels = block < panels;
    if (clipped) {
      if (has_panels) regather = regather || any(gathered.windows.changed + block);
      if (regather) fill_blocks<V>(t, block, gathered);
      if (regather && !gathered.alive[block]) continue;
    }
    const ThreadView<Real>& view = regather ? gathered : view_of_wo;
    const bool in_masking = has_panels && any(light.masking + block);
    const bool in_projected = has_panels && any(light.projected + block);
    const int n = sums == 1 ? 0 : block & 1;
    for (int k = block * 8; k < (block + at_once) * 8; k += Vec::width) {
      const V is_warp = Vec::load(&t.along_x[k]);
      const V b = select_less(half, is_warp, wy, wx);
      const V c = Vec::load(&view.cos_offset[k]), s = Vec::load(&view.sin_offset[k]);

      // Inclination and azimuth of wi on this tangent.
      const OnReference<V> w = on_reference(t, light.along, light.normal, block, k, wx, wy, wz);
      const V sin_i = fma(w.along, c, w.normal * s);
      const V normal = max(fnma(w.along, s, w.normal * c), zero);
      const V cos_i = sqrt(max(fma(normal, normal, b * b), V(Real(smallest_cos2))));
      const V inverse = one / cos_i;
      const V m_i = normal * inverse, b_i = b * inverse;
      const V m_r = Vec::load(&view.normal_r[k]), b_r = Vec::load(&view.binormal_r[k]);
      const V plus_n = m_i + m_r, plus_b = b_i + b_r, minus_n = m_i - m_r, minus_b = b_i - b_r;
      const V h2 = quarter * fma(plus_n, plus_n, plus_b * plus_b);     // cos^2(phi_d / 2)
      const V q = quarter * fma(minus_n, minus_n, minus_b * minus_b);  // sin^2(phi_d / 2)
      const V h = sqrt(h2);

      // M and P, each a blend by u between the independent and the fully correlated case.
      const V u = exp_negative(fall * half_angle_squared(q, h2, h));
      const V mm = m_i * m_r;
      V m_least = min(m_i, m_r);
      V masking_kink, projected_kink, sign_m, sign_p;
      if (in_masking) {
        masking_kink = Vec::by_block(light.masking + block);
        sign_m = Vec::by_block(light.side + block) * sign_at_nodes<V>(t, k % 8, masking_kink);
        m_least = least(m_i, m_r, masking_kink, sign_m);
      }
      const V masking = max(fma(u, m_least - mm, mm), zero);
      const V p_i = normal * select_less(half, is_warp, V(terms.scale[0]), V(terms.scale[1]));
      const V p_r = Vec::load(&view.projected_r[k]);
      const V pp = p_i * p_r;
      V p_least = min(p_i, p_r);
      if (in_projected) {
        projected_kink = Vec::by_block(light.projected + block);
        sign_p = Vec::by_block(light.side + block) * sign_at_nodes<V>(t, k % 8, projected_kink);
        p_least = least(p_i, p_r, projected_kink, sign_p);
      }
      const V u_p = select_less(half, is_warp, V(terms.blend[0]), V(terms.blend[1]));
      const V projected = max(fma(u_p, p_least - pp, pp), zero);
      V visible = masking * projected;
      if (in_masking && in_projected) {
        // The product of both signs is 1 but between the places: not the product of what the nodes show of each.
        const V between = Vec::by_block(light.between + block) * (sign_m - sign_p);
        const V product = one - between - sign_m * sign_p;
        const V corrected = max(fma(quarter * u * u_p * (m_i - m_r), (p_i - p_r) * product, visible), zero);
        visible = select_less(zero, min(masking_kink, projected_kink), corrected, visible);
      }

      // sin a + sin b over cos a + cos b is tan((a + b)/2), and the sum of their squares 4 cos^2((a - b)/2): both
      // half angles without a cancellation, even where wi and wo graze opposite ends of the thread.
      const V cos_sum = cos_i + Vec::load(&view.cos_r[k]), sin_sum = sin_i + Vec::load(&view.sin_r[k]);
      const V four_cos2_d = fma(cos_sum, cos_sum, sin_sum * sin_sum);
      const V theta_h2 = atan_squared(sin_sum, cos_sum);
      const V cos_d = half * sqrt(four_cos2_d);

      // Fresnel at cos(theta_d) cos(phi_d / 2). Transmittance from its own product: 1 - F_r would lose its digits.
      const V cosine = cos_d * h;
      const V eta2 = Vec::load(&t.eta2[k]), eta2_minus_1 = Vec::load(&t.eta2_minus_1[k]);
      const V g = sqrt(fma(cosine, cosine, eta2_minus_1));
      const V sum_s = cosine + g, sum_p = fma(eta2, cosine, g);
      const V inverse_both = one / max(sum_s * sum_p, V(Real(1e-30f)));
      const V inverse_s = sum_p * inverse_both, inverse_p = sum_s * inverse_both;
      const V r_s = eta2_minus_1 * inverse_s * inverse_s, r_p = (fma(eta2, cosine, zero - g)) * inverse_p;
      const V reflected = half * fma(r_s, r_s, r_p * r_p);
      const V transmitted = two * cosine * g * fma(eta2, inverse_p * inverse_p, inverse_s * inverse_s);

      const V g_s = Vec::load(&t.surface_norm[k]) * exp_negative(zero - theta_h2 * Vec::load(&t.surface_exponent[k]));
      const V g_v = fma(Vec::load(&t.volume_norm[k]),
                        exp_negative(zero - theta_h2 * Vec::load(&t.volume_exponent[k])), Vec::load(&t.isotropic[k]));

      // cos theta_i / cos^2 theta_d, then the thread's two terms; V keeps 1 / (cos theta_i + cos theta_r) beside
      // F_t^2.
      const V inverse_sum = one / (four_cos2_d * cos_sum);
      const V common = visible * cos_i * V(Real(4)) * (inverse_sum * cos_sum);
      const V surface = common * reflected * h * g_s;
      const V volume = common * (transmitted * transmitted) * g_v * (inverse_sum * four_cos2_d);
      const V w_warp = Vec::load(&view.weight_warp[k]), w_weft = Vec::load(&view.weight_weft[k]);
      surface_warp[n] = fma(surface, w_warp, surface_warp[n]);
      surface_weft[n] = fma(surface, w_weft, surface_weft[n]);
      volume_warp[n] = fma(volume, w_warp, volume_warp[n]);
      volume_weft[n] = fma(volume, w_weft, volume_weft[n]);
      reweight[n] = fma(projected, w_warp + w_weft, reweight[n]);
    }
  }
  const auto total = [](const V(&parts)[sums]) {
    if constexpr (sums == 1)
      return sum(parts[0]);
    else
      return sum(parts[0] + parts[1]);
  };
  const Real q = total(reweight);
  // Every P is 0: F is 0 (cloth-model.md section 3). So too for a denormal, whose inverse is infinite.
  if (!(q >= std::numeric_limits<Real>::min())) return out;
  out.reweight = q + t.gap * view_of_wo.wo[2];
  const Real inverse_q = 1 / out.reweight;
  out.surface = {total(surface_warp) * inverse_q, total(surface_weft) * inverse_q};
  out.volume = {total(volume_warp) * inverse_q, total(volume_weft) * inverse_q};
  return out;
}

}  // namespace

}  // namespace sateen
