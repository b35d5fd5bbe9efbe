#pragma once
#include <array>
#include <optional>
#include <vector>

#include "fabric/tangent_curve.h"
#include "look/look.h"
#include "math/vector.h"

namespace sateen {

/// The sampler of Wang, Xie, Krishnamachari, "Importance Sampling for a Microcylinder Based Cloth BSDF", SIGGRAPH 2014
/// Talks, as cloth-model.md section 6 gives it: Cauchy inclination, azimuth 2 asin(2 xi - 1), isotropic share with
/// probability k_d. What the talk leaves open is decided plainly: families and tangents by coverage and curve
/// length, the surface and the volume lobe with one half each. Nothing is weighted by masking, Fresnel or horizon.

/// Tangents of both families, as arrays for Lanes; the padding has no weight.
struct TalkTangents {
  std::vector<float> cos_offset, sin_offset, along_x, weight, gamma_s, gamma_v, k_d;
  std::vector<float> cumulative;  ///< of weight; the last is 1
  int count = 0;
};

struct TalkView {
  std::vector<float> theta_r, sin_r, cos_r, normal_r, binormal_r;
  std::vector<float> b_s, spread_s, b_v, spread_v;  ///< B and A - B of the talk for gamma_s and gamma_v
  Vec3 wo;
};

TalkTangents compile_talk(const Look& look, const std::vector<Tangent>& warp, const std::vector<Tangent>& weft);
void prepare_talk(const TalkTangents& tangents, const Vec3& wo, TalkView& view);

/// Solid-angle density [1/sr] over the whole sphere; it does not know the cloth's horizon.
float talk_pdf(const TalkTangents& tangents, const TalkView& view, const Vec3& wi);
Vec3 sample_talk(const TalkTangents& tangents, const TalkView& view, const std::array<double, 2>& thread,
                 const std::array<double, 2>& direction);

}  // namespace sateen
