/* Runs of one gradient without perspective: cut at its stops, and halved between them as far as its
 * geometry asks for, without comparing colours.
 *
 *     RADIAL, a row through the circles of its stops:
 *
 *              . - ~ ~ ~ - .
 *            '   . - ~ - .   '
 *     ------+---+----+----+---+------ row       cut where it meets a circle, and at the foot of
 *           '   '    |    '   '                 the centre, where the distance turns round
 *            ' .  '- o -'  . '
 *                 centre
 *
 *     LINEAR: where the row meets the lines of its stops
 */
#pragma once

#include "engine/paint/gradient_table.h"
#include "engine/paint/painter.h"
#include "engine/span/row.h"
#include "engine/span/run.h"

/* Whether the table belongs to such a gradient; false for NULL. */
bool cs_gradient_run_fits(const cs_gradient_table *table);
/* Appends the spans of a run, as cs_lines_run. */
CELSPAN_CHECKED celspan_status cs_gradient_run(cs_painter *painter, const cs_gradient_table *table,
                                               cs_run run, cs_row *row);
