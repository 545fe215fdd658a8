/* Vectors of four floats, made with the compiler's vector types. Every lane is plain IEEE
 * arithmetic, so the bits do not depend on the instruction set. */
#pragma once

#include <string.h>
#ifdef __SSE2__
#include <emmintrin.h> /* not immintrin.h: most files would have to read its 60,000 lines */
#endif

typedef float cs_v4 __attribute__((vector_size(16)));

/* Four doubles, for sums of many floats. */
typedef double cs_v2d __attribute__((vector_size(16)));
typedef struct cs_v4d {
  cs_v2d low, high;
} cs_v4d;

static inline cs_v4 cs_v4_all(float x) { return (cs_v4){x, x, x, x}; }

static inline cs_v2d cs_v2d_load(const double *from) {
  cs_v2d v;
  memcpy(&v, from, sizeof v);
  return v;
}

/* Lane by lane the lesser; b where a is NaN. */
static inline cs_v2d cs_v2d_min(cs_v2d a, cs_v2d b) {
#ifdef __SSE2__
  return _mm_min_pd(a, b);
#else
  return (cs_v2d){a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
#endif
}

/* Which lanes are equal: bit 0 and bit 1. */
static inline unsigned cs_v2d_equal(cs_v2d a, cs_v2d b) {
#ifdef __SSE2__
  return (unsigned)_mm_movemask_pd(_mm_cmpeq_pd(a, b));
#else
  return (unsigned)(a[0] == b[0]) | (unsigned)(a[1] == b[1]) << 1;
#endif
}

static inline cs_v4d cs_v4_wide(cs_v4 v) { return (cs_v4d){{v[0], v[1]}, {v[2], v[3]}}; }

static inline cs_v4 cs_v4_narrow(cs_v4d v) {
  return (cs_v4){(float)v.low[0], (float)v.low[1], (float)v.high[0], (float)v.high[1]};
}

static inline cs_v4d cs_v4d_add(cs_v4d a, cs_v4d b) {
  return (cs_v4d){a.low + b.low, a.high + b.high};
}

static inline cs_v4d cs_v4d_scale(double weight, cs_v4d v) {
  return (cs_v4d){weight * v.low, weight * v.high};
}

/* The change from one colour to another, exactly. */
static inline cs_v4d cs_v4d_step(cs_v4 from, cs_v4 to) {
  cs_v4d a = cs_v4_wide(from), b = cs_v4_wide(to);
  return (cs_v4d){b.low - a.low, b.high - a.high};
}

static inline cs_v4 cs_v4_load(const float *from) {
  cs_v4 v;
  memcpy(&v, from, sizeof v);
  return v;
}

static inline void cs_v4_store(float *to, cs_v4 v) { memcpy(to, &v, sizeof v); }

/* Lane by lane the greater, or the lesser; b where a is NaN. */
static inline cs_v4 cs_v4_max(cs_v4 a, cs_v4 b) {
#ifdef __SSE2__
  return _mm_max_ps(a, b); /* one instruction: compilers do not always find it for a conditional */
#else
  typedef int lanes __attribute__((vector_size(16)));
  lanes use_a = a > b;
  return (cs_v4)(((lanes)a & use_a) | ((lanes)b & ~use_a));
#endif
}

static inline cs_v4 cs_v4_min(cs_v4 a, cs_v4 b) {
#ifdef __SSE2__
  return _mm_min_ps(a, b);
#else
  typedef int lanes __attribute__((vector_size(16)));
  lanes use_a = a < b;
  return (cs_v4)(((lanes)a & use_a) | ((lanes)b & ~use_a));
#endif
}

/* A premultiplied colour clamped to its bounds: light is not negative, and alpha is at most 1. For
 * mixtures that may leave the range of the mixed colours. */
static inline cs_v4 cs_v4_bounded(cs_v4 colour) {
  const cs_v4 most = {__builtin_inff(), __builtin_inff(), __builtin_inff(), 1};
  return cs_v4_min(cs_v4_max(colour, cs_v4_all(0)), most);
}

/* A sum of weighted colours, which may miss its bounds by the last bits: clamps alpha to 0..1, and
 * replaces light that is only slightly below 0 by 0. Truly negative light is not changed: it is a
 * colour outside the gamut of its space, which for example a change of hue can give. */
static inline cs_v4 cs_v4_settled(cs_v4 sum) {
  const cs_v4 residue = {-0x1p-20F, -0x1p-20F, -0x1p-20F, -__builtin_inff()};
  typedef int lanes __attribute__((vector_size(16)));
  lanes stays = sum < residue, settled = (lanes)cs_v4_bounded(sum);
  return (cs_v4)(((lanes)sum & stays) | (settled & ~stays));
}

/* One of two values, without a branch. */
static inline cs_v4 cs_v4_choose(int condition, cs_v4 one, cs_v4 other) {
  typedef int lanes __attribute__((vector_size(16)));
  int all = -(condition != 0);
  lanes mask = {all, all, all, all};
  return (cs_v4)(((lanes)one & mask) | ((lanes)other & ~mask));
}

/* Whether every lane lies between the same lanes of two other values. */
static inline int cs_v4_is_between(cs_v4 value, cs_v4 least, cs_v4 most) {
#ifdef __SSE2__
  return _mm_movemask_ps(_mm_and_ps(_mm_cmpge_ps(value, least), _mm_cmple_ps(value, most))) == 15;
#else
  typedef long long words __attribute__((vector_size(16)));
  words lanes = (words)((value >= least) & (value <= most));
  return (lanes[0] & lanes[1]) == -1;
#endif
}

/* Whether a lane of a is greater than the same lane of b. */
static inline int cs_v4_any_above(cs_v4 a, cs_v4 b) {
  typedef long long words __attribute__((vector_size(16)));
  words above = (words)(a > b);
  return (above[0] | above[1]) != 0;
}

/* Whether all 128 bits agree: minus zero differs from zero. */
static inline int cs_v4_same(cs_v4 a, cs_v4 b) {
#ifdef __SSE2__
  return _mm_movemask_epi8(_mm_cmpeq_epi32((__m128i)a, (__m128i)b)) == 0xffff;
#else
  typedef long long words __attribute__((vector_size(16)));
  words differ = (words)a ^ (words)b;
  return (differ[0] | differ[1]) == 0;
#endif
}
