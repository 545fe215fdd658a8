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
 * 1/(12 r). Here are the tables; swept_lines.h sweeps the rows.
 */
#pragma once

#include "engine/kernel/kernel.h"

#define CS_DEFOCUS_EDGES_PHASES 64 /* positions of an edge in its column that are tabulated */

typedef struct cs_defocus_edges {
  int32_t extent_x, extent_y; /* samples that the kernel reaches to a side */
  /* by phase and by 2 extent_x + 2 columns: of the kernel right of an edge */
  CS_ARRAY(float, shares);
  CS_ARRAY(float, weights); /* extent_y of them: of lines k + 1/2 rows away */
} cs_defocus_edges;

/* blur: in samples; a Gaussian, or a box along the axes. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_defocus_edges_init(celspan_context *context, const cs_blur *blur,
                                                     cs_defocus_edges *out);
void cs_defocus_edges_finish(cs_defocus_edges *edges, cs_memory *memory);
