/* Recording a plane: the boundaries of a plan are swept by events (engine/events/events.h), and
 * the parts that can be seen (engine/events/visit.h) become borders of a plane file
 * (subprojects/planefile), which have curves and no size.
 *
 * The curve of a border is the chain's, from its control points; a chain with a curve that a plane
 * cannot have is a chain of lines.
 *
 * Borders need no order, so the sum of several plans is the list of all their borders, and cell 0
 * of the sum has the colours of their cells 0 together.
 *
 * Invariant: at any height, borders lead from the cell 0 of a plan to itself, as parts do.
 */
#pragma once

#include "inside/frames.h"
#include "writers/record/recording.h"

/* Begins a plane that is the sum of several plans; out: empty. Without this call, a plane is one
 * plan. */
CELSPAN_CHECKED celspan_status cs_record_begin_sum(celspan_context *context, cs_recording *out);
/* Adds a plan of SIDE x SIDE pixels that keeps its curves, with all its colours times a weight.
 * rounding: borrowed; colours are rounded to 8-bit codes, and areas with equal colours become one
 * cell; NULL: colours are not rounded. out: empty, or a sum; must be finished in any case. Errors:
 * NO_MEMORY; BAD_ARGUMENT for contents that a plane cannot keep (programs.h); LIMIT. */
CELSPAN_CHECKED celspan_status cs_record_put_plan(celspan_context *context, const cs_plan *plan,
                                                  float weight, const planefile_rounding *rounding,
                                                  cs_recording *out);
void cs_record_finish(cs_recording *record, cs_memory *memory);
/* Valid until the record changes. record->status says why its pictures could not be read. */
planefile_band cs_record_plane(cs_recording *record);
