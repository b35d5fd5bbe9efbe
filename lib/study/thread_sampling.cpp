#include "study/thread_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fabric/tangent_curve.h"

namespace sateen {

namespace {
constexpr double pi_d = std::numbers::pi, half_pi = pi_d / 2;

double gaussian(double width, double x) {
  return std::exp(-x * x / (2 * width * width)) / (width * std::sqrt(2 * pi_d));
}

double cauchy(const ThreadSampler& s, int lobe, double gamma, double theta_h) {
  return gamma / (2 * s.spread[lobe] * (theta_h * theta_h + gamma * gamma));
}

/// Calls f(theta_i, phi_d, solid angle) at the nodes of a rule over the sphere. Panels of inclination are as short as
/// the narrower lobe is wide; azimuth is even, and smooth between 0 and pi.
template <class F>
void over_sphere(const Thread& t, const F& f) {
  static const std::vector<QuadratureNode> nodes = gauss_legendre(8);
  const double narrow = 2 * std::min({t.gamma_s, t.gamma_v, 0.2});
  const int rows = int(std::ceil(pi_d / narrow)), columns = 4;
  for (int row = 0; row < rows; ++row)
    for (const QuadratureNode& a : nodes) {
      const double theta = -half_pi + pi_d * (row + a.position) / rows;
      for (int column = 0; column < columns; ++column)
        for (const QuadratureNode& b : nodes)
          f(theta, pi_d * (column + b.position) / columns,
            2 * std::cos(theta) * a.weight * pi_d / rows * b.weight * pi_d / columns);
    }
}
}  // namespace

Thread thread_of(const ThreadFamily& family) {
  constexpr double radians_a_degree = pi_d / 180;
  Thread t;
  t.eta = double(family.eta);
  t.k_d = double(family.k_d);
  t.gamma_s = double(family.gamma_s_deg) * radians_a_degree;
  t.gamma_v = double(family.gamma_v_deg) * radians_a_degree;
  t.albedo = (double(family.A.value[0]) + double(family.A.value[1]) + double(family.A.value[2])) / 3;
  return t;
}

ThreadLight thread_light(const Thread& t, double theta_r, double theta_i, double phi_d) {
  const double theta_h = (theta_i + theta_r) / 2, theta_d = (theta_i - theta_r) / 2;
  const double half_azimuth = std::max(std::cos(phi_d / 2), 0.0), cosine = std::cos(theta_d) * half_azimuth;
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (t.eta * t.eta));
  const double across = (cosine - t.eta * inside) / (cosine + t.eta * inside);
  const double along = (t.eta * cosine - inside) / (t.eta * cosine + inside);
  const double reflected = (across * across + along * along) / 2;
  const double scale = std::cos(theta_i) / (std::cos(theta_d) * std::cos(theta_d));
  const double cosines = std::max(std::cos(theta_i) + std::cos(theta_r), 1e-300);
  return {reflected * half_azimuth * gaussian(t.gamma_s, theta_h) * scale,
          t.albedo * (1 - reflected) * (1 - reflected) * ((1 - t.k_d) * gaussian(t.gamma_v, theta_h) + t.k_d) /
              cosines * scale};
}

ThreadSampler thread_sampler(const Thread& thread, double theta_r, VolumeAzimuth azimuth, LobeChoice choice) {
  ThreadSampler s;
  s.thread = thread;
  s.theta_r = theta_r;
  s.azimuth = azimuth;
  for (int lobe = 0; lobe < 2; ++lobe) {
    const double gamma = lobe == 0 ? thread.gamma_s : thread.gamma_v;
    s.low[lobe] = std::atan((theta_r - half_pi) / (2 * gamma));
    s.spread[lobe] = std::atan((theta_r + half_pi) / (2 * gamma)) - s.low[lobe];
  }
  if (choice == LobeChoice::half) return s;
  ThreadLight sum;
  over_sphere(thread, [&](double theta, double phi, double solid_angle) {
    const ThreadLight l = thread_light(thread, theta_r, theta, phi);
    sum.surface += l.surface * solid_angle;
    sum.volume += l.volume * solid_angle;
  });
  s.surface_share = sum.surface / sum.total();
  return s;
}

double thread_pdf(const ThreadSampler& s, double theta_i, double phi_d) {
  const Thread& t = s.thread;
  const double theta_h = (theta_i + s.theta_r) / 2, cosine = std::max(std::cos(theta_i), 1e-300);
  const double by_cosine = std::max(std::cos(phi_d / 2), 0.0) / 4;
  const double volume_azimuth = s.azimuth == VolumeAzimuth::flat ? 1 / (2 * pi_d) : by_cosine;
  const double surface = cauchy(s, 0, t.gamma_s, theta_h) / cosine * by_cosine;
  const double volume = ((1 - t.k_d) * cauchy(s, 1, t.gamma_v, theta_h) / cosine + t.k_d / 2) * volume_azimuth;
  return s.surface_share * surface + (1 - s.surface_share) * volume;
}

ThreadDirection sample_thread(const ThreadSampler& s, const std::array<double, 3>& u) {
  const Thread& t = s.thread;
  const auto by_cauchy = [&](int lobe, double gamma) {
    return 2 * gamma * std::tan(u[1] * s.spread[lobe] + s.low[lobe]) - s.theta_r;
  };
  ThreadDirection d;
  const bool surface = u[0] < s.surface_share;
  if (surface)
    d.theta = by_cauchy(0, t.gamma_s);
  else if ((u[0] - s.surface_share) / (1 - s.surface_share) < t.k_d)
    d.theta = std::asin(2 * u[1] - 1);
  else
    d.theta = by_cauchy(1, t.gamma_v);
  d.theta = std::clamp(d.theta, -half_pi, half_pi);
  d.phi_d = !surface && s.azimuth == VolumeAzimuth::flat ? pi_d * (2 * u[2] - 1) : 2 * std::asin(2 * u[2] - 1);
  return d;
}

ThreadVariance thread_variance(const ThreadSampler& s) {
  double light = 0, uniform = 0, talk = 0;
  over_sphere(s.thread, [&](double theta, double phi, double solid_angle) {
    const double f = thread_light(s.thread, s.theta_r, theta, phi).total();
    light += f * solid_angle;
    uniform += f * f * 4 * pi_d * solid_angle;
    talk += f * f / thread_pdf(s, theta, phi) * solid_angle;
  });
  return {light, uniform - light * light, talk - light * light};
}

}  // namespace sateen
