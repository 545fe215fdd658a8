/* 8-bit sRGB of as many pixels as a register holds, each as red, green, blue and alpha: for kernels
 * (base/wide.h), which write them to their places.
 *
 * Invariant: a pixel is cs_srgb8_pixel_of its colour, whichever instructions made the pixel.
 * is_coded is a constant of each loop: numbers that are codes take the straight part of the curve
 * alone.
 */
#pragma once

#include <stdbool.h>

#include "base/wide.h"
#include "model/colour/power.h"
#include "model/colour/srgb8.h"

/* The sRGB curve in vector code, rounded to codes.
 *
 * Vector code approximates; the exact curve is evaluated only where the rounding is in doubt:
 *
 *   colour --divided by alpha, clamped to 0..1--> x --curve--> y = 255 f(x) + 1/2 --> floor(y)
 *
 *                 code n                 code n + 1
 *       |------------------------|------------------------|---> y
 *       n                      n + 1                    n + 2
 *     #####                    #####                    #####
 *       unsure: y within UNSURE of a whole number, one pixel in six hundred
 *
 * x^(1/2.4) is the power of its octave, from a table that fits a register or two, times a
 * polynomial over the octave. y is then exact within UNSURE, so its floor is right unless y lies
 * within UNSURE of a whole number; such pixels are coded again, one by one.
 */

#ifdef __AVX2__

#include <immintrin.h>

#define CS_SRGB8_UNSURE 0x1p-12f
#define CS_SRGB8_SLOPE (255 * (float)CS_POWER_SRGB_SLOPE)
#define CS_SRGB8_KNEE ((float)CS_POWER_SRGB_LIGHT)

/* 255 * 1.055 * 2^(e / 2.4), by the last four bits of the exponent e + 127 of a float from 2^-13 to
 * 1. Smaller floats lie on the straight part of the curve. */
static const float cs_srgb8_octaves[16] = {0,
                                           0,
                                           0x1.931502p+2f,
                                           0x1.0d0666p+3f,
                                           0x1.671af4p+3f,
                                           0x1.df591ap+3f,
                                           0x1.3fed2cp+4f,
                                           0x1.ab0cf2p+4f,
                                           0x1.1d05a6p+5f,
                                           0x1.7c7574p+5f,
                                           0x1.fbda00p+5f,
                                           0x1.52f344p+6f,
                                           0x1.c471bep+6f,
                                           0x1.2df86ap+7f,
                                           0x1.931502p+7f,
                                           0x1.0d0666p+8f};

/* (1.5 + t)^(1/2.4), |t| <= 1/2, with a relative error below 2e-7. */
static const float cs_srgb8_powers[7] = {0x1.2f1e24p+0f, 0x1.50ccccp-2f,  -0x1.05fb8ap-4f,
                                         0x1.6f6528p-6f, -0x1.3a0e4cp-7f, 0x1.571f32p-8f,
                                         -0x1.762c0ap-9f};

/* One bit a lane: whether the lanes differ. */
static inline unsigned cs_srgb8_differ(cs_wide_int a, cs_wide_int b) {
#ifdef __AVX512F__
  return _mm512_cmpneq_epi32_mask((__m512i)a, (__m512i)b);
#else
  return (unsigned)_mm256_movemask_ps((__m256)(a != b));
#endif
}

/* Clamped to 0..1. NaN becomes 0. */
static inline cs_wide cs_srgb8_clamped(cs_wide v) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_min_ps(_mm512_max_ps((__m512)v, _mm512_setzero_ps()), _mm512_set1_ps(1));
#else
  return (cs_wide)_mm256_min_ps(_mm256_max_ps((__m256)v, _mm256_setzero_ps()), _mm256_set1_ps(1));
#endif
}

/* low where x is at most the limit, otherwise high. */
static inline cs_wide cs_srgb8_either(cs_wide x, cs_wide limit, cs_wide low, cs_wide high) {
#ifdef __AVX512F__
  __mmask16 is_high = _mm512_cmp_ps_mask((__m512)x, (__m512)limit, _CMP_GT_OQ);
  return (cs_wide)_mm512_mask_blend_ps(is_high, (__m512)low, (__m512)high);
#else
  return (cs_wide)_mm256_blendv_ps((__m256)low, (__m256)high, (__m256)(x > limit));
#endif
}

