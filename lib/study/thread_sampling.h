#pragma once
#include <array>
#include <string>

#include "look/look.h"

namespace sateen {

/// The reading of the talk (fabric/talk_sampler.h) in which it speaks: one straight thread of the cloth model alone,
/// without the neighbours that mask it, the mean over a cloth's tangents or a horizon. Directions are (theta, phi):
/// the inclination to the thread's normal plane, -pi/2 to pi/2, and the azimuth about the thread. All in double.

struct Thread {
  double eta = 1.5, k_d = 0.5;
  double gamma_s = 0.1, gamma_v = 0.2;  ///< [radians]
  double albedo = 0.3;                  ///< mean of A over the channels
};
Thread thread_of(const ThreadFamily& family);

/// Light that a thread sends on for one direction it comes from, times the cosine to the thread: f cos theta_i
/// [1/sr].
struct ThreadLight {
  double surface = 0, volume = 0;
  double total() const { return surface + volume; }
};
ThreadLight thread_light(const Thread& thread, double theta_r, double theta_i, double phi_d);

/// What the talk leaves open: how the azimuth of the volume lobe is drawn, and how one of the two lobes is chosen.
enum class VolumeAzimuth { flat, cosine };
enum class LobeChoice { half, weight };  ///< by weight: as the lobes share the light of this view

/// The talk's densities for one view of a thread.
struct ThreadSampler {
  Thread thread;
  double theta_r = 0;
  VolumeAzimuth azimuth = VolumeAzimuth::flat;
  double surface_share = 0.5;                  ///< probability of the surface lobe
  double low[2] = {0, 0}, spread[2] = {1, 1};  ///< of the Cauchy densities of surface and volume lobe
};
ThreadSampler thread_sampler(const Thread& thread, double theta_r, VolumeAzimuth azimuth, LobeChoice choice);

/// Density over solid angle [1/sr] on the whole sphere; phi_d is the azimuth from that of the view.
double thread_pdf(const ThreadSampler& sampler, double theta_i, double phi_d);

struct ThreadDirection {
  double theta = 0, phi_d = 0;
};
/// `u`: lobe, inclination, azimuth, each in [0, 1).
ThreadDirection sample_thread(const ThreadSampler& sampler, const std::array<double, 3>& u);

/// What one sample is off by under light from everywhere, by quadrature: no noise.
struct ThreadVariance {
  double light = 0;              ///< the integral of f cos theta_i over the sphere
  double uniform = 0, talk = 0;  ///< variance of one sample, uniform over the sphere and by the talk
  double ratio() const { return talk / uniform; }
};
ThreadVariance thread_variance(const ThreadSampler& sampler);

}  // namespace sateen
