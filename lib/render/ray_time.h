#pragma once
#include "integrator/direct.h"

namespace sateen {

/// Time of one core that rays and all that belongs to them take [s], on the machine where the costs were measured
/// (drapes and garments of 80,000 to 300,000 triangles): counts and no clock, so that what is decided by it is
/// decided everywhere alike.
double direct_time(const RayCounts& rays, const LightSettings& light);
/// The same of the part that follows bounces.
double bounce_time(const RayCounts& rays, const LightSettings& light);
/// What their shadow rays take besides where cloth has gaps: all surfaces on the way are met.
double gap_time(const RayCounts& rays);

}  // namespace sateen