/* The powers of the octaves of x. */
static inline cs_wide cs_srgb8_octave(cs_wide x) {
#ifdef __AVX512F__
  __m512i octave = _mm512_srli_epi32((__m512i)x, 23);
  return (cs_wide)_mm512_permutexvar_ps(octave, _mm512_loadu_ps(cs_srgb8_octaves));
#else
  __m256i octave = _mm256_srli_epi32((__m256i)x, 23);
  /* bit 3, moved to the sign */
  __m256 is_high = _mm256_castsi256_ps(_mm256_slli_epi32(octave, 28));
  __m256 low = _mm256_permutevar8x32_ps(_mm256_loadu_ps(cs_srgb8_octaves), octave);
  __m256 high = _mm256_permutevar8x32_ps(_mm256_loadu_ps(cs_srgb8_octaves + 8), octave);
  return (cs_wide)_mm256_blendv_ps(low, high, is_high);
#endif
}

/* a + b c, rounded once or twice. Here alone that is right: the curve is approximated, and its
 * result is checked. */
static inline cs_wide cs_srgb8_add(cs_wide a, cs_wide b, cs_wide c) {
#ifdef __AVX512F__
  return (cs_wide)_mm512_fmadd_ps((__m512)b, (__m512)c, (__m512)a);
#elif defined(__FMA__)
  return (cs_wide)_mm256_fmadd_ps((__m256)b, (__m256)c, (__m256)a);
#else
  return a + b * c;
#endif
}

/* 255 f(x): x * slope up to the knee, then the curve. */
static inline cs_wide cs_srgb8_coded(cs_wide x, cs_wide slope, cs_wide knee) {
  cs_wide t = (cs_wide)(((cs_wide_int)x & 0x7fffff) | 0x3f800000) - 1.5f;
  cs_wide power = cs_wide_all(cs_srgb8_powers[6]);
  for (int k = 5; k >= 0; k--)
    power = cs_srgb8_add(cs_wide_all(cs_srgb8_powers[k]), t, power);
  cs_wide curved = cs_srgb8_add(cs_wide_all(-255 * 0.055f), cs_srgb8_octave(x), power);
  return cs_srgb8_either(x, knee, x * slope, curved);
}

/* The whole part of y + lift. Sets `unsure` to a value other than 0 in lanes where the whole part
 * is not certain. */
static inline cs_wide_int cs_srgb8_lifted(cs_wide y, cs_wide lift, cs_wide_int *unsure) {
  cs_wide_int least = __builtin_convertvector(y + (lift - CS_SRGB8_UNSURE), cs_wide_int);
  cs_wide_int most = __builtin_convertvector(y + (lift + CS_SRGB8_UNSURE), cs_wide_int);
  *unsure |= least ^ most;
  return least;
}

static inline cs_wide_int cs_srgb8_round(cs_wide y, cs_wide_int *unsure) {
  return cs_srgb8_lifted(y, cs_wide_all(0.5f), unsure);
}

#endif

enum { CS_SRGB8_PIXELS = CS_WIDE_LANES / 4 };

#ifdef __AVX2__

/* Divides colours by their alpha and clamps them to 0..1. */
static inline cs_wide cs_srgb8_straight(cs_wide v) {
  const cs_wide_int colours = CS_WIDE_PIXEL(-1, -1, -1, 0);
  const cs_wide none = {0}, one = cs_wide_all(1);
  cs_wide alpha = CS_WIDE_SPREAD(v, 3);
  if (cs_srgb8_differ((cs_wide_int)alpha, (cs_wide_int)one)) {
    cs_wide_int is_seen = alpha > 0;
    v = cs_wide_choose(is_seen, v / cs_wide_choose(is_seen & colours, alpha, one), none);
  }
  return cs_srgb8_clamped(v);
}

