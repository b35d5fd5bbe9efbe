#pragma once

namespace sateen::test {

/// One array of 8 floats for every operation and elementary function of Lanes, in a fixed order, for the inputs a, b,
/// c.
inline constexpr int lane_operations = 24;
using LaneResults = float[lane_operations][8];

/// With the branch of math/lanes.h that needs no AVX2, and with the one of this build.
void portable_results(const float* a, const float* b, const float* c, LaneResults& out);
void native_results(const float* a, const float* b, const float* c, LaneResults& out);

}  // namespace sateen::test
