/* Recording a plane: the rows of a plan are swept, and its visible edges become borders of a plane
 * file (subprojects/planefile), which have curves and no size.
 *
 *   row y       \     edge of chain c, between two cells     \
 *   row y + 1    \    the same chain, the same cells          |  one border of chain c
 *   row y + 2     |                                          /
 *
 * A border continues where an edge of its chain begins at the height where it ends, between the
 * same cells. Its curve is the chain's, from the control points. What its edges say is where it
 * begins and ends: where something begins, ends, or crosses it. An edge that belongs to no chain,
 * or to one with a curve that a plane cannot have, is a line by itself.
 *
 * Borders need no order, so what several plans show is all of their borders, and cell 0 of the sum
 * has the colours of theirs together.
 *
 * Invariant: at any height, borders lead from the cell 0 of a plan to itself, as edges do.
 */
#pragma once

#include "engine/record/recording.h"
#include "engine/row/plan.h"

/* Begins a plane that is the sum of several plans; out: empty. Without it a plane is one plan. */
CELSPAN_CHECKED celspan_status cs_record_begin_sum(celspan_context *context, cs_recording *out);
/* Adds a plan of SIDE x SIDE pixels that keeps its curves, with all its colours times a weight.
 * out: empty, or a sum; must be finished whatever happens. Errors: NO_MEMORY; BAD_ARGUMENT for what
 * a plane cannot keep (programs.h); LIMIT. */
CELSPAN_CHECKED celspan_status cs_record_put_plan(celspan_context *context, const cs_plan *plan,
                                                  float weight, cs_recording *out);
void cs_record_finish(cs_recording *record, cs_memory *memory);
planefile_band cs_record_plane(const cs_recording *record);
