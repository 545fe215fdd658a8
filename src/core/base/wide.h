/* Vectors of as many floats as a register has, and the choice of instructions.
 *
 * A file of kernels (wide_sources in the folder's meson.build) is compiled once for every set of
 * instructions; its functions are named by CS_WIDE, and one is chosen at run time. Every lane is
 * plain IEEE arithmetic and nothing is fused, so the bits are the same whichever function runs. The
 * exception is the curve of model/colour/srgb8_lanes.h, whose result is checked.
 */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#ifdef __AVX2__
#include <immintrin.h>
#endif

/* In ascending order of width. */
typedef enum cs_isa { CS_ISA_ANY, CS_ISA_AVX2, CS_ISA_AVX512 } cs_isa;

/* A build may be limited to narrower registers, for tools that do not know the widest. */
#ifndef CS_ISA_MOST
#define CS_ISA_MOST CS_ISA_AVX512
#endif

#ifdef __x86_64__
#define CS_WIDE_CHOOSE(isa, name)                                                                  \
  ((isa) == CS_ISA_AVX512 ? name##_avx512 : (isa) == CS_ISA_AVX2 ? name##_avx2 : name##_any)

/* The widest set of instructions that this processor has. */
static inline cs_isa cs_isa_best(void) {
  if (CS_ISA_MOST >= CS_ISA_AVX512 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return CS_ISA_AVX512;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? CS_ISA_AVX2 : CS_ISA_ANY;
}
#else
#define CS_WIDE_CHOOSE(isa, name) ((void)(isa), name##_any)
static inline cs_isa cs_isa_best(void) { return CS_ISA_ANY; }
#endif

/* Declares a kernel for all sets of instructions: CS_WIDE_DECLARE(void, cs_file_verb, (int
 * argument)). */
#define CS_WIDE_DECLARE(type, name, arguments)                                                     \
  type name##_any arguments;                                                                       \
  type name##_avx2 arguments;                                                                      \
  type name##_avx512 arguments

/* The name for the set of instructions that is being compiled for. */
#define CS_WIDE_JOIN(name, isa) name##_##isa
#define CS_WIDE_EXPAND(name, isa) CS_WIDE_JOIN(name, isa)
#define CS_WIDE(name) CS_WIDE_EXPAND(name, CS_WIDE_ISA)

/* Arrays that kernels read begin at a line of the cache: an access across two lines costs twice as
 * much. */
#define CS_WIDE_LINE 64

static inline void *cs_wide_align(void *block) {
  return (char *)block + (-(uintptr_t)block & (CS_WIDE_LINE - 1));
}

/* As many lanes as the registers have. Lane 4 k + c is channel c of pixel k. In each four lanes,
 * CS_WIDE_SPREAD has channel c of v four times; CS_WIDE_JOINED has the channels i and j of v, and
 * then those of w. */
#ifdef __AVX512F__
#define CS_WIDE_LANES 16
#define CS_WIDE_SPREAD(v, c)                                                                       \
  __builtin_shufflevector(v, v, (c), (c), (c), (c), (c) + 4, (c) + 4, (c) + 4, (c) + 4, (c) + 8,   \
                          (c) + 8, (c) + 8, (c) + 8, (c) + 12, (c) + 12, (c) + 12, (c) + 12)
#define CS_WIDE_JOINED(v, w, i, j)                                                                 \
  ((cs_wide)_mm512_shuffle_ps((__m512)(v), (__m512)(w), _MM_SHUFFLE(j, i, j, i)))
#define CS_WIDE_PIXEL(r, g, b, a)                                                                  \
  { r, g, b, a, r, g, b, a, r, g, b, a, r, g, b, a }
#elif defined(__AVX2__)
#define CS_WIDE_LANES 8
#define CS_WIDE_SPREAD(v, c)                                                                       \
  __builtin_shufflevector(v, v, (c), (c), (c), (c), (c) + 4, (c) + 4, (c) + 4, (c) + 4)
#define CS_WIDE_JOINED(v, w, i, j)                                                                 \
  ((cs_wide)_mm256_shuffle_ps((__m256)(v), (__m256)(w), _MM_SHUFFLE(j, i, j, i)))
#define CS_WIDE_PIXEL(r, g, b, a)                                                                  \
  { r, g, b, a, r, g, b, a }
#else
#define CS_WIDE_LANES 4
#define CS_WIDE_SPREAD(v, c) __builtin_shufflevector(v, v, (c), (c), (c), (c))
#define CS_WIDE_JOINED(v, w, i, j) __builtin_shufflevector(v, w, i, j, 4 + (i), 4 + (j))
#define CS_WIDE_PIXEL(r, g, b, a)                                                                  \
  { r, g, b, a }
#endif

typedef float cs_wide __attribute__((vector_size(4 * CS_WIDE_LANES)));
typedef int32_t cs_wide_int __attribute__((vector_size(4 * CS_WIDE_LANES)));

static inline cs_wide cs_wide_load(const float *from) {
  cs_wide v;
  memcpy(&v, from, sizeof v);
  return v;
}

static inline void cs_wide_store(float *to, cs_wide v) { memcpy(to, &v, sizeof v); }

static inline cs_wide cs_wide_all(float x) { return (cs_wide){0} + x; }

/* Sets every pixel of the register to this pixel. */
static inline cs_wide cs_wide_pixel(const float rgba[4]) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_broadcast_f32x4(_mm_loadu_ps(rgba));
#elif defined(__AVX2__)
  return (cs_wide)_mm256_broadcast_ps((const __m128 *)(const void *)rgba);
#else
  return cs_wide_load(rgba);
#endif
}

/* Sets the register to these pixels. */
static inline cs_wide cs_wide_pixels(const float *const pixels[CS_WIDE_LANES / 4]) {
#ifdef __AVX512F__
  __m512 v = _mm512_castps128_ps512(_mm_loadu_ps(pixels[0]));
  v = _mm512_insertf32x4(v, _mm_loadu_ps(pixels[1]), 1);
  v = _mm512_insertf32x4(v, _mm_loadu_ps(pixels[2]), 2);
  return (cs_wide)_mm512_insertf32x4(v, _mm_loadu_ps(pixels[3]), 3);
#elif defined(__AVX2__)
  __m256 v = _mm256_castps128_ps256(_mm_loadu_ps(pixels[0]));
  return (cs_wide)_mm256_insertf128_ps(v, _mm_loadu_ps(pixels[1]), 1);
#else
  return cs_wide_load(pixels[0]);
#endif
}

/* The number of its pixel in each lane: 0, 0, 0, 0, 1, 1, 1, 1, ... */
static inline cs_wide cs_wide_pixel_numbers(void) {
  float lanes[CS_WIDE_LANES];
  for (int i = 0; i < CS_WIDE_LANES; i++)
    lanes[i] = (float)(i / 4);
  return cs_wide_load(lanes);
}

/* Whether a mask is set in any lane. */
static inline bool cs_wide_any(cs_wide_int mask) {
#ifdef __AVX512F__
  return _mm512_movepi32_mask((__m512i)mask) != 0;
#elif defined(__AVX2__)
  return _mm256_movemask_ps((__m256)mask) != 0;
#else
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}

/* Each lane is the lane of `one` where the mask is set, and the lane of `other` elsewhere. */
static inline cs_wide cs_wide_choose(cs_wide_int mask, cs_wide one, cs_wide other) {
  return (cs_wide)(((cs_wide_int)one & mask) | ((cs_wide_int)other & ~mask));
}

/* Clamped to 0..1; NaN stays NaN. */
static inline cs_wide cs_wide_unit(cs_wide v) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_min_ps(_mm512_set1_ps(1), _mm512_max_ps(_mm512_setzero_ps(), (__m512)v));
#elif defined(__AVX2__)
  return (cs_wide)_mm256_min_ps(_mm256_set1_ps(1), _mm256_max_ps(_mm256_setzero_ps(), (__m256)v));
#else
  v = cs_wide_choose(v < 0, cs_wide_all(0), v);
  return cs_wide_choose(v > 1, cs_wide_all(1), v);
#endif
}

/* Lane by lane the lesser, or the greater; b where a is NaN. */
static inline cs_wide cs_wide_min(cs_wide a, cs_wide b) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_min_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
  return (cs_wide)_mm256_min_ps((__m256)a, (__m256)b);
#else
  return cs_wide_choose(a < b, a, b);
#endif
}

static inline cs_wide cs_wide_max(cs_wide a, cs_wide b) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_max_ps((__m512)a, (__m512)b);
#elif defined(__AVX2__)
  return (cs_wide)_mm256_max_ps((__m256)a, (__m256)b);
#else
  return cs_wide_choose(a > b, a, b);
#endif
}

/* Exact in every lane, as sqrtf. */
static inline cs_wide cs_wide_sqrt(cs_wide v) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_sqrt_ps((__m512)v);
#elif defined(__AVX2__)
  return (cs_wide)_mm256_sqrt_ps((__m256)v);
#else
  for (int i = 0; i < CS_WIDE_LANES; i++)
    v[i] = sqrtf(v[i]);
  return v;
#endif
}
