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
#ifndef CS_TRACE_COLOURS_H
#define CS_TRACE_COLOURS_H

#include "trace/scan.h"

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
  cs_flat_colour list[CS_COLOURS_MOST + 1]; /* the last one: nothing at all, alpha 0 */
} cs_colours;

cs_oklab cs_oklab_of(const float light[3]);
/* The square of the distance. */
static inline float cs_oklab_apart(cs_oklab a, cs_oklab b) {
  float L = a.L - b.L, u = a.a - b.a, v = a.b - b.b;
  return L * L + u * u + v * v;
}

/* Finds at most `wanted` colours, 1..CS_COLOURS_MOST; fewer where there are no more. None where the
 * picture is clear. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_colours_find(celspan_context *context, const cs_scan *scan,
                                               size_t wanted, cs_colours *out);
/* codes: 3 bytes each. Errors: BAD_ARGUMENT where two are the same. */
CELSPAN_CHECKED celspan_status cs_colours_take(celspan_context *context, const cs_scan *scan,
                                               const unsigned char *codes, size_t count,
                                               cs_colours *out);

#endif
