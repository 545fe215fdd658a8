/* Gathering: where the steps of the pieces under a kernel go, column by column (the first half of
 * a filtered row; convolve.h has the second).
 *
 *   gather.c            what is under a row: traces, pieces, looks
 *   gather_separable.c  a piece under a separable kernel
 *   gather_even.c       a piece under an even shape
 */
#ifndef CS_FILTER_GATHER_H
#define CS_FILTER_GATHER_H

#include "filter/convolve.h"

/* One row's worth of work. */
typedef struct cs_gather {
  cs_convolve *convolve;
  celspan_context *context;
  double centre;         /* of the row that is made */
  const cs_trace *trace; /* of the row that is read, */
  uint32_t row;          /* its place among those under the kernel */
  int32_t *looks;        /* of the trace's programs */
} cs_gather;

CELSPAN_CHECKED celspan_status cs_gather_separable(cs_gather *g, const cs_trace_piece *piece);
CELSPAN_CHECKED celspan_status cs_gather_even(cs_gather *g, const cs_trace_piece *piece);

/* Something changes at column p. */
void cs_gather_touch(cs_convolve *convolve, int32_t p);
/* From column p on, which is touched, `weight` more of what is seen is what lies right of the
 * piece: as a colour, */
void cs_gather_step(cs_gather *g, const cs_trace_piece *piece, int32_t p, double weight);
/* and as a program. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_gather_shift(cs_gather *g, const cs_trace_piece *piece, int32_t p,
                                               double weight);
/* The part of a piece between two heights; false: there is none. */
bool cs_gather_cut(const cs_trace_piece *piece, double top, double foot, cs_trace_piece *out);

static inline bool cs_gather_is_flat(const cs_trace_piece *piece) {
  return piece->left.program < 0 && piece->right.program < 0;
}

#endif
