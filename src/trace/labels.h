/* Which colour each pixel has: a plane of labels, one byte a pixel, with a rim about the picture.
 *
 *      O O O O O O        O: outside
 *      O 0 0 1 1 O        0, 1, ..: places in the list of colours
 *      O 0 1 1 2 O        the count of colours: nothing, where alpha is below one half
 *      O O O O O O
 *
 * A pixel that an edge crosses is a mixture of the colours on both of its sides, in linear light,
 * and gets that of which it has more. Which two they are is told by the plain pixels about it and by
 * how well their mixture explains it: so no rim of a third colour comes about between two.
 *
 * INVARIANT: a label is a function of the pixels within two of it.
 */
#ifndef CS_TRACE_LABELS_H
#define CS_TRACE_LABELS_H

#include "trace/colours.h"

#define CS_LABEL_OUTSIDE 255

typedef struct cs_labels {
  int32_t width, height;
  size_t stride;        /* width + 2 */
  unsigned char *plane; /* height + 2 rows */
} cs_labels;

/* -1 <= x <= width, and y likewise. */
static inline unsigned char *cs_labels_at(const cs_labels *labels, int32_t x, int32_t y) {
  return labels->plane + (size_t)(y + 1) * labels->stride + (size_t)(x + 1);
}

/* How much of b there is in a mixture of a and b: 0 at a, 1 at b, held to that. */
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

#endif
