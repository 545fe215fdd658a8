/* The borders as lines and cubics: each chain fitted once, for both of its sides.
 *
 *      chain --edge.h--> points of the edge --corners.h--> parts between corners
 *            --fit.h--> pieces from node to node
 *
 * The rim of the picture stays as it is, and so do chains of few pixels, of which nothing is known
 * but their pixels.
 *
 * INVARIANT: chains that end in one node have the same point there, to the bit.
 */
#pragma once

#include "tools/trace/edge.h"
#include "tools/trace/fit.h"

/* Where the nodes of the borders lie, finer than corners of pixels.
 *
 *        \  /          each border that ends there is fitted by a line, from a little way off; the
 *         \/           node is where the sum of squares of its distances from all of them, and from
 *         |            the corner of the pixels by a lesser weight, is least
 *
 * INVARIANT: a node is less than CS_NODE_FAR from its corner, and on the picture's rim it stays on
 * it.
 */

#define CS_NODE_FAR 0.7

/* places: one for each node. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_nodes_place(celspan_context *context, const cs_material *material,
                                              const cs_borders *borders, celspan_point *places);

typedef struct cs_trace_curve {
  celspan_point start;
  size_t first, count; /* pieces */
} cs_trace_curve;

typedef struct cs_curves {
  cs_trace_curve *list; /* one for each chain */
  size_t count;
  cs_fit_pieces pieces;
} cs_curves;

/* smooth: 1 for a tolerance of 0.15 pixels, 2 for twice that, if pixels are mixed; 0: the borders
 * of the pixels themselves. Errors: NO_MEMORY. The result must be finished, also after a
 * failure. */
CELSPAN_CHECKED celspan_status cs_curves_make(celspan_context *context, const cs_material *material,
                                              const cs_borders *borders, double smooth,
                                              cs_curves *out);
void cs_curves_finish(cs_curves *curves, celspan_context *context);
