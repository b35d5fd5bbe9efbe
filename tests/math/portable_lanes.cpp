#include "portable_lanes.h"

// math/lanes.h as a processor without AVX2 sees it, under another name so that both fit into one program.
#include <cmath>
#include <cstddef>
#undef __AVX2__
#define sateen portable_sateen
#include "math/lane_functions.h"
#undef sateen

#ifdef SATEEN_AVX2
#error "this file must see the portable branch"
#endif

namespace sateen::test {

void portable_results(const float* a, const float* b, const float* c, LaneResults& out) {
  using namespace portable_sateen;
#include "lane_operations.inc"
}

}  // namespace sateen::test
