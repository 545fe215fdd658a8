/* How the pixels of a rostrum are made of what lies under them: the exact mean, the centre, or a
 * filter kernel.
 *
 * Invariants: a kernel's values are sampled when this is made, never later, so rows need no
 * function of the caller's; they sum to more than nothing. A filter of radius 0 is the mode NONE.
 */
#ifndef CS_SCENE_ANTIALIAS_H
#define CS_SCENE_ANTIALIAS_H

#include "base/context.h"
#include "base/hash.h"

#define CS_ANTIALIAS_SAMPLES 2048

typedef struct cs_antialias {
  celspan_antialias_mode mode;
  double radius;   /* FILTER: pixels, above 0 */
  int rows;        /* FILTER: pieces that a slanted boundary is cut into, a pixel */
  double *samples; /* FILTER: CS_ANTIALIAS_SAMPLES, in the middles of equal parts of the diameter */
} cs_antialias;

/* noun: for messages. Errors: NO_MEMORY, BAD_ARGUMENT; what the kernel's function returns. */
CELSPAN_CHECKED celspan_status cs_antialias_make(celspan_context *context, const char *noun,
                                                 celspan_antialias_mode mode,
                                                 const celspan_filter_desc *desc,
                                                 cs_antialias *out);
void cs_antialias_free(cs_antialias *antialias, cs_memory *memory);
void cs_antialias_hash(cs_hash *hash, const cs_antialias *antialias);

#endif
