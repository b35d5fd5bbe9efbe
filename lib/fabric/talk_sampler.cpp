#include "fabric/talk_sampler.h"

#include <algorithm>
#include <cmath>

#include "math/lane_functions.h"

namespace sateen {

namespace {
constexpr float smallest_cos2 = 1e-24f;
constexpr float half_pi = pi / 2;
}  // namespace

TalkTangents compile_talk(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft) {
  TalkTangents t;
  const double total = double(look.warp.coverage) + look.weft.coverage;
  double sum = 0;
  for (int family = 0; family < 2; ++family) {
    const ThreadFamily& f = family == 0 ? look.warp : look.weft;
    if (!(f.coverage > 0)) continue;
    for (const Tangent& tangent : family == 0 ? warp : weft) {
      const double weight = f.coverage / total * tangent.weight;
      sum += weight;
      t.cos_offset.push_back(float(std::cos(tangent.offset())));
      t.sin_offset.push_back(float(std::sin(tangent.offset())));
      t.along_x.push_back(family == 0 ? 1.0f : 0.0f);
      t.weight.push_back(float(weight));
      t.cumulative.push_back(float(sum));
      t.gamma_s.push_back(radians(f.gamma_s_deg));
      t.gamma_v.push_back(radians(f.gamma_v_deg));
      t.k_d.push_back(f.k_d);
    }
  }
  t.cumulative.back() = 1;
  while (t.weight.size() % 8) {
    for (std::vector<float>* v : {&t.cos_offset, &t.sin_offset, &t.along_x, &t.gamma_s, &t.gamma_v, &t.k_d, &t.cumulative})
      v->push_back(v->back());
    t.weight.push_back(0);
  }
  t.count = int(t.weight.size());
  return t;
}

void prepare_talk(const TalkTangents& t, const Vec3& wo, TalkView& view) {
  for (std::vector<float>* v : {&view.theta_r, &view.sin_r, &view.cos_r, &view.normal_r, &view.binormal_r, &view.b_s,
                                &view.spread_s, &view.b_v, &view.spread_v})
    v->resize(size_t(t.count));
  view.wo = wo;
  for (int k = 0; k < t.count; ++k) {
    const float d = t.along_x[k] > 0 ? wo.x : wo.y, b = t.along_x[k] > 0 ? wo.y : -wo.x;
    const float along = d * t.cos_offset[k] + wo.z * t.sin_offset[k];
    const float normal = wo.z * t.cos_offset[k] - d * t.sin_offset[k];
    const float across = std::sqrt(std::max(normal * normal + b * b, smallest_cos2));
    view.sin_r[k] = along;
    view.cos_r[k] = across;
    view.theta_r[k] = std::atan2(along, across);
    view.normal_r[k] = normal / across;
    view.binormal_r[k] = b / across;
    // theta_i covers [-pi/2, pi/2], so theta_h covers (theta_r -+ pi/2)/2; the talk's A and B are its ends.
    const auto ends = [&](float gamma, float& low, float& spread) {
      low = std::atan((view.theta_r[k] - half_pi) / (2 * gamma));
      spread = std::atan((view.theta_r[k] + half_pi) / (2 * gamma)) - low;
    };
    ends(t.gamma_s[k], view.b_s[k], view.spread_s[k]);
    ends(t.gamma_v[k], view.b_v[k], view.spread_v[k]);
  }
}

float talk_pdf(const TalkTangents& t, const TalkView& view, const Vec3& wi) {
  const Lanes wx = wi.x, wy = wi.y, wz = wi.z, half = 0.5f, one = 1.0f, quarter = 0.25f;
  Lanes density = 0.0f;
  for (int k = 0; k < t.count; k += Lanes::width) {
    const Lanes is_warp = Lanes::load(&t.along_x[k]);
    const Lanes d = select_less(half, is_warp, wx, wy), b = select_less(half, is_warp, wy, Lanes(0.0f) - wx);
    const Lanes c = Lanes::load(&t.cos_offset[k]), s = Lanes::load(&t.sin_offset[k]);
    const Lanes along = fma(d, c, wz * s), normal = fnma(d, s, wz * c);
    const Lanes across = sqrt(max(fma(normal, normal, b * b), Lanes(smallest_cos2)));
    const Lanes inverse = one / across;
    const Lanes plus_n = fma(normal, inverse, Lanes::load(&view.normal_r[k]));
    const Lanes plus_b = fma(b, inverse, Lanes::load(&view.binormal_r[k]));
    const Lanes azimuth = quarter * half * sqrt(fma(plus_n, plus_n, plus_b * plus_b));  // cos(phi_d / 2) / 4
    const Lanes theta_h2 = atan_squared(along + Lanes::load(&view.sin_r[k]), across + Lanes::load(&view.cos_r[k]));
    const Lanes gamma_s = Lanes::load(&t.gamma_s[k]), gamma_v = Lanes::load(&t.gamma_v[k]), k_d = Lanes::load(&t.k_d[k]);
    const Lanes cauchy_s = half * gamma_s / (Lanes::load(&view.spread_s[k]) * fma(gamma_s, gamma_s, theta_h2));
    const Lanes cauchy_v = half * gamma_v / (Lanes::load(&view.spread_v[k]) * fma(gamma_v, gamma_v, theta_h2));
    const Lanes lobe = half * (cauchy_s + (one - k_d) * cauchy_v + k_d * half * across);
    density = fma(Lanes::load(&t.weight[k]), lobe * azimuth * inverse, density);
  }
  return sum(density);
}

Vec3 sample_talk(const TalkTangents& t, const TalkView& view, const std::array<double, 2>& thread,
                 const std::array<double, 2>& direction) {
  const int k = int(std::min<long>(
      std::upper_bound(t.cumulative.begin(), t.cumulative.end(), float(thread[0])) - t.cumulative.begin(), t.count - 1));
  float theta;
  const double lobe = thread[1];
  if (lobe < 0.5) {
    theta = 2 * t.gamma_s[k] * std::tan(float(direction[0]) * view.spread_s[k] + view.b_s[k]) - view.theta_r[k];
  } else if (lobe * 2 - 1 < t.k_d[k]) {
    theta = std::asin(std::clamp(2 * float(direction[0]) - 1, -1.0f, 1.0f));
  } else {
    theta = 2 * t.gamma_v[k] * std::tan(float(direction[0]) * view.spread_v[k] + view.b_v[k]) - view.theta_r[k];
  }
  theta = std::clamp(theta, -half_pi, half_pi);
  // Never exactly opposite wo around the thread: the density is 0 there.
  constexpr float below_one = 0x1.fffffep-1f;
  const float phi = std::atan2(view.binormal_r[k], view.normal_r[k]) -
                    2 * std::asin(std::clamp(2 * float(direction[1]) - 1, -below_one, below_one));
  const float along = std::sin(theta), across = std::cos(theta);
  const float normal = across * std::cos(phi), b = across * std::sin(phi);
  const float d = along * t.cos_offset[k] - normal * t.sin_offset[k];
  const float z = along * t.sin_offset[k] + normal * t.cos_offset[k];
  return t.along_x[k] > 0 ? Vec3(d, b, z) : Vec3(-b, d, z);
}

}  // namespace sateen
