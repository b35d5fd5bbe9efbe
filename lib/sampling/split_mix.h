#pragma once
#include <cstdint>

namespace sateen {

/// SplitMix64 (Steele, Lea and Flood 2014): small, and the same on every machine. For measurements and tests, where a
/// stream of plain random numbers is wanted; pictures take Sequence.
struct SplitMix {
  std::uint64_t state;
  std::uint64_t bits() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// [0, 1), 53 bits.
  double uniform() { return double(bits() >> 11) * 0x1p-53; }
};

}  // namespace sateen
