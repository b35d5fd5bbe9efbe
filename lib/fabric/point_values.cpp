#include "fabric/point_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sateen {

namespace {

/// The numbers of a family as the kernel wants them.
struct Terms {
  float eta2, eta2_minus_1, surface_exponent, surface_norm, volume_exponent, volume_norm, isotropic, weight;
};

Terms terms_of(const FamilyValues& v, float compiled_coverage) {
  const double root = std::sqrt(2 * std::numbers::pi);
  const double eta = v.eta, gamma_s = v.gamma_s, gamma_v = v.gamma_v, k_d = v.k_d;
  Terms terms;
  terms.eta2 = float(eta * eta);
  terms.eta2_minus_1 = float(eta * eta - 1);
  terms.surface_exponent = float(1 / (2 * gamma_s * gamma_s));
  terms.surface_norm = float(1 / (gamma_s * root));
  terms.volume_exponent = float(1 / (2 * gamma_v * gamma_v));
  terms.volume_norm = float((1 - k_d) / (gamma_v * root));
  terms.isotropic = v.k_d;
  terms.weight = compiled_coverage > 0 ? v.coverage / compiled_coverage : 0;
  return terms;
}

void rewrite(const Threads<float>& from, const Terms& warp, const Terms& weft, float gap, Threads<float>& to) {
  to.gap = gap;
  for (int k = 0; k < from.count; ++k) {
    const auto i = size_t(k);
    const Terms& terms = from.along_x[i] > 0.5f ? warp : weft;
    to.weight[i] = from.weight[i] * terms.weight;
    to.eta2[i] = terms.eta2;
    to.eta2_minus_1[i] = terms.eta2_minus_1;
    to.surface_exponent[i] = terms.surface_exponent;
    to.surface_norm[i] = terms.surface_norm;
    to.volume_exponent[i] = terms.volume_exponent;
    to.volume_norm[i] = terms.volume_norm;
    to.isotropic[i] = terms.isotropic;
  }
}

}  // namespace

FamilyValues family_values(const ThreadFamily& family) {
  return {family.coverage, family.k_d, family.eta, radians(family.gamma_s_deg), radians(family.gamma_v_deg)};
}

float gap_of(const std::array<FamilyValues, 2>& family) {
  const auto gap = float(std::max(0.0, 1.0 - double(family[0].coverage) - double(family[1].coverage)));
  return gap < 1e-6f ? 0 : gap;  // .9 + .1 is 1
}

void rewrite_threads(const VaryingThreads& from, const PointValues& point, Threads<float>& to) {
  const Terms warp = terms_of(point.family[0], from.values[0].coverage);
  const Terms weft = terms_of(point.family[1], from.values[1].coverage);
  rewrite(from.threads, warp, weft, point.gap, to);
  for (size_t i = 0; i < from.threads.grazing.size(); ++i)
    rewrite(from.threads.grazing[i], warp, weft, point.gap, to.grazing[i]);
}

}  // namespace sateen
