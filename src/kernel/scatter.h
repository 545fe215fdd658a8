/* Gathering: where the steps of the pieces under a kernel go, column by column (the first half of
 * a filtered row; convolve.h has the second).
 *
 *   gather.c            what is under a row: traces, pieces, looks
 *   gather_separable.c  a piece under a separable kernel
 *   gather_even.c       a piece under an even shape
 */
#ifndef CS_KERNEL_SCATTER_H
#define CS_KERNEL_SCATTER_H

#include "kernel/convolve_parts.h"

/* One row's worth of work. */
typedef struct cs_scatter {
  cs_convolve *convolve;
  celspan_context *context;
  double centre;                   /* of the row that is made */
  const cs_retained_row *retained; /* of the row that is read, */
  uint32_t row;                    /* its place among those under the kernel */
  int32_t *looks;                  /* of the trace's programs */
} cs_scatter;

/* Fills changes, values, slopes, shifts and passed events from the retained edges of `count` rows.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_scatter_rows(cs_convolve *convolve, cs_painter *painter,
                                               const cs_retained_row *const *retained_rows,
                                               size_t count, int32_t y);

/* ---- one edge, in scatter_separable.c and scatter_even.c */

CELSPAN_CHECKED celspan_status cs_scatter_separable(cs_scatter *g, const cs_retained_edge *piece);
CELSPAN_CHECKED celspan_status cs_scatter_even(cs_scatter *g, const cs_retained_edge *piece);

/* Something changes at column p. */
void cs_scatter_touch(cs_convolve *convolve, int32_t p);
/* From column p on, which is touched, `weight` more of what is seen is what lies right of the
 * piece: as a colour, */
void cs_scatter_step(cs_scatter *g, const cs_retained_edge *piece, int32_t p, double weight);
/* and as a program. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_scatter_shift(cs_scatter *g, const cs_retained_edge *piece,
                                                int32_t p, double weight);
/* The part of a piece between two heights; false: there is none. */
bool cs_scatter_cut(const cs_retained_edge *piece, double top, double foot, cs_retained_edge *out);

static inline bool cs_scatter_is_flat(const cs_retained_edge *piece) {
  return piece->left.program < 0 && piece->right.program < 0;
}

#endif
