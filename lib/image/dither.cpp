#include "image/dither.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace sateen {

namespace {
constexpr int side = 32, count = side * side;

// Energy that a point adds to its surroundings; sigma 1.5 pixels is Ulichney's choice. Distances wrap.
struct Points {
  std::array<double, count> kernel{}, energy{};
  std::array<bool, count> set{};

  Points() {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int dx = std::min(x, side - x), dy = std::min(y, side - y);
        kernel[size_t(y * side + x)] = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
      }
  }

  void put(int place, bool on) {
    set[size_t(place)] = on;
    const int px = place % side, py = place / side;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const int dx = (x - px) & (side - 1), dy = (y - py) & (side - 1);
        energy[size_t(y * side + x)] += (on ? 1 : -1) * kernel[size_t(dy * side + dx)];
      }
  }

  // The set point with the most energy, or the free one with the least; the first of equals.
  int tightest(bool among_set) const {
    int best = -1;
    for (int i = 0; i < count; ++i) {
      if (set[size_t(i)] != among_set) continue;
      const double e = energy[size_t(i)];
      if (best < 0 || (among_set ? e > energy[size_t(best)] : e < energy[size_t(best)])) best = i;
    }
    return best;
  }
};

std::array<std::uint16_t, count> blue_noise_ranks() {
  Points points;
  std::uint32_t state = 1;
  constexpr int initial = count / 10;
  for (int placed = 0; placed < initial;) {
    state = state * 1664525u + 1013904223u;
    const int place = int(state >> 22);
    if (points.set[size_t(place)]) continue;
    points.put(place, true);
    ++placed;
  }
  for (int moves = 0; moves < count; ++moves) {
    const int cluster = points.tightest(true);
    points.put(cluster, false);
    const int gap = points.tightest(false);
    points.put(gap, true);
    if (gap == cluster) break;
  }
  std::array<std::uint16_t, count> ranks{};
  Points falling = points;
  for (int rank = initial - 1; rank >= 0; --rank) {
    const int cluster = falling.tightest(true);
    ranks[size_t(cluster)] = std::uint16_t(rank);
    falling.put(cluster, false);
  }
  for (int rank = initial; rank < count; ++rank) {
    const int gap = points.tightest(false);
    ranks[size_t(gap)] = std::uint16_t(rank);
    points.put(gap, true);
  }
  return ranks;
}
}  // namespace

float dither_threshold(int x, int y, int channel) {
  static const std::array<std::uint16_t, count> ranks = blue_noise_ranks();
  const int column = (x + 11 * channel) & (side - 1), row = (y + 7 * channel) & (side - 1);
  return (float(ranks[size_t(row * side + column)]) + 0.5f) / float(count);
}

}  // namespace sateen