/* Stores numbers below 256 as bytes. */
static inline void cs_srgb8_store(unsigned char *out, cs_wide_int numbers) {
#ifdef __AVX512F__
  _mm_storeu_si128((__m128i *)(void *)out, _mm512_cvtepi32_epi8((__m512i)numbers));
#else
  __m128i low = _mm256_castsi256_si128((__m256i)numbers);
  __m128i words = _mm_packs_epi32(low, _mm256_extracti128_si256((__m256i)numbers, 1));
  _mm_storel_epi64((__m128i *)(void *)out, _mm_packus_epi16(words, words));
#endif
}

/* Codes the pixels that have an unsure lane (a set bit) again, exactly. */
static inline void cs_srgb8_settle(cs_wide rgba, bool is_coded, unsigned unsure,
                                   unsigned char *out) {
  float colours[CS_WIDE_LANES];
  cs_wide_store(colours, rgba);
  for (int k = 0; k < CS_SRGB8_PIXELS; k++, unsure >>= 4) {
    uint32_t pixel = cs_srgb8_pixel_of(colours + 4 * k, is_coded);
    if (unsure & 15)
      memcpy(out + 4 * k, &pixel, sizeof pixel);
  }
}

/* 255 times the codes of colours between 0 and 1. */
static inline cs_wide cs_srgb8_numbers(cs_wide straight, bool is_coded) {
  const cs_wide slope = CS_WIDE_PIXEL(CS_SRGB8_SLOPE, CS_SRGB8_SLOPE, CS_SRGB8_SLOPE, 255);
  const cs_wide knee = CS_WIDE_PIXEL(CS_SRGB8_KNEE, CS_SRGB8_KNEE, CS_SRGB8_KNEE, 2);
  return is_coded ? straight * 255 : cs_srgb8_coded(straight, slope, knee);
}

/* CS_SRGB8_PIXELS premultiplied colours as pixels. */
static inline void cs_srgb8_lanes(cs_wide rgba, bool is_coded, unsigned char *out) {
  const cs_wide_int none = {0};
  cs_wide_int doubt = {0};
  cs_wide numbers = cs_srgb8_numbers(cs_srgb8_straight(rgba), is_coded);
  cs_srgb8_store(out, cs_srgb8_round(numbers, &doubt));
  unsigned unsure = cs_srgb8_differ(doubt, none);
  if (__builtin_expect(unsure != 0, 0))
    cs_srgb8_settle(rgba, is_coded, unsure, out);
}

#else

static inline void cs_srgb8_lanes(cs_wide rgba, bool is_coded, unsigned char *out) {
  float colour[4];
  cs_wide_store(colour, rgba);
  uint32_t pixel = cs_srgb8_pixel_of(colour, is_coded);
  memcpy(out, &pixel, sizeof pixel);
}

#endif

/* 8-bit sRGB of as many pixels as a register has lanes: every register holds one channel. For
 * kernels (base/wide.h).
 *
 * Invariant: a pixel is cs_srgb8_pixel of its colour, whichever instructions made the pixel.
 */

/* Red, green, blue, alpha. */
typedef struct cs_srgb8_planes {
  cs_wide channels[4];
} cs_srgb8_planes;

/* A register of colours, each `stride` numbers after the one before. */
static inline cs_srgb8_planes cs_srgb8_planes_of(const float *rgba, size_t stride) {
  cs_wide v[4]; /* v[i]: the pixels i, i + 4, i + 8, ... */
  for (int i = 0; i < 4; i++) {
    const float *pixels[CS_SRGB8_PIXELS];
    for (int k = 0; k < CS_SRGB8_PIXELS; k++)
      pixels[k] = rgba + stride * (size_t)(4 * k + i);
    v[i] = cs_wide_pixels(pixels);
  }
  cs_wide rg = CS_WIDE_JOINED(v[0], v[1], 0, 1), next_rg = CS_WIDE_JOINED(v[2], v[3], 0, 1);
  cs_wide ba = CS_WIDE_JOINED(v[0], v[1], 2, 3), next_ba = CS_WIDE_JOINED(v[2], v[3], 2, 3);
  return (cs_srgb8_planes){{CS_WIDE_JOINED(rg, next_rg, 0, 2), CS_WIDE_JOINED(rg, next_rg, 1, 3),
                            CS_WIDE_JOINED(ba, next_ba, 0, 2), CS_WIDE_JOINED(ba, next_ba, 1, 3)}};
}

