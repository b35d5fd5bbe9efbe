#pragma once
#include <cmath>
#include <cstddef>

#if defined(__AVX2__) && defined(__FMA__)
#include <immintrin.h>
#define SATEEN_AVX2 1
#endif

namespace sateen {

/// Eight floats that are computed side by side. With AVX2 and FMA one register; elsewhere a plain array with the same
/// bits (std::fma is exact on every machine). Division and square root are the correctly rounded ones on purpose:
/// the processors' reciprocal estimates differ between makers.
struct Lanes {
  static constexpr int width = 8;
#ifdef SATEEN_AVX2
  __m256 v;
  Lanes() = default;
  Lanes(__m256 x) : v(x) {}
  Lanes(float x) : v(_mm256_set1_ps(x)) {}
  static Lanes load(const float* p) {
    return _mm256_loadu_ps(p);
  }
  /// The first four lanes; the others 1. Faster than a load of what was just stored piece by piece.
  static Lanes of(float a, float b, float c, float d) {
    return _mm256_setr_ps(a, b, c, d, 1, 1, 1, 1);
  }
  void store(float* p) const {
    _mm256_storeu_ps(p, v);
  }
#else
  float v[8];
  Lanes() = default;
  Lanes(float x) {
    for (float& e : v) e = x;
  }
  static Lanes load(const float* p) {
    Lanes r;
    for (int i = 0; i < 8; ++i) r.v[i] = p[i];
    return r;
  }
  static Lanes of(float a, float b, float c, float d) {
    const float p[8] = {a, b, c, d, 1, 1, 1, 1};
    return load(p);
  }
  void store(float* p) const {
    for (int i = 0; i < 8; ++i) p[i] = v[i];
  }
#endif
};

#ifdef SATEEN_AVX2
inline Lanes operator+(Lanes a, Lanes b) {
  return _mm256_add_ps(a.v, b.v);
}
inline Lanes operator-(Lanes a, Lanes b) {
  return _mm256_sub_ps(a.v, b.v);
}
inline Lanes operator*(Lanes a, Lanes b) {
  return _mm256_mul_ps(a.v, b.v);
}
inline Lanes operator/(Lanes a, Lanes b) {
  return _mm256_div_ps(a.v, b.v);
}
inline Lanes min(Lanes a, Lanes b) {
  return _mm256_min_ps(a.v, b.v);
}
inline Lanes max(Lanes a, Lanes b) {
  return _mm256_max_ps(a.v, b.v);
}
inline Lanes sqrt(Lanes a) {
  return _mm256_sqrt_ps(a.v);
}
inline Lanes abs(Lanes a) {
  return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v);
}
inline Lanes fma(Lanes a, Lanes b, Lanes c) {
  return _mm256_fmadd_ps(a.v, b.v, c.v);
}  ///< a b + c
inline Lanes fnma(Lanes a, Lanes b, Lanes c) {
  return _mm256_fnmadd_ps(a.v, b.v, c.v);
}  ///< c - a b
/// Lane by lane: a < b ? yes : no.
inline Lanes select_less(Lanes a, Lanes b, Lanes yes, Lanes no) {
  return _mm256_blendv_ps(no.v, yes.v, _mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ));
}
/// 2^n for whole n in [-126, 127].
inline Lanes exp2_whole(Lanes n) {
  const __m256i i = _mm256_add_epi32(_mm256_cvtps_epi32(n.v), _mm256_set1_epi32(127));
  return _mm256_castsi256_ps(_mm256_slli_epi32(i, 23));
}
inline Lanes round_nearest(Lanes a) {
  return _mm256_round_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
/// Sum of the lanes in a fixed order.
inline float sum(Lanes a) {
  const __m128 half = _mm_add_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
  const __m128 pair = _mm_add_ps(half, _mm_movehl_ps(half, half));
  return _mm_cvtss_f32(_mm_add_ss(pair, _mm_shuffle_ps(pair, pair, 1)));
}
#else
template <class Op>
inline Lanes each(Op op) {
  Lanes r;
  for (int i = 0; i < 8; ++i) r.v[i] = op(i);
  return r;
}
inline Lanes operator+(Lanes a, Lanes b) {
  return each([&](int i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each([&](int i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each([&](int i) { return a.v[i] * b.v[i]; });
}
inline Lanes operator/(Lanes a, Lanes b) {
  return each([&](int i) { return a.v[i] / b.v[i]; });
}
inline Lanes min(Lanes a, Lanes b) {
  return each([&](int i) { return a.v[i] < b.v[i] ? a.v[i] : b.v[i]; });
}
inline Lanes max(Lanes a, Lanes b) {
  return each([&](int i) { return a.v[i] > b.v[i] ? a.v[i] : b.v[i]; });
}
inline Lanes sqrt(Lanes a) {
  return each([&](int i) { return std::sqrt(a.v[i]); });
}
inline Lanes abs(Lanes a) {
  return each([&](int i) { return std::fabs(a.v[i]); });
}
inline Lanes fma(Lanes a, Lanes b, Lanes c) {
  return each([&](int i) { return std::fma(a.v[i], b.v[i], c.v[i]); });
}
inline Lanes fnma(Lanes a, Lanes b, Lanes c) {
  return each([&](int i) { return std::fma(-a.v[i], b.v[i], c.v[i]); });
}
inline Lanes select_less(Lanes a, Lanes b, Lanes yes, Lanes no) {
  return each([&](int i) { return a.v[i] < b.v[i] ? yes.v[i] : no.v[i]; });
}
inline Lanes exp2_whole(Lanes n) {
  return each([&](int i) { return std::ldexp(1.0f, int(n.v[i])); });
}
inline Lanes round_nearest(Lanes a) {
  return each([&](int i) { return std::nearbyint(a.v[i]); });
}
inline float sum(Lanes a) {
  const float h[4] = {a.v[0] + a.v[4], a.v[1] + a.v[5], a.v[2] + a.v[6], a.v[3] + a.v[7]};
  return (h[0] + h[2]) + (h[1] + h[3]);
}
#endif

/// Sixteen floats in two Lanes: the chains of two blocks side by side keep a processor without AVX-512 busier than
/// one after the other. Each lane gives the bits that it gives in Lanes.
struct PairLanes {
  static constexpr int width = 16;
  Lanes low, high;
  PairLanes() = default;
  PairLanes(Lanes a, Lanes b) : low(a), high(b) {}
  PairLanes(float x) : low(x), high(x) {}
  static PairLanes load(const float* p) { return {Lanes::load(p), Lanes::load(p + 8)}; }
  /// The first four lanes; the others 1.
  static PairLanes of(float a, float b, float c, float d) { return {Lanes::of(a, b, c, d), Lanes(1)}; }
  /// Eight lanes of one number, then eight of another.
  static PairLanes halves(float a, float b) { return {Lanes(a), Lanes(b)}; }
  /// Eight numbers twice.
  static PairLanes twice(const float* p) { return {Lanes::load(p), Lanes::load(p)}; }
  void store(float* p) const { low.store(p), high.store(p + 8); }
};
inline PairLanes operator+(PairLanes a, PairLanes b) {
  return {a.low + b.low, a.high + b.high};
}
inline PairLanes operator-(PairLanes a, PairLanes b) {
  return {a.low - b.low, a.high - b.high};
}
inline PairLanes operator*(PairLanes a, PairLanes b) {
  return {a.low * b.low, a.high * b.high};
}
inline PairLanes operator/(PairLanes a, PairLanes b) {
  return {a.low / b.low, a.high / b.high};
}
inline PairLanes min(PairLanes a, PairLanes b) {
  return {min(a.low, b.low), min(a.high, b.high)};
}
inline PairLanes max(PairLanes a, PairLanes b) {
  return {max(a.low, b.low), max(a.high, b.high)};
}
inline PairLanes sqrt(PairLanes a) {
  return {sqrt(a.low), sqrt(a.high)};
}
inline PairLanes abs(PairLanes a) {
  return {abs(a.low), abs(a.high)};
}
inline PairLanes fma(PairLanes a, PairLanes b, PairLanes c) {
  return {fma(a.low, b.low, c.low), fma(a.high, b.high, c.high)};
}
inline PairLanes fnma(PairLanes a, PairLanes b, PairLanes c) {
  return {fnma(a.low, b.low, c.low), fnma(a.high, b.high, c.high)};
}
inline PairLanes select_less(PairLanes a, PairLanes b, PairLanes yes, PairLanes no) {
  return {select_less(a.low, b.low, yes.low, no.low), select_less(a.high, b.high, yes.high, no.high)};
}
inline PairLanes exp2_whole(PairLanes n) {
  return {exp2_whole(n.low), exp2_whole(n.high)};
}
inline PairLanes round_nearest(PairLanes a) {
  return {round_nearest(a.low), round_nearest(a.high)};
}
/// Lane k added to lane k + 8, then as the sum of Lanes.
inline float sum(PairLanes a) {
  return sum(a.low + a.high);
}

#ifdef __AVX512F__
/// Sixteen floats, only in files compiled for AVX-512. Each lane gives the bits that it gives in Lanes.
struct WideLanes {
  static constexpr int width = 16;
  __m512 v;
  WideLanes() = default;
  WideLanes(__m512 x) : v(x) {}
  WideLanes(float x) : v(_mm512_set1_ps(x)) {}
  static WideLanes load(const float* p) { return _mm512_loadu_ps(p); }
  /// The first four lanes; the others 1.
  static WideLanes of(float a, float b, float c, float d) {
    return _mm512_insertf32x8(_mm512_set1_ps(1), _mm256_setr_ps(a, b, c, d, 1, 1, 1, 1), 0);
  }
  /// Eight lanes of one number, then eight of another.
  static WideLanes halves(float a, float b) { return _mm512_insertf32x8(_mm512_set1_ps(a), _mm256_set1_ps(b), 1); }
  /// Eight numbers twice.
  static WideLanes twice(const float* p) { return _mm512_broadcast_f32x8(_mm256_loadu_ps(p)); }
  void store(float* p) const { _mm512_storeu_ps(p, v); }
};
inline WideLanes operator+(WideLanes a, WideLanes b) {
  return _mm512_add_ps(a.v, b.v);
}
inline WideLanes operator-(WideLanes a, WideLanes b) {
  return _mm512_sub_ps(a.v, b.v);
}
inline WideLanes operator*(WideLanes a, WideLanes b) {
  return _mm512_mul_ps(a.v, b.v);
}
inline WideLanes operator/(WideLanes a, WideLanes b) {
  return _mm512_div_ps(a.v, b.v);
}
inline WideLanes min(WideLanes a, WideLanes b) {
  return _mm512_min_ps(a.v, b.v);
}
inline WideLanes max(WideLanes a, WideLanes b) {
  return _mm512_max_ps(a.v, b.v);
}
inline WideLanes sqrt(WideLanes a) {
  return _mm512_sqrt_ps(a.v);
}
inline WideLanes abs(WideLanes a) {
  return _mm512_abs_ps(a.v);
}
inline WideLanes fma(WideLanes a, WideLanes b, WideLanes c) {
  return _mm512_fmadd_ps(a.v, b.v, c.v);
}
inline WideLanes fnma(WideLanes a, WideLanes b, WideLanes c) {
  return _mm512_fnmadd_ps(a.v, b.v, c.v);
}
inline WideLanes select_less(WideLanes a, WideLanes b, WideLanes yes, WideLanes no) {
  return _mm512_mask_blend_ps(_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ), no.v, yes.v);
}
inline WideLanes exp2_whole(WideLanes n) {
  const __m512i i = _mm512_add_epi32(_mm512_cvtps_epi32(n.v), _mm512_set1_epi32(127));
  return _mm512_castsi512_ps(_mm512_slli_epi32(i, 23));
}
inline WideLanes round_nearest(WideLanes a) {
  return _mm512_roundscale_ps(a.v, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
/// Lane k added to lane k + 8, then as the sum of Lanes.
inline float sum(WideLanes a) {
  return sum(Lanes(_mm256_add_ps(_mm512_castps512_ps256(a.v), _mm512_extractf32x8_ps(a.v, 1))));
}
#endif

// The same names on double, so that one template serves the renderer (Lanes) and its oracle in the tests (double).
inline double min(double a, double b) {
  return a < b ? a : b;
}
inline double max(double a, double b) {
  return a > b ? a : b;
}
inline double sqrt(double a) {
  return std::sqrt(a);
}
inline double abs(double a) {
  return std::fabs(a);
}
inline double fma(double a, double b, double c) {
  return a * b + c;
}
inline double fnma(double a, double b, double c) {
  return c - a * b;
}
inline double select_less(double a, double b, double yes, double no) {
  return a < b ? yes : no;
}
inline double sum(double a) {
  return a;
}

}  // namespace sateen
