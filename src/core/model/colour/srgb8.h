/* A colour as an 8-bit pixel in sRGB with straight alpha, and back. Nearly every frame is coded in
 * this way, by the loops of srgb8_lanes.h. */
#pragma once

#include <stddef.h>

#include "model/colour/transfer.h"

/* A number from 0 to 1 as a number from 0 to 255, rounded half up: the product is exact. NaN
 * becomes 0. */
static inline uint32_t cs_srgb8_byte(float x) {
  return !(x > 0) ? 0 : x >= 1 ? 255 : (uint32_t)((double)x * 255 + 0.5);
}

static inline uint32_t cs_srgb8_channel(float x, bool is_coded) {
  return is_coded ? cs_srgb8_byte(x) : cs_transfer_srgb8(x);
}

/* One premultiplied colour as a pixel, red in the lowest byte. is_coded: its numbers are codes, and
 * linear otherwise. */
static inline uint32_t cs_srgb8_pixel_of(const float rgba[4], bool is_coded) {
  float r = rgba[0], g = rgba[1], b = rgba[2], alpha = rgba[3];
  if (!(alpha > 0))
    return 0;
  if (alpha != 1) {
    r /= alpha;
    g /= alpha;
    b /= alpha;
  }
  return cs_srgb8_channel(r, is_coded) | cs_srgb8_channel(g, is_coded) << 8 |
         cs_srgb8_channel(b, is_coded) << 16 | cs_srgb8_byte(alpha) << 24;
}

static inline uint32_t cs_srgb8_pixel(const float rgba[4]) {
  return cs_srgb8_pixel_of(rgba, false);
}

/* The light of every code. */
typedef struct cs_srgb8_curve {
  float light[256];
  unsigned char bytes[4][256]; /* the four bytes of the floats, the lowest first */
} cs_srgb8_curve;

void cs_srgb8_make_curve(cs_srgb8_curve *out);

/* The premultiplied linear colour of a pixel. */
static inline void cs_srgb8_colour(const cs_srgb8_curve *curve, const unsigned char pixel[4],
                                   float rgba[4]) {
  float alpha = (float)pixel[3] * (1.0f / 255);
  for (int c = 0; c < 3; c++)
    rgba[c] = curve->light[pixel[c]] * alpha;
  rgba[3] = alpha;
}
