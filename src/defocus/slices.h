/* Even kernels (disc, box) over cells, for cels that hold pictures and gradients: these vary
 * between the boundaries, so that cells must be summed.
 *
 * The cells are finer than the nodes' by a whole factor; the kernel is cut into slices, one a row
 * of cells, each summed as the difference of two prefix sums. What a slice adds to a node depends
 * on the slice alone, so the slices are found once.
 */
#ifndef CS_DEFOCUS_SLICES_H
#define CS_DEFOCUS_SLICES_H

#include "row/row.h"

typedef struct cs_defocus_slice {
  int32_t row;                /* from the first row of cells under a node */
  int32_t from, to;           /* cells from the first under a node: the ends, */
  float from_share, to_share; /* and how far into them */
  float weight;               /* of the cells between, each */
} cs_defocus_slice;

typedef struct cs_defocus_slices {
  int32_t factor;           /* cells in a node's width */
  int32_t reach_x, reach_y; /* cells beyond the node's on each side */
  cs_defocus_slice *slices;
  size_t count, capacity;
} cs_defocus_slices;

/* blur: in nodes' widths. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_slices_init(celspan_context *context, const cs_blur *blur,
                                                      cs_defocus_slices *out);
void cs_defocus_slices_finish(cs_defocus_slices *slices, cs_memory *memory);
/* Fills the rows [first, end) of `columns` nodes each. scan: of the cells. Errors: of its rows. */
CELSPAN_CHECKED celspan_status cs_defocus_slices_fill(const cs_defocus_slices *slices,
                                                      cs_row_maker *maker, int32_t columns,
                                                      int32_t first, int32_t end,
                                                      float (*nodes)[4]);

#endif