/* Codes the pixels that have an unsure lane (a set bit) again, exactly. */
static inline cs_wide_int cs_srgb8_settle_planes(const cs_srgb8_planes *colours, bool is_coded,
                                                 unsigned unsure, cs_wide_int pixels) {
  for (int k = 0; k < CS_WIDE_LANES; k++, unsure >>= 1) {
    const float rgba[4] = {colours->channels[0][k], colours->channels[1][k],
                           colours->channels[2][k], colours->channels[3][k]};
    if (unsure & 1)
      pixels[k] = (int32_t)cs_srgb8_pixel_of(rgba, is_coded);
  }
  return pixels;
}

#ifdef __AVX2__

/* One pixel a lane: the whole parts of its numbers and its lift. If all alpha is 1, the usual case,
 * there is no division. Sets a bit of `unsure` for each lane that is not certain. */
static inline cs_wide_int cs_srgb8_lift_planes(const cs_srgb8_planes *colours, bool is_coded,
                                               bool is_straight, cs_wide lift, unsigned *unsure) {
  const cs_wide one = cs_wide_all(1), slope = cs_wide_all(CS_SRGB8_SLOPE);
  const cs_wide knee = cs_wide_all(CS_SRGB8_KNEE);
  const cs_wide_int none = {0};
  cs_wide alpha = colours->channels[3];
  bool is_opaque = cs_srgb8_differ((cs_wide_int)alpha, (cs_wide_int)one) == 0;
  cs_wide_int is_seen = alpha > 0, doubt = {0}, pixels = none + 255;
  if (!is_opaque) {
    pixels = cs_srgb8_lifted(cs_srgb8_clamped(alpha) * 255, lift, &doubt);
    alpha = cs_wide_choose(is_seen, alpha, one);
  }
  for (int c = 2; c >= 0; c--) {
    cs_wide v = colours->channels[c];
    if (is_straight && !is_opaque)
      v = cs_wide_choose(is_seen, v / alpha, (cs_wide){0});
    v = cs_srgb8_clamped(v);
    v = is_coded ? v * 255 : cs_srgb8_coded(v, slope, knee);
    pixels = pixels << 8 | cs_srgb8_lifted(v, lift, &doubt);
  }
  *unsure = cs_srgb8_differ(doubt, none);
  return pixels;
}

/* One pixel a lane. */
static inline cs_wide_int cs_srgb8_code_planes(const cs_srgb8_planes *colours, bool is_coded) {
  unsigned unsure;
  cs_wide_int pixels = cs_srgb8_lift_planes(colours, is_coded, true, cs_wide_all(0.5f), &unsure);
  if (__builtin_expect(unsure != 0, 0))
    pixels = cs_srgb8_settle_planes(colours, is_coded, unsure, pixels);
  return pixels;
}

#else

static inline cs_wide_int cs_srgb8_code_planes(const cs_srgb8_planes *colours, bool is_coded) {
  return cs_srgb8_settle_planes(colours, is_coded, ~0u, (cs_wide_int){0});
}

#endif

/* ---------------------------------------------------------------- arrays, for any code */

CS_WIDE_DECLARE(void, cs_srgb8_code, (const float *rgba, size_t count, unsigned char *out));
CS_WIDE_DECLARE(void, cs_srgb8_codes, (const float *rgba, size_t count, unsigned char *out));

/* `count` colours as pixels. */
typedef void (*cs_srgb8)(const float *rgba, size_t count, unsigned char *out);

/* For linear colours. */
static inline cs_srgb8 cs_srgb8_choose(cs_isa isa) { return CS_WIDE_CHOOSE(isa, cs_srgb8_code); }
/* For colours whose numbers are codes. */
static inline cs_srgb8 cs_srgb8_choose_codes(cs_isa isa) {
  return CS_WIDE_CHOOSE(isa, cs_srgb8_codes);
}
