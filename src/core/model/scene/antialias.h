/* How the pixels of a rostrum are made: the colour of a pixel is the exact mean over its area, the
 * colour at its centre, or a mean weighted by a filter kernel.
 *
 * Invariants: the values of a kernel are sampled at construction, so that making rows never calls a
 * function of the caller; their sum is not 0. A filter of radius 0 is the mode NONE.
 */
#pragma once

#include "base/context.h"
#include "base/hash.h"

#define CS_ANTIALIAS_SAMPLES 2048

typedef struct cs_antialias {
  celspan_antialias_mode mode;
  double radius; /* FILTER: pixels, above 0 */
  int rows; /* FILTER: the number of pieces into which a slanted boundary is cut in each pixel */
  double *samples; /* FILTER: the kernel in the middles of CS_ANTIALIAS_SAMPLES equal intervals */
} cs_antialias;

/* noun: for messages. Errors: NO_MEMORY, BAD_ARGUMENT, those of the kernel's function. */
CELSPAN_CHECKED celspan_status cs_antialias_make(celspan_context *context, const char *noun,
                                                 celspan_antialias_mode mode,
                                                 const celspan_filter_desc *desc,
                                                 cs_antialias *out);
/* A copy of its own. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_antialias_copy(celspan_context *context, const cs_antialias *from,
                                                 cs_antialias *out);
void cs_antialias_free(cs_antialias *antialias, cs_memory *memory);
void cs_antialias_hash(cs_hash *hash, const cs_antialias *antialias);
