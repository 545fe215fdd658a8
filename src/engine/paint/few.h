/* The colours of a few pixels, each folded by itself (engine/compose/over.h).
 *
 *     window   |  | cell a / cell b |  |      a boundary crosses one or two pixels, and each cell
 *              |  |       /         |  |      is asked for its colour in them
 *
 * For a few pixels the states of whole batches (over_row.h) cost more than what is folded.
 *
 * Invariant: the arithmetic is that of over_row.h.
 */
#pragma once

#include "engine/paint/painter.h"
#include "engine/span/run.h"

#define CS_FEW_PIXELS 4

/* Whether all layers of a program are flat or defocused, at least one of them defocused, and no
 * defocused layer hides another one that has not been made yet. */
bool cs_few_fits(const cs_stack *stack, const cs_program *program);
/* Premultiplied RGBA of such a program at the middles of a run's pixels, at most CS_FEW_PIXELS.
 * Errors: NO_MEMORY, and those of making defocused cels. */
CELSPAN_CHECKED celspan_status cs_few_colours(cs_painter *painter, const cs_program *program,
                                              cs_run run, float (*rgba)[4]);
