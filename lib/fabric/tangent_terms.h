#pragma once
#include "fabric/threads.h"
#include "math/vector.h"

namespace sateen {

/// f M P cos theta_i of one thread tangent (cloth-model.md sections 2 and 3), before colour, split into its lobes,
/// and where on the thread its light comes from. In double, one pair at a time: `scatter` does this for all tangents.
struct TangentTerms {
  double surface = 0, volume = 0;
  double half_azimuth = 0;  ///< sine of the azimuth of the half vector about the thread: (phi_i + phi_r) / 2
};

/// The tangent tilted by `offset` [radians] of a family whose constants stand at `index` of the compiled threads.
/// Unit directions in the cloth's frame; 0 where either is not above the cloth or does not meet the thread's face.
TangentTerms tangent_terms(const Threads<float>& threads, int index, double offset, const Vec3& wo, const Vec3& wi);

}  // namespace sateen
