#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "base/error.h"
#include "fabric/threads.h"

namespace sateen {

namespace {

// At 8.5 ivory duchess satin, seen and lit from opposite ends of its warp, was off by 1.1e-3 of the peak in one pair
// of 400,000, now by 1e-4; it costs 2 to 4 % of a picture.
constexpr double grazing_panel_deg = 4.5;

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
void add_tangents(Threads<Real>& out, const ThreadFamily& family, bool warp, const Tangent* begin, const Tangent* end,
                  bool in_panels) {
  constexpr double to_radians = std::numbers::pi / 180;
  const double gamma_s = family.gamma_s_deg * to_radians, gamma_v = family.gamma_v_deg * to_radians;
  const double root = std::sqrt(2 * std::numbers::pi), eta = family.eta, k_d = family.k_d;
  for (const Tangent* tangent = begin; tangent != end; ++tangent) {
    const Tangent& t = *tangent;
    const bool flat = t.start == t.end;
    out.start.push_back(flat ? 0 : Real(t.start));
    out.span.push_back(Real(t.end - t.start));
    out.own.add(flat ? t.start : 0.0);
    out.loose_slopes = out.loose_slopes || !(flat || in_panels);
    out.node.push_back(Real(t.node));
    out.flat.push_back(flat ? 1 : 0);
    out.inverse_span.push_back(flat ? 0 : Real(1 / (t.end - t.start)));
    out.weight.push_back(Real(double(family.coverage) * t.weight));
    out.along_x.push_back(warp ? 1 : 0);
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
  double steepest[2] = {0, 0};
  for (const bool in_panels : {true, false})
    for (int family = 0; family < 2; ++family) {
      if (!(families[family]->coverage > 0)) continue;
      const Tangent* all = curves[family]->data();
      const size_t nodes = count_panel_nodes(*curves[family]);
      if (!in_panels) {
        add_tangents(out, *families[family], family == 0, all + nodes, all + curves[family]->size(), false);
        continue;
      }
      add_tangents(out, *families[family], family == 0, all, all + nodes, true);
      out.panels[family] = int(nodes / panel_nodes);
      for (size_t n = 0; n < nodes; n += panel_nodes) {
        out.panel_from.push_back(Real(all[n].panel_from));
        out.panel_to.push_back(Real(all[n].panel_to));
        out.panel_span.push_back(Real(all[n].end - all[n].start));
        out.panel_warp.push_back(family == 0 ? 1 : 0);
        for (int end = 0; end < 2; ++end) {
          const double offset = end == 0 ? all[n].start : all[n].end;
          out.panel_offset[end].push_back(Real(offset));
          out.ends[end].add(offset);
          steepest[family] = std::max(steepest[family], std::abs(offset));
        }
      }
    }
  // A little less than the tangent, so that no rounding calls a segment seen that is not.
  for (int family = 0; family < 2; ++family)
    out.clip_free[family] = Real(0.9999 * std::tan(std::max(std::numbers::pi / 2 - steepest[family], 0.0)));
  const SignChange rows = sign_change();
  for (int j = 0; j <= panel_nodes; ++j)
    for (int k = 0; k < panel_nodes; ++k) out.sign_change[j][k] = Real(rows[j][k]);
}

constexpr int padding = 16;  // two blocks of 8, as the widest kernel takes them

template <class Real>
void pad_values(std::initializer_list<std::vector<Real>*> arrays) {
  for (std::vector<Real>* values : arrays)
    while (values->size() % padding) values->push_back(values->back());
}

template <class Real>
void pad(Threads<Real>& t) {
  while (t.weight.size() % padding) t.weight.push_back(0);
  t.count = int(t.weight.size());
  pad_values<Real>({&t.start, &t.span, &t.node, &t.flat, &t.inverse_span, &t.along_x, &t.eta2, &t.eta2_minus_1,
                    &t.surface_exponent, &t.surface_norm, &t.volume_exponent, &t.volume_norm, &t.isotropic});
  pad_values<Real>({&t.panel_from, &t.panel_to, &t.panel_warp, &t.panel_offset[0], &t.panel_offset[1]});
  for (Turns<Real>* turns : {&t.own, &t.ends[0], &t.ends[1]})
    pad_values<Real>({&turns->cosine, &turns->cosine_rest, &turns->sine, &turns->sine_rest});
  t.panel_span.resize(t.panel_warp.size(), 0);
}

template <class Real>
Threads<Real> compile_curves(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft) {
  Threads<Real> threads;
  add_families(threads, look, warp, weft);
  if (threads.start.empty()) throw InputError("the look has no threads: both coverages are 0");
  if (threads.start.size() + padding > most_tangents)
    throw InputError(
        fmt::format("the tangent curves need {} tangents, at most {} are possible", threads.start.size(),
                    most_tangents - padding),
        "lower --quadrature where it is above 1, widen gamma_s_deg or gamma_v_deg, or give the curve fewer sloping "
        "pieces");
  for (int k = int(threads.start.size()) - 1; k >= 0; --k) threads.first[threads.along_x[size_t(k)] > 0 ? 0 : 1] = k;
  pad(threads);
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
  // Curves of very many tangents take what still fits.
  for (double panel = grazing_panel_deg * std::numbers::pi / 180; threads.grazing.empty(); panel *= 2) {
    const std::vector<Tangent> fine_warp = cut_panels(warp, panel), fine_weft = cut_panels(weft, panel);
    const size_t count = fine_warp.size() + fine_weft.size();
    if (count <= warp.size() + weft.size()) break;
    if (count + padding <= most_tangents) threads.grazing.push_back(compile_curves<Real>(look, fine_warp, fine_weft));
  }
  return threads;
}

template Threads<float> compile_threads(const Look&, const std::vector<Tangent>&, const std::vector<Tangent>&);
template Threads<double> compile_threads(const Look&, const std::vector<Tangent>&, const std::vector<Tangent>&);

}  // namespace sateen
