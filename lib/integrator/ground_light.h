#pragma once
#include <span>

#include "integrator/direct.h"

namespace sateen {

/// What reaches points of the ground from the environment, as the radiance that a white matte surface would show
/// (irradiance over pi, working space).
struct GroundLight {
  Color reached{0, 0, 0};    ///< with the shadows of cloth and ground
  Color held_back{0, 0, 0};  ///< by the cloth
};

/// One unbiased estimate for each of up to batch_size points: a direction of the (compensated) map and one of the
/// cosine, balance heuristic, whatever the cloth's strategy is. An estimate has the same bits in any batch.
void light_on_ground(const Scene& scene, std::span<const GroundPoint> points, const SequenceBatch& samples,
                     RayCounts& counts, GroundLight* light);

/// Share of the open sky's light that the cloth keeps from a point of a catcher: a sample's alpha. Where nothing is
/// in the way it is 0 without noise; a sample may be above 1, their mean is not.
float shadow_share(const Scene& scene, const GroundLight& light);

/// A direction of the world in which a path leaves the ground; its weight is the albedo alone.
Vec3 leave_ground(const GroundPoint& point, const std::array<double, 2>& u);

}  // namespace sateen
