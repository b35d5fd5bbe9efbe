#pragma once
#include <array>

#include "fabric/threads.h"
#include "math/vector.h"

namespace sateen {

/// What of one family may differ from point to point of the cloth. Radians.
struct FamilyValues {
  float coverage, k_d, eta, gamma_s, gamma_v;
};

/// What textures say of one point of the cloth; families are warp and weft.
struct PointValues {
  std::array<Color, 2> A;              ///< working space
  std::array<FamilyValues, 2> family;  ///< meant only where the fabric's numbers vary
  float gap;                           ///< max(0, 1 - coverage of both)
};

/// Threads whose numbers vary, as they were compiled, and with what.
struct VaryingThreads {
  Threads<float> threads;
  std::array<FamilyValues, 2> values;  ///< a coverage of 0: no such threads, whatever a point says
};

FamilyValues family_values(const ThreadFamily& family);

/// The share of the area that no thread covers; rounding does not count as a gap.
float gap_of(const std::array<FamilyValues, 2>& family);

/// Makes `to`, a copy of `from.threads`, those of a point: what compile_threads would give for a look with these
/// values, to a few units in the last place, on the tangents that are there. They were placed for the lobes that
/// `from` was compiled with: no point may have narrower ones.
void rewrite_threads(const VaryingThreads& from, const PointValues& point, Threads<float>& to);

}  // namespace sateen
