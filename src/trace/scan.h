/* The picture that is traced, in memory: 8-bit sRGB codes with straight alpha, four bytes a pixel,
 * and the light that they mean.
 *
 *   file or surface --pictures/load.h--> blocks of 64 x 64 --> rows of codes, top to bottom
 *
 * INVARIANT: 1 <= width, height and width * height <= CS_SCAN_MOST, so that places of pixels, and
 * of the corners between them, fit into 32 bits.
 */
#ifndef CS_TRACE_SCAN_H
#define CS_TRACE_SCAN_H

#include "colour/srgb8.h"
#include "pictures/picture.h"

/* Pixels of a picture at most: 16,384 x 16,384. */
#define CS_SCAN_MOST 268435456

typedef struct cs_scan {
  int32_t width, height;
  unsigned char *codes; /* RGBA, row-major */
  bool has_clear;       /* a pixel has an alpha below 1 */
  cs_srgb8_curve curve;
} cs_scan;

/* Premultiplied linear light: r, g, b, alpha. */
typedef struct cs_light4 {
  float c[4];
} cs_light4;

static inline const unsigned char *cs_scan_at(const cs_scan *scan, int32_t x, int32_t y) {
  return scan->codes + 4 * ((size_t)y * (size_t)scan->width + (size_t)x);
}

static inline cs_light4 cs_scan_light(const cs_scan *scan, int32_t x, int32_t y) {
  cs_light4 light;
  cs_srgb8_colour(&scan->curve, cs_scan_at(scan, x, y), light.c);
  return light;
}

/* Errors: those of pictures; LIMIT. On failure there is nothing to finish. */
CELSPAN_CHECKED celspan_status cs_scan_read(celspan_context *context, const cs_picture *picture,
                                            cs_scan *out);
void cs_scan_finish(cs_scan *scan, celspan_context *context);

#endif
