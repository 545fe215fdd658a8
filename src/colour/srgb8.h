/* Arrays of colours to 8-bit pixels in sRGB, straight: the coding of nearly every frame.
 *
 * Invariant: a pixel is cs_srgb8_pixel of its colour, whichever instructions made it.
 */
#ifndef CS_COLOUR_SRGB8_H
#define CS_COLOUR_SRGB8_H

#include <stddef.h>

#include "base/wide.h"
#include "colour/transfer.h"

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

typedef void (*cs_srgb8)(const float *rgba, size_t count, unsigned char *out);
cs_srgb8 cs_srgb8_choose(cs_isa isa);

/* ---- srgb8_wide.c */

CS_WIDE_DECLARE(void, cs_srgb8_code, (const float *rgba, size_t count, unsigned char *out));

#endif
