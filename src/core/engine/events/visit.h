/* Visible cells between boundaries: the cells of all windings that a sweep has found, and the parts
 * between different cells.
 *
 *     0 --a--- 1 --b--- 2      the composer goes along the tree of the windings, from parent to
 *     `---c--- 3               child by crossing one boundary, and back
 *
 *     parts of b   1|2  3|4  3|4  5|6      with windings on their sides, from the top
 *                  A|B  A|B  A|B  B|B      and with cells: one part, from the first to the third
 */
#pragma once

#include "engine/compose/composer.h"
#include "engine/events/events.h"
#include "engine/row/plan.h"

/* cell: the cell of certain windings; its program belongs to the composer and is valid during this
 * call. out: the number of the cell. */
typedef celspan_status (*cs_events_visitor)(void *user, cs_composer *composer, const cs_cell *cell,
                                            uint32_t *out);

/* Visits the cell of winding number 0, and then, once, the cell of each of the windings beside a
 * part, and reduces the parts to visible ones: a part with the same cell on both sides is removed,
 * and consecutive parts of a course between the same two cells become one. Then left and right of
 * parts are numbers of cells. events: of the plan. Errors: NO_MEMORY, those of composing and of the
 * visitor. */
CELSPAN_CHECKED celspan_status cs_events_show(celspan_context *context, const cs_plan *plan,
                                              cs_events *events, cs_events_visitor visitor,
                                              void *user);
