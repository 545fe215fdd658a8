/* Regions as shapes: closed paths, each made of the chains around its region.
 *
 *      +-------A-------+       region 1: A, then back along B
 *      |   1   |       |       region 2: B, then C
 *      +---+   B   2   C       B is the same curve in both, in opposite directions: so nothing shows
 *          |   |       |       through between them
 *      +---+---+-------+
 *
 * INVARIANT: every chain is in two paths, once in each direction, but for the picture's rim, which is
 * in one. So at every point of the picture the winding numbers of all paths add up to 1, wherever
 * the curves run, even across each other: some path is always there, and no light leaks between.
 */
#ifndef CS_TRACE_SHAPES_H
#define CS_TRACE_SHAPES_H

#include "trace/curves.h"
#include "trace/result.h"

/* Adds a shape for each region that has a colour, the largest first. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_shapes_make(celspan_context *context, const cs_material *material,
                                              const cs_regions *regions, const cs_borders *borders,
                                              const cs_curves *curves, celspan_trace *out);

#endif
