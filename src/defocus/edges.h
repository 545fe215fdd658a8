/* A Gaussian or an upright box over flat art: the edges of a row, weighed along x, make lines; the
 * lines, weighed along y, make nodes.
 *
 *             edge at x
 *      colour a  |  colour b
 *   -------------|----------------  line y       gets (1 - d) of the edge
 *         .      |  .        .      row y        d: the mean depth of the edge in the row, 0..1
 *   -------------|----------------  line y + 1   gets d of the edge
 *         ^         ^        ^
 *         columns: the edge changes a line by share * (b - a), where share is the integral of the
 *         column's kernel right of the edge, from a table by the place of the edge in its column
 *
 *   node = sum over k of weights[k] * (line k above the node's middle + line k below it)
 *
 * A line lies on the border between two rows and weighs both of them by a tent, so that neither
 * axis shows where inside a sample an edge lies. For a box of radius r this rounds its kinks by
 * 1/(12 r). The cost along x follows the number of edges. Along y it follows the number of nodes
 * that are near some edge: columns are treated in groups, and where no edge is near a group in any
 * of the lines under a node, the whole group is one colour.
 */
#ifndef CS_DEFOCUS_EDGES_H
#define CS_DEFOCUS_EDGES_H

#include "base/wide.h"
#include "row/row.h"

typedef struct cs_defocus_edges {
  int32_t extent_x, extent_y; /* of the kernel: samples */
  float *shares;              /* by phase and column: of the kernel right of an edge */
  float *weights;             /* extent_y of them: of lines k + 1/2 rows away */
} cs_defocus_edges;

/* blur: in samples; a Gaussian, or a box along the axes. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_edges_init(celspan_context *context, const cs_blur *blur,
                                                     cs_defocus_edges *out);
void cs_defocus_edges_finish(cs_defocus_edges *edges, cs_memory *memory);
/* Fills the rows [first, end) of `columns` nodes each. maker: of the samples, of which extent_x
 * columns and extent_y rows lie before those of the first node. Errors: those of its rows. */
CELSPAN_CHECKED celspan_status cs_defocus_edges_fill(const cs_defocus_edges *edges,
                                                     cs_row_maker *maker, int32_t columns,
                                                     int32_t first, int32_t end, float (*nodes)[4]);

/* ---- edges_wide.c */

/* Fills the floats [first, end) of a row of nodes with weighed sums over `pairs` pairs of lines.
 * The pairs are given from the middle outwards: lines[2 k] and lines[2 k + 1] have weights[k]. */
CS_WIDE_DECLARE(void, cs_defocus_edges_weigh,
                (const float *const *lines, const float *weights, int32_t pairs, int32_t first,
                 int32_t end, float *nodes));

#endif
