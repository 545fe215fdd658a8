/* The colours of a tracing: found in the picture, or given.
 *
 *   pixels that are like those left of them and above --> 32,768 bins of colour
 *     --> the fullest bin; then, one after the other, what lies farthest from all that are chosen
 *     --> k-means in Oklab, in which distances are what people see
 *     --> the mean about the fullest bin of each group: of a flat drawing, its colours exactly
 *
 * Edges between two colours are mixtures of both and no colours of their own: so only flat places
 * are asked, unless there are hardly any, or the picture has no more colours than are wanted.
 *
 * INVARIANT: the result is a function of the pixels alone. The colours differ from each other, and
 * the one that most flat pixels have comes first; given colours keep their order.
 */
#pragma once

#include "inside/colour.h"
#include "inside/pictures.h"

/* The picture that is traced, in memory: 8-bit sRGB codes with straight alpha, four bytes a pixel,
 * and the light that they mean.
 *
 *   file or surface --pictures/load.h--> blocks of 64 x 64 --> rows of codes, top to bottom
 *
 * INVARIANT: 1 <= width, height and width * height <= CS_SCAN_MOST, so that places of pixels, and
 * of the corners between them, fit into 32 bits.
 */

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

/* Errors: those of pictures; LIMIT. After a failure nothing must be finished. */
CELSPAN_CHECKED celspan_status cs_scan_read(celspan_context *context, const cs_picture *picture,
                                            cs_scan *out);
void cs_scan_finish(cs_scan *scan, celspan_context *context);

#define CS_COLOURS_MOST 64

typedef struct cs_oklab {
  float L, a, b;
} cs_oklab;

typedef struct cs_flat_colour {
  unsigned char code[3]; /* sRGB */
  cs_light4 light;       /* alpha is 1 */
  cs_oklab lab;
} cs_flat_colour;

typedef struct cs_colours {
  size_t count;
  cs_flat_colour list[CS_COLOURS_MOST + 1]; /* the last one means nothing at all, alpha 0 */
} cs_colours;

cs_oklab cs_oklab_of(const float light[3]);
/* The square of the distance. */
static inline float cs_oklab_apart(cs_oklab a, cs_oklab b) {
  float L = a.L - b.L, u = a.a - b.a, v = a.b - b.b;
  return L * L + u * u + v * v;
}

/* Finds at most `wanted` colours, 1..CS_COLOURS_MOST; fewer if the picture has no more, and none if
 * it is clear. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_colours_find(celspan_context *context, const cs_scan *scan,
                                               size_t wanted, cs_colours *out);
/* codes: 3 bytes each. Errors: BAD_ARGUMENT if two are equal. */
CELSPAN_CHECKED celspan_status cs_colours_take(celspan_context *context, const cs_scan *scan,
                                               const unsigned char *codes, size_t count,
                                               cs_colours *out);
