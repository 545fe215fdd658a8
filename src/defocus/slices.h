/* Even kernels (disc, box) over samples, for cels with pictures or gradients. These vary between
 * the boundaries, so samples must be summed.
 *
 *            .------.
 *          .'        '.             The part of the kernel (here a disc) that lies over one row of
 *   ------|------------|------      samples is a slice. The sum of the samples under a slice is the
 *         |////////////|       row  difference of two prefix sums along the row:
 *   ------|------------|------
 *         |'.        .'|                sums[to] - sums[from]
 *         |  '------'  |
 *        from          to
 *
 * The samples are finer than the nodes by a whole factor. The position of a slice relative to its
 * node is the same for all nodes, so the slices are found once.
 */
#ifndef CS_DEFOCUS_SLICES_H
#define CS_DEFOCUS_SLICES_H

#include "row/row.h"

typedef struct cs_defocus_slice {
  int32_t row;                /* from the first row of samples under a node */
  int32_t from, to;           /* samples in which the ends lie, from the first one under a node */
  float from_share, to_share; /* how far the ends lie into these samples, 0..1 */
  float weight;               /* of each sample between the ends */
} cs_defocus_slice;

typedef struct cs_defocus_slices {
  int32_t factor;             /* samples in a node's width */
  int32_t extent_x, extent_y; /* samples beyond the node's own on each side */
  cs_defocus_slice *slices;
  size_t count, capacity;
} cs_defocus_slices;

/* blur: in nodes' widths. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_slices_init(celspan_context *context, const cs_blur *blur,
                                                      cs_defocus_slices *out);
void cs_defocus_slices_finish(cs_defocus_slices *slices, cs_memory *memory);
/* Fills the rows [first, end) of `columns` nodes each. maker: of the samples. Errors: those of its
 * rows. */
CELSPAN_CHECKED celspan_status cs_defocus_slices_fill(const cs_defocus_slices *slices,
                                                      cs_row_maker *maker, int32_t columns,
                                                      int32_t first, int32_t end,
                                                      float (*nodes)[4]);

#endif
