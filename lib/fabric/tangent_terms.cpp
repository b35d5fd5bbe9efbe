#include "fabric/tangent_terms.h"

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {

/// A direction as a thread sees it.
struct OnThread {
  double sine, cosine;      // inclination from the thread's normal plane
  double normal, binormal;  // unit azimuth; normal = cos phi >= 0
  double projected;         // cos psi >= 0
};

OnThread on_thread(const Vec3& w, bool warp, double c, double s) {
  const double d = warp ? double(w.x) : double(w.y), b = warp ? double(w.y) : double(w.x), z = double(w.z);
  OnThread t;
  t.sine = d * c + z * s;
  const double normal = std::max(z * c - d * s, 0.0);
  t.cosine = std::max(std::hypot(normal, b), 1e-12);
  t.normal = normal / t.cosine;
  t.binormal = b / t.cosine;
  t.projected = normal / std::max(std::hypot(d, z), 1e-15);
  return t;
}

/// u(x) m + (1 - u(x)) of the product, from the half angle's squared sine and cosine.
double blended(double a, double b, double sin2_half, double cos2_half, double exponent) {
  const double half = std::atan2(std::sqrt(sin2_half), std::sqrt(cos2_half));
  const double u = std::exp(-exponent * half * half);
  return a * b + u * (std::min(a, b) - a * b);
}

}  // namespace

TangentTerms tangent_terms(const Threads<float>& t, int index, double offset, const Vec3& wo, const Vec3& wi) {
  TangentTerms out;
  if (!(wi.z > 0) || !(wo.z > 0)) return out;
  const auto k = size_t(index);
  const bool warp = t.along_x[k] > 0.5f;
  const double c = std::cos(offset), s = std::sin(offset);
  const OnThread i = on_thread(wi, warp, c, s), r = on_thread(wo, warp, c, s);
  const auto square = [](double x) { return x * x; };

  const double cos2_phi = (square(i.normal + r.normal) + square(i.binormal + r.binormal)) / 4;
  const double sin2_phi = (square(i.normal - r.normal) + square(i.binormal - r.binormal)) / 4;
  const double masking = blended(i.normal, r.normal, sin2_phi, cos2_phi, double(t.masking_exponent));

  // psi_d belongs to the family: both psi turn together with the offset.
  const double d_i = warp ? double(wi.x) : double(wi.y), d_r = warp ? double(wo.x) : double(wo.y);
  const double n_i = std::max(std::hypot(d_i, double(wi.z)), 1e-15);
  const double n_r = std::max(std::hypot(d_r, double(wo.z)), 1e-15);
  const double cos2_psi = (square(d_i / n_i + d_r / n_r) + square(double(wi.z) / n_i + double(wo.z) / n_r)) / 4;
  const double sin2_psi = (square(d_i / n_i - d_r / n_r) + square(double(wi.z) / n_i - double(wo.z) / n_r)) / 4;
  const double projected = blended(i.projected, r.projected, sin2_psi, cos2_psi, double(t.masking_exponent));
  const double visible = masking * projected;
  if (!(visible > 0)) return out;

  // Half angles as thread_kernel.h has them: without a cancellation where both directions graze the thread.
  const double cos_sum = i.cosine + r.cosine, sin_sum = i.sine + r.sine;
  const double four_cos2_d = square(cos_sum) + square(sin_sum);
  const double theta_h2 = square(std::atan2(sin_sum, cos_sum));
  const double h = std::sqrt(cos2_phi), cosine = std::sqrt(four_cos2_d) / 2 * h;
  const double eta2 = double(t.eta2[k]), g = std::sqrt(square(cosine) + double(t.eta2_minus_1[k]));
  const double sum_s = std::max(cosine + g, 1e-30), sum_p = std::max(eta2 * cosine + g, 1e-30);
  const double r_s = double(t.eta2_minus_1[k]) / square(sum_s), r_p = (eta2 * cosine - g) / sum_p;
  const double reflected = (square(r_s) + square(r_p)) / 2;
  const double transmitted = 2 * cosine * g * (eta2 / square(sum_p) + 1 / square(sum_s));

  const double g_s = double(t.surface_norm[k]) * std::exp(-theta_h2 * double(t.surface_exponent[k]));
  const double g_v =
      double(t.volume_norm[k]) * std::exp(-theta_h2 * double(t.volume_exponent[k])) + double(t.isotropic[k]);
  const double common = visible * i.cosine * 4 / four_cos2_d;
  out.surface = common * reflected * h * g_s;
  out.volume = common * square(transmitted) * g_v / cos_sum;
  out.half_azimuth = (i.binormal + r.binormal) / std::max(2 * h, 1e-12);
  return out;
}

}  // namespace sateen
