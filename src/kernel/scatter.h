/* Scattering: where the colour steps of the edges under a kernel go, column by column. It is the
 * first half of a filtered row; convolve.c is the second.
 *
 *      kernel of the pixel at column p       a retained edge, cut to the heights of the kernel and
 *          _____                             into segments so short that each may be upright
 *         /     \
 *      --|---p---|--------/------            columns whose kernel is left of it: nothing
 *         \_____/        /                   columns whose kernel it divides: a share of the step
 *                       /                    columns whose kernel is right of it: the whole step,
 *                                            which is a change at the first of them, and for signed
 *                                            kernels a passed event
 *
 *   scatter.c            finds the retained rows, edges and programs under a kernel
 *   scatter_separable.c  an edge under a separable kernel
 *   scatter_even.c       an edge under an even shape
 */
#ifndef CS_KERNEL_SCATTER_H
#define CS_KERNEL_SCATTER_H

#include "kernel/convolve_parts.h"

/* The work of one row. */
typedef struct cs_scatter {
  cs_convolve *convolve;
  celspan_context *context;
  double centre;                   /* height of the row that is made */
  const cs_retained_row *retained; /* the row that is read */
  uint32_t row;                    /* its place among those under the kernel */
  int32_t *terms;                  /* of the retained row's programs */
} cs_scatter;

/* Fills changes, values, slopes, shifts and passed events from the retained edges of `count` rows.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_scatter_rows(cs_convolve *convolve, cs_painter *painter,
                                               const cs_retained_row *const *retained_rows,
                                               size_t count, int32_t y);

/* ---- one edge, in scatter_separable.c and scatter_even.c */

CELSPAN_CHECKED celspan_status cs_scatter_separable(cs_scatter *g, const cs_retained_edge *edge);
CELSPAN_CHECKED celspan_status cs_scatter_even(cs_scatter *g, const cs_retained_edge *edge);

/* ---- for both */

/* Something changes at column p. */
void cs_scatter_touch(cs_convolve *convolve, int32_t p);
/* From column p on, which is touched, `weight` more of the sum is what lies right of the edge, and
 * so much less what lies left of it: as flat colours. */
void cs_scatter_step(cs_scatter *g, const cs_retained_edge *edge, int32_t p, double weight);
/* The same as programs. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_scatter_shift(cs_scatter *g, const cs_retained_edge *edge,
                                                int32_t p, double weight);
/* The part of an edge between two heights; false: there is none. */
bool cs_scatter_cut(const cs_retained_edge *edge, double top, double foot, cs_retained_edge *out);

static inline bool cs_scatter_is_flat(const cs_retained_edge *edge) {
  return edge->left.program < 0 && edge->right.program < 0;
}

#endif
