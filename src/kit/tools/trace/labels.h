/* Which colour each pixel has: a plane of labels, one byte a pixel, with a rim about the picture.
 *
 *      O O O O O O        O: outside
 *      O 0 0 1 1 O        0, 1, ..: places in the list of colours
 *      O 0 1 1 2 O        the count of colours: nothing, where alpha is below one half
 *      O O O O O O
 *
 * A pixel that an edge crosses is a mixture of the colours on both of its sides, in linear light,
 * and gets the one of which it has more. The plain pixels around it, and how well their mixture
 * explains it, decide which two these are: so no rim of a third colour appears between two.
 *
 * INVARIANT: a label is a function of the pixels within two of it.
 */
#pragma once

#include "tools/trace/colours.h"

#define CS_LABEL_OUTSIDE 255

typedef struct cs_labels {
  int32_t width, height;
  size_t stride;        /* width + 2 */
  unsigned char *plane; /* height + 2 rows */
} cs_labels;

/* -1 <= x <= width, and the same for y. */
static inline unsigned char *cs_labels_at(const cs_labels *labels, int32_t x, int32_t y) {
  return labels->plane + (size_t)(y + 1) * labels->stride + (size_t)(x + 1);
}

/* The share of b in a mixture of a and b: 0 at a, 1 at b, clamped. */
static inline float cs_labels_share(const cs_light4 *mixture, const cs_light4 *a,
                                    const cs_light4 *b) {
  float dot = 0, square = 0;
  for (int c = 0; c < 4; c++) {
    float way = b->c[c] - a->c[c];
    dot += (mixture->c[c] - a->c[c]) * way;
    square += way * way;
  }
  float share = square > 0 ? dot / square : 0;
  return share > 0 ? share < 1 ? share : 1 : 0;
}

/* Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_labels_make(celspan_context *context, const cs_scan *scan,
                                              const cs_colours *colours, cs_labels *out);
void cs_labels_finish(cs_labels *labels, celspan_context *context);

/* What is traced, together: the picture, its colours, and which of them each pixel has.
 *
 * Where four pixels meet in a point and only those across from each other are alike, one of the two
 * pairs is joined there, or none:
 *
 *      a | b         a | b          a | b        joins NW_SE: both a are one area, and the border
 *      --+--   -->     \      or     /           between a and b turns about each b
 *      b | a         b | a          b | a        joins NE_SW: both b are
 *
 * INVARIANT: what is joined in a point is a function of the pixels about it; regions.c and
 * borders.c both ask here, so that borders go around regions.
 */

typedef struct cs_material {
  const cs_scan *scan;
  const cs_colours *colours;
  cs_labels *labels;
  bool is_whole; /* hardly any pixel of a border is a mixture: see edge.h */
} cs_material;

typedef enum cs_join { CS_JOIN_NONE, CS_JOIN_NW_SE, CS_JOIN_NE_SW } cs_join;

/* How the four pixels around the corner (x, y) are joined, 0 <= x <= width, if no two neighbours
 * among them are equal. */
cs_join cs_material_join(const cs_material *material, int32_t x, int32_t y);
