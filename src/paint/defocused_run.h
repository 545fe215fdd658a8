/* Spans of one soft layer among flat ones: the usual defocused cel, made from its nodes without
 * going through the program column by column. */
#ifndef CS_PAINT_DEFOCUSED_RUN_H
#define CS_PAINT_DEFOCUSED_RUN_H

#include "paint/painter.h"
#include "span/row.h"
#include "span/run.h"

/* Whether a program holds one soft layer and else flat ones; *item: which. */
bool cs_defocused_run_fits(const cs_stack *stack, const cs_program *program, uint32_t *item);
/* As cs_painter_run_program. */
CELSPAN_CHECKED celspan_status cs_defocused_run(cs_painter *painter, const cs_program *program,
                                                uint32_t item, cs_run run, cs_row *row);

#endif
