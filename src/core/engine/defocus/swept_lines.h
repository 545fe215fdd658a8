/* Lines of a defocused cel, swept downwards: the edges of each row, weighed along x, make lines,
 * and the lines around a row of nodes, weighed along y, make its nodes (edges.h has the weights).
 *
 *      group      0       1       2       3       4        eight columns each
 *      line  9 |       |       | ...../|....   |       |
 *      row   9 |       |       |     / |       |       |   an edge, and how far the kernel reaches
 *      line 10 |       |       |..../..|..     |       |   around it: groups 2 and 3 are near it,
 *      row  10 |       |       |   /   |       |       |   the others are even
 *      line 11 |       |       |.../...|.      |       |
 *
 * The cost along x follows the number of edges. Along y it follows the number of nodes that are
 * near some edge: where no edge is near a group in any of the lines under a node, the whole group
 * is one colour, and neither its lines nor its nodes are written. Its latest lines are written when
 * an edge comes near after all, and only then.
 *
 * Invariant: the nodes of a row are a function of the plan and the row's number.
 */
#pragma once

#include "base/vector.h"
#include "base/wide.h"
#include "engine/defocus/edges.h"
#include "engine/row/row.h"

typedef struct cs_defocus_lines cs_defocus_lines;

/* edges, maker: borrowed. maker: of the samples, extent_x columns and extent_y rows of them lie
 * before the samples of the first node. Errors: NO_MEMORY; *out must be freed then too. */
CELSPAN_CHECKED celspan_status cs_defocus_lines_create(const cs_defocus_edges *edges,
                                                       cs_row_maker *maker, int32_t columns,
                                                       cs_defocus_lines **out);
void cs_defocus_lines_free(cs_defocus_lines *lines);
/* The nodes of a row. The first call may ask for any row, each later call for the next row. even:
 * as in cs_defocused_nodes. Errors: those of the maker's rows. */
CELSPAN_CHECKED celspan_status cs_defocus_lines_row(cs_defocus_lines *lines, int32_t row,
                                                    float (*nodes)[4], bool *even);

/* ---- swept_lines_wide.c */

/* The values that a row adds to the line above it and to the line below it. */
typedef struct cs_defocus_halves {
  cs_v4 upper, lower;
} cs_defocus_halves;

typedef struct cs_defocus_passed {
  cs_v4d upper, lower;
} cs_defocus_passed;

/* The columns of a row while they are summed up. */
typedef struct cs_defocus_columns {
  CS_ARRAY(cs_defocus_halves, near); /* edges inside the kernel of the column */
  /* the steps of edges that are left of the kernel from this column on */
  CS_ARRAY(cs_defocus_passed, steps);
  CS_ARRAY(cs_v4, below); /* what the row above added to the line below it */
} cs_defocus_columns;

/* near[k] += share * step for k < count, where the share goes from low[k] to high[k] as t goes from
 * 0 to 1. shares: room for as many. */
CS_WIDE_DECLARE(void, cs_defocus_lines_spread,
                (const float *low, const float *high, float t, int32_t count, float *shares,
                 const cs_defocus_halves *step, cs_defocus_halves *near));
/* Fills the columns [first, end) of the line above the row, and of the part of the line below it.
 * sum: before the call, the sum of the steps left of `first`; after it, of the steps left of `end`.
 * near and steps are cleared. */
CS_WIDE_DECLARE(void, cs_defocus_lines_sum,
                (const cs_defocus_columns *columns, int32_t first, int32_t end,
                 cs_defocus_passed *sum, cs_v4 *line));
/* Fills the floats [first, end) of a row of nodes with weighed sums over `pairs` pairs of lines.
 * The pairs are given from the middle outwards: lines[2 k] and lines[2 k + 1] have weights[k]. */
CS_WIDE_DECLARE(void, cs_defocus_lines_weigh,
                (const float *const *lines, const float *weights, int32_t pairs, int32_t first,
                 int32_t end, float *nodes));
