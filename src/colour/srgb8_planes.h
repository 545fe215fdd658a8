/* 8-bit sRGB of sixteen pixels, of which every register holds one channel: for kernels
 * (base/wide.h). Where there is no AVX-512 there are no planes.
 *
 * Invariant: a pixel is cs_srgb8_pixel of its colour, whichever instructions made it.
 */
#ifndef CS_COLOUR_SRGB8_PLANES_H
#define CS_COLOUR_SRGB8_PLANES_H

#include "colour/srgb8_curve.h"

#include <stdbool.h>

#ifdef __AVX512F__

/* Sixteen pixels: red, green, blue, alpha. */
typedef struct cs_srgb8_planes {
  cs_wide channels[4];
} cs_srgb8_planes;

/* Codes again, exactly, the pixels that have an unsure lane (a set bit). */
static inline cs_wide_int cs_srgb8_settle_planes(const cs_srgb8_planes *colours, unsigned unsure,
                                                 cs_wide_int pixels) {
  for (int k = 0; k < CS_WIDE_LANES; k++, unsure >>= 1) {
    const float rgba[4] = {colours->channels[0][k], colours->channels[1][k],
                           colours->channels[2][k], colours->channels[3][k]};
    if (unsure & 1)
      pixels[k] = (int32_t)cs_srgb8_pixel(rgba);
  }
  return pixels;
}

/* One pixel a lane. If all alpha is 1, the usual case, there is no division. */
static inline cs_wide_int cs_srgb8_code_planes(const cs_srgb8_planes *colours) {
  const cs_wide one = cs_wide_all(1), slope = cs_wide_all(255 * 12.92f);
  const cs_wide knee = cs_wide_all(0.0031308f);
  const cs_wide_int none = {0};
  cs_wide alpha = colours->channels[3];
  bool divides = cs_srgb8_differ((cs_wide_int)alpha, (cs_wide_int)one) != 0;
  cs_wide_int is_seen = alpha > 0, doubt = {0}, pixels = none + 255;
  if (divides) {
    pixels = cs_srgb8_round(cs_srgb8_clamped(alpha) * 255, &doubt);
    alpha = cs_wide_choose(is_seen, alpha, one);
  }
  for (int c = 2; c >= 0; c--) {
    cs_wide v = colours->channels[c];
    if (divides)
      v = cs_wide_choose(is_seen, v / alpha, (cs_wide){0});
    pixels = pixels << 8 | cs_srgb8_round(cs_srgb8_coded(cs_srgb8_clamped(v), slope, knee), &doubt);
  }
  unsigned unsure = cs_srgb8_differ(doubt, none);
  if (__builtin_expect(unsure != 0, 0))
    pixels = cs_srgb8_settle_planes(colours, unsure, pixels);
  return pixels;
}

#endif

#endif
