#include "sampling/sampler.h"

namespace sateen {

namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

// Finaliser of a 32-bit multiply-xorshift hash; constants from Wellons' search for low bias ("hash prospector").
std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x21f0aaadu;
  x = (x ^ (x >> 15)) * 0x735a2d97u;
  return x ^ (x >> 15);
}
std::uint32_t combine(std::uint32_t seed, std::uint32_t value) { return hash(seed ^ hash(value + 0x9e3779b9u)); }

// Laine-Karras permutation: every bit is flipped by a hash of the bits below it. Constants of Burley 2020, listing 1.
std::uint32_t permute_upwards(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

// Sobol's second dimension multiplies the index by Pascal's triangle mod 2. By Lucas' theorem binomial(j, i) is odd
// just when the bits of i are among those of j, so the product is a sum over supersets: five steps instead of 32.
std::uint32_t pascal(std::uint32_t x) {
  x ^= (x >> 1) & 0x55555555u;
  x ^= (x >> 2) & 0x33333333u;
  x ^= (x >> 4) & 0x0f0f0f0fu;
  x ^= (x >> 8) & 0x00ff00ffu;
  x ^= (x >> 16) & 0x0000ffffu;
  return x;
}

// `digits`: a Sobol coordinate with its most significant digit in bit 0. The permutation works upwards from there.
double scrambled(std::uint32_t digits, std::uint32_t seed) {
  return double(reverse_bits(permute_upwards(digits, seed))) * 0x1p-32;
}

// One full hash a dimension; the shuffle and the two scramblings get seeds that are odd multiples of it, which the
// permutation, itself a hash, tells apart.
struct Seeds {
  std::uint32_t shuffle, first, second;
};
Seeds seeds(Sequence sequence, Dimension dimension) {
  const std::uint32_t seed = combine(sequence.seed, std::uint32_t(dimension));
  return {seed, seed * 0x9e3779b1u + 0x7f4a7c15u, seed * 0x85ebca77u + 0x165667b1u};
}

}  // namespace

Sequence pixel_sequence(std::uint32_t seed, int x, int y, int replicate, int bounce) {
  std::uint32_t s = combine(0x53617465u, seed);
  s = combine(s, std::uint32_t(x));
  s = combine(s, std::uint32_t(y));
  s = combine(s, std::uint32_t(replicate));
  return {combine(s, std::uint32_t(bounce))};
}

double draw(Sequence sequence, Dimension dimension, std::uint32_t index) {
  const Seeds s = seeds(sequence, dimension);
  const std::uint32_t shuffled = reverse_bits(permute_upwards(reverse_bits(index), s.shuffle));
  return scrambled(shuffled, s.first);
}

std::array<double, 2> draw2(Sequence sequence, Dimension dimension, std::uint32_t index) {
  const Seeds s = seeds(sequence, dimension);
  const std::uint32_t shuffled = reverse_bits(permute_upwards(reverse_bits(index), s.shuffle));
  return {scrambled(shuffled, s.first), scrambled(pascal(shuffled), s.second)};
}

}  // namespace sateen
