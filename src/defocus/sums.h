/* A Gaussian over cells, for cels that hold pictures and gradients: these vary between the
 * boundaries, so that cells must be summed.
 *
 * The cells are finer than the nodes' by an odd factor, so that a node stands in the middle of one;
 * there a picture shows one sample. Stretches in which the rows are one colour are not summed.
 */
#ifndef CS_DEFOCUS_SUMS_H
#define CS_DEFOCUS_SUMS_H

#include "row/row.h"

typedef struct cs_defocus_sums {
  int32_t factor;           /* cells in a node's width */
  int32_t reach_x, reach_y; /* cells beyond the node's on each side */
  float *weights[2];        /* by distance, reach_x + 1 and reach_y + 1 of them */
} cs_defocus_sums;

/* Radii of two deviations, in nodes' widths. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_sums_init(celspan_context *context, double radius_x,
                                                    double radius_y, cs_defocus_sums *out);
void cs_defocus_sums_finish(cs_defocus_sums *sums, cs_memory *memory);
/* Fills the rows [first, end) of `columns` nodes each. scan: of the cells. Errors: of its rows. */
CELSPAN_CHECKED celspan_status cs_defocus_sums_fill(const cs_defocus_sums *sums,
                                                    cs_row_maker *maker, int32_t columns,
                                                    int32_t first, int32_t end, float (*nodes)[4]);

#endif
