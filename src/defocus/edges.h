/* A Gaussian or an upright box over flat art: rows of boundaries, weighed along x, then lines of
 * them along y.
 *
 *   trace of a row --each piece, by the integral of the kernel--> its share in the lines above
 *   and below it --weights by distance--> rows of nodes
 *
 * A line stands on the edge between two rows and sees both through a tent, so that neither axis
 * shows where in its cell an edge lies. That rounds the kinks that a box of radius r leaves, by
 * 1/(12 r). The cost follows the pieces along x, and along y the nodes
 * that some piece comes near: blocks of columns that nothing reaches are one colour.
 */
#ifndef CS_DEFOCUS_EDGES_H
#define CS_DEFOCUS_EDGES_H

#include "base/wide.h"
#include "row/row.h"

typedef struct cs_defocus_edges {
  int32_t reach_x, reach_y; /* cells */
  float *shares;            /* by phase and column: of the kernel left of an edge */
  float *weights;           /* reach_y: of lines k + 1/2 rows away */
} cs_defocus_edges;

/* Softness in cells: a Gaussian, or a box along the axes. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_edges_init(celspan_context *context, const cs_blur *blur,
                                                     cs_defocus_edges *out);
void cs_defocus_edges_finish(cs_defocus_edges *edges, cs_memory *memory);
/* Fills the rows [first, end) of `columns` nodes each. scan: of the cells, of which reach_x columns
 * and reach_y rows lie before the first node's. Errors: of its rows. */
CELSPAN_CHECKED celspan_status cs_defocus_edges_fill(const cs_defocus_edges *edges,
                                                     cs_row_maker *maker, int32_t columns,
                                                     int32_t first, int32_t end, float (*nodes)[4]);

/* ---- soft_edges_wide.c */

/* The floats [first, end) of a row of nodes: sums over `pairs` pairs of lines, from the middle
 * outwards, by their weights. */
CS_WIDE_DECLARE(void, cs_defocus_edges_weigh,
                (const float *const *lines, const float *weights, int32_t pairs, int32_t first,
                 int32_t end, float *nodes));

#endif
