/* Runs of one defocused layer among flat ones, which is the usual defocused cel: its row is a
 * polyline already (sample/defocused.h), so every line becomes a span without evaluating the
 * program column by column.
 *
 *     value        v-----------v
 *       |        . :           :` .
 *       |      v'  :           :    ` . v ...     v: vertices of the row's polyline; their colours
 *       |      :   :           :        :         are seen through the flat layers before and
 *       +------+---+-----------+--------+---> x   behind, and each line between two of them
 *     spans    | 1 |     2     |    3   |         becomes a span: 1 and 3 gradients, 2 a single
 */
#ifndef CS_PAINT_DEFOCUSED_RUN_H
#define CS_PAINT_DEFOCUSED_RUN_H

#include "paint/painter.h"
#include "span/row.h"
#include "span/run.h"

/* Whether a program has one defocused layer and else flat ones; *item: which. */
bool cs_defocused_run_fits(const cs_stack *stack, const cs_program *program, uint32_t *item);
/* As cs_painter_run_program. */
CELSPAN_CHECKED celspan_status cs_defocused_run(cs_painter *painter, const cs_program *program,
                                                uint32_t item, cs_run run, cs_row *row);

#endif
