/* What shows between boundaries: the cells of all windings that a sweep has found.
 *
 *     0 --a--- 1 --b--- 2      the composer goes along the tree of the windings, from parent to
 *     `---c--- 3               child by crossing one boundary, and back
 */
#pragma once

#include "engine/compose/composer.h"
#include "engine/events/events.h"
#include "engine/row/plan.h"

/* cell: that of the windings; its program is the composer's, and valid during this call. */
typedef celspan_status (*cs_events_visitor)(void *user, uint32_t windings, cs_composer *composer,
                                            const cs_cell *cell);

/* events: of the plan. Each number is visited once, 0 first. Errors: NO_MEMORY, those of composing
 * and of the visitor. */
CELSPAN_CHECKED celspan_status cs_events_visit(celspan_context *context, const cs_plan *plan,
                                               const cs_events *events, cs_events_visitor visitor,
                                               void *user);
