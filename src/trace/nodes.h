/* Where the nodes of the borders lie, finer than corners of pixels.
 *
 *         \  /          each border that ends there is fitted by a line, from a little way off; the
 *          \/           node is where the sum of squares of its distances from all of them, and from
 *          |            the corner of the pixels by a lesser weight, is least
 *
 * INVARIANT: a node is less than CS_NODE_FAR from its corner, and on the picture's rim it stays on
 * it.
 */
#ifndef CS_TRACE_NODES_H
#define CS_TRACE_NODES_H

#include "trace/edge.h"

#define CS_NODE_FAR 0.7

/* places: one for each node. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_nodes_place(celspan_context *context, const cs_material *material,
                                              const cs_borders *borders, celspan_point *places);

#endif
