#include "sampling/sampler.h"

namespace sateen {

namespace {

// Every step is a plain 32-bit operation, so that loops over a batch become vector code.
inline std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x >> 8) & 0x00ff00ffu);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

// Finaliser of a 32-bit multiply-xorshift hash; constants from Wellons' search for low bias ("hash prospector").
inline std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x21f0aaadu;
  x = (x ^ (x >> 15)) * 0x735a2d97u;
  return x ^ (x >> 15);
}
inline std::uint32_t combine(std::uint32_t seed, std::uint32_t value) {
  return hash(seed ^ hash(value + 0x9e3779b9u));
}

// Laine-Karras permutation: every bit is flipped by a hash of the bits below it. Constants of Burley 2020, listing 1.
inline std::uint32_t permute_upwards(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cu;
  x ^= x * 0xb82f1e52u;
  x ^= x * 0xc7afe638u;
  x ^= x * 0x8d22f6e6u;
  return x;
}

// Sobol's second dimension multiplies the index by Pascal's triangle mod 2. By Lucas' theorem binomial(j, i) is odd
// just when the bits of i are among those of j, so the product is a sum over supersets: five steps instead of 32.
inline std::uint32_t pascal(std::uint32_t x) {
  x ^= (x >> 1) & 0x55555555u;
  x ^= (x >> 2) & 0x33333333u;
  x ^= (x >> 4) & 0x0f0f0f0fu;
  x ^= (x >> 8) & 0x00ff00ffu;
  x ^= (x >> 16) & 0x0000ffffu;
  return x;
}

// One full hash a dimension; the shuffle and the two scramblings get seeds that are odd multiples of it, which the
// permutation, itself a hash, tells apart.
struct Seeds {
  std::uint32_t shuffle, first, second;
};
inline Seeds seeds(Sequence sequence, Dimension dimension) {
  const std::uint32_t seed = combine(sequence.seed, std::uint32_t(dimension));
  return {seed, seed * 0x9e3779b1u + 0x7f4a7c15u, seed * 0x85ebca77u + 0x165667b1u};
}

// Both coordinates of a point as 32-bit fractions. A Sobol coordinate has its most significant digit in bit 0 until
// it is reversed: the permutation works upwards from there.
struct Digits {
  std::uint32_t first, second;
};
[[gnu::always_inline]] inline Digits digits(const Seeds& s, std::uint32_t index) {
  const std::uint32_t shuffled = reverse_bits(permute_upwards(reverse_bits(index), s.shuffle));
  return {reverse_bits(permute_upwards(shuffled, s.first)),
          reverse_bits(permute_upwards(pascal(shuffled), s.second))};
}
[[gnu::always_inline]] inline Digits digits(Sequence sequence, Dimension dimension, std::uint32_t index) {
  return digits(seeds(sequence, dimension), index);
}
// Vector code takes eight at a time.
std::size_t padded(int count) {
  return (std::size_t(count) + 7) / 8 * 8;
}

double unit(std::uint32_t fraction) {
  return double(fraction) * 0x1p-32;
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
  return unit(digits(sequence, dimension, index).first);
}

std::array<double, 2> draw2(Sequence sequence, Dimension dimension, std::uint32_t index) {
  const Digits d = digits(sequence, dimension, index);
  return {unit(d.first), unit(d.second)};
}

// The digits apart from their conversion: the first loop is 32 bits wide throughout.
void draw(Sequence sequence, Dimension dimension, std::uint32_t first, std::span<double> out) {
  const Seeds s = seeds(sequence, dimension);
  std::array<std::uint32_t, batch_size> fraction;
  for (std::size_t k = 0; k < padded(int(out.size())); ++k) fraction[k] = digits(s, first + std::uint32_t(k)).first;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = unit(fraction[k]);
}

void draw2(Sequence sequence, Dimension dimension, std::uint32_t first, std::span<std::array<double, 2>> out) {
  const Seeds s = seeds(sequence, dimension);
  std::array<Digits, batch_size> fractions;
  for (std::size_t k = 0; k < padded(int(out.size())); ++k) fractions[k] = digits(s, first + std::uint32_t(k));
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = {unit(fractions[k].first), unit(fractions[k].second)};
}

SequenceBatch pixel_sequences(std::uint32_t seed, std::span<const SampleId> samples, int bounce) {
  SequenceBatch batch;
  batch.count = int(samples.size());
  std::array<std::uint32_t, batch_size> x{}, y{}, replicate{};
  for (std::size_t k = 0; k < samples.size(); ++k) {
    x[k] = std::uint32_t(samples[k].x);
    y[k] = std::uint32_t(samples[k].y);
    replicate[k] = std::uint32_t(samples[k].replicate);
    batch.index[k] = samples[k].index;
  }
  const std::uint32_t picture = combine(0x53617465u, seed);
  for (std::size_t k = 0; k < padded(batch.count); ++k)
    batch.seed[k] = combine(combine(combine(combine(picture, x[k]), y[k]), replicate[k]), std::uint32_t(bounce));
  return batch;
}

Batch1 draw(const SequenceBatch& batch, Dimension dimension) {
  std::array<std::uint32_t, batch_size> first;
  for (std::size_t k = 0; k < padded(batch.count); ++k)
    first[k] = digits({batch.seed[k]}, dimension, batch.index[k]).first;
  Batch1 u;
  for (std::size_t k = 0; k < padded(batch.count); ++k) u[k] = unit(first[k]);
  return u;
}

Batch2 draw2(const SequenceBatch& batch, Dimension dimension) {
  std::array<std::uint32_t, batch_size> first, second;
  for (std::size_t k = 0; k < padded(batch.count); ++k) {
    const Digits d = digits({batch.seed[k]}, dimension, batch.index[k]);
    first[k] = d.first;
    second[k] = d.second;
  }
  Batch2 u;
  for (std::size_t k = 0; k < padded(batch.count); ++k) u[k] = {unit(first[k]), unit(second[k])};
  return u;
}

}  // namespace sateen
