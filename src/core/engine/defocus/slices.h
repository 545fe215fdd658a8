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
 * node is the same for all nodes, so the slices are found once, and one end of a slice is two sums
 * with a weight each. The sums of a row are kept by their place within a node's width, so that the
 * sums for neighbouring nodes are neighbours too, and many are read at a time:
 *
 *     factor 3, sums   0 1 2 3 4 5 6 7 8 ...     kept as   0 3 6 ...   1 4 7 ...   2 5 8 ...
 *
 * Where all samples under a tile are one colour, so are its nodes.
 */
#pragma once

#include "base/wide.h"
#include "engine/row/row.h"

/* The ends of a slice: the right one adds two sums, the left one subtracts two. */
typedef struct cs_defocus_slice {
  size_t add[2], subtract[2]; /* floats, from the first sum under the node */
  float add_weights[2], subtract_weights[2];
} cs_defocus_slice;

typedef struct cs_defocus_slices {
  int32_t factor;             /* samples in a node's width */
  int32_t extent_x, extent_y; /* samples beyond the node's own on each side */
  size_t places, stride; /* how many sums are kept for one place in a node's width, and for a row */
  CS_ARRAY(cs_defocus_slice, slices);
  size_t count;
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

/* ---- slices_wide.c */

/* nodes that are summed at once; counts are multiples of it */
#define CS_DEFOCUS_SLICES_TOGETHER 16

/* Sums up the slices for `count` nodes beside each other. sums: the first sum under the first
 * node. */
CS_WIDE_DECLARE(void, cs_defocus_slices_sum,
                (const cs_defocus_slice *slices, size_t slice_count, const float *sums,
                 int32_t count, float *nodes));
