/* 8-bit sRGB of as many pixels as a register holds, each as red, green, blue and alpha: for kernels
 * (base/wide.h), which write them to their places.
 *
 * Invariant: a pixel is cs_srgb8_pixel of its colour, whichever instructions made it.
 */
#ifndef CS_COLOUR_SRGB8_LANES_H
#define CS_COLOUR_SRGB8_LANES_H

#include "colour/srgb8_curve.h"

#include <stdbool.h>

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

/* Codes again, exactly, the pixels that have an unsure lane (a set bit). */
static inline void cs_srgb8_settle(cs_wide rgba, unsigned unsure, unsigned char *out) {
  float colours[CS_WIDE_LANES];
  cs_wide_store(colours, rgba);
  for (int k = 0; k < CS_SRGB8_PIXELS; k++, unsure >>= 4) {
    uint32_t pixel = cs_srgb8_pixel(colours + 4 * k);
    if (unsure & 15)
      memcpy(out + 4 * k, &pixel, sizeof pixel);
  }
}

/* CS_SRGB8_PIXELS premultiplied linear colours as pixels. */
static inline void cs_srgb8_lanes(cs_wide rgba, unsigned char *out) {
  const cs_wide slope = CS_WIDE_PIXEL(255 * 12.92f, 255 * 12.92f, 255 * 12.92f, 255);
  const cs_wide knee = CS_WIDE_PIXEL(0.0031308f, 0.0031308f, 0.0031308f, 2);
  const cs_wide_int none = {0};
  cs_wide_int doubt = {0};
  cs_srgb8_store(out, cs_srgb8_round(cs_srgb8_coded(cs_srgb8_straight(rgba), slope, knee), &doubt));
  unsigned unsure = cs_srgb8_differ(doubt, none);
  if (__builtin_expect(unsure != 0, 0))
    cs_srgb8_settle(rgba, unsure, out);
}

#else

static inline void cs_srgb8_lanes(cs_wide rgba, unsigned char *out) {
  float colour[4];
  cs_wide_store(colour, rgba);
  uint32_t pixel = cs_srgb8_pixel(colour);
  memcpy(out, &pixel, sizeof pixel);
}

#endif

#endif
