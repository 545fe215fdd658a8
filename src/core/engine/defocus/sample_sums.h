/* A Gaussian over samples, for cels with pictures or gradients. These vary between the
 * boundaries, so samples must be summed.
 *
 *       . . . . . . . . .     samples: finer than the nodes by an odd factor (here 3), so that a
 *       . o . . o . . o .     node lies in the middle of a sample (o), where a picture shows one of
 *       . . . . . . . . .     its own
 *       . . . . . . . . .
 *       . o . . o . . o .     first along the rows, at the columns of the nodes; then along the
 *       . . . . . . . . .     columns, at the rows of the nodes
 *
 * A row's samples are kept by their place within a node's width (as in slices.h), so that the
 * samples that neighbouring nodes need are neighbours too, and are read many at a time. Stretches
 * in which all rows are one colour are not summed.
 *
 * To sharpen, a node is its own sample plus a multiple of its difference from the Gaussian, which
 * is weighted by alpha: what lies around the cel does not count.
 */
#pragma once

#include "base/wide.h"
#include "engine/row/row.h"

/* Two values that are equally far from the middle one, and their weight. */
typedef struct cs_defocus_pair {
  size_t before, after; /* floats from the first value */
  float weight;
} cs_defocus_pair;

typedef struct cs_defocus_sums {
  bool sharpens;              /* the nodes are sharpened samples; the factor is 1 */
  float amount;               /* how often the difference is added to what is shown */
  int32_t factor;             /* samples in a node's width */
  int32_t extent_x, extent_y; /* samples beyond the node's own on each side */
  size_t places;              /* samples of a row that are kept for one place in a node's width */
  CS_ARRAY(float, weights_x); /* by distance: extent_x + 1 of them */
  CS_ARRAY(float, weights_y); /* the same: extent_y + 1 of them */
  CS_ARRAY(cs_defocus_pair, across); /* extent_x of them, from the outermost to the innermost */
  CS_ARRAY(cs_defocus_pair, down);   /* extent_y of them */
} cs_defocus_sums;

/* radius_x, radius_y: two standard deviations, in nodes' widths. samples: in the lesser radius, at
 * least. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_sums_init(celspan_context *context, double radius_x,
                                                    double radius_y, double samples,
                                                    cs_defocus_sums *out);
void cs_defocus_sums_finish(cs_defocus_sums *sums, cs_memory *memory);
/* Fills the rows [first, end) of `columns` nodes each. maker: of the samples of a plane. Errors:
 * those of its rows. */
CELSPAN_CHECKED celspan_status cs_defocus_sums_fill(const cs_defocus_sums *sums,
                                                    cs_row_maker *maker, int plane, int32_t columns,
                                                    int32_t first, int32_t end, float (*nodes)[4]);

/* ---- sample_sums_wide.c */

#define CS_DEFOCUS_SUMS_TOGETHER 16 /* nodes that are summed at once; counts are multiples of it */

/* Weighted sums about `count` values beside each other. values: the first one from which the pairs
 * are counted; middle: from there to the first middle one, floats. */
CS_WIDE_DECLARE(void, cs_defocus_sums_about,
                (const cs_defocus_pair *pairs, int32_t pair_count, const float *values,
                 size_t middle, int32_t count, float *out));
