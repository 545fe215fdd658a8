/* A colour as an 8-bit pixel in sRGB with straight alpha, and back. Nearly every frame is coded so,
 * in the loops of srgb8_lanes.h.
 */
#pragma once

#include <stddef.h>

#include "model/colour/transfer.h"

/* One premultiplied linear colour as a pixel, red in the lowest byte. */
static inline uint32_t cs_srgb8_pixel(const float rgba[4]) {
  float r = rgba[0], g = rgba[1], b = rgba[2], alpha = rgba[3];
  if (!(alpha > 0))
    return 0;
  if (alpha != 1) {
    r /= alpha;
    g /= alpha;
    b /= alpha;
  }
  /* Round half up; the product is exact. */
  uint32_t a = alpha >= 1 ? 255 : (uint32_t)((double)alpha * 255 + 0.5);
  return cs_transfer_srgb8(r) | (uint32_t)cs_transfer_srgb8(g) << 8 |
         (uint32_t)cs_transfer_srgb8(b) << 16 | a << 24;
}

/* The light of every code. */
typedef struct cs_srgb8_curve {
  float light[256];
  unsigned char bytes[4][256]; /* the four bytes of those floats, the lowest first */
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
