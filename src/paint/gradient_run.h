/* Runs of one gradient without perspective: pieces end where its stops are, and how far a piece
 * bends is known without looking at its colours.
 */
#ifndef CS_PAINT_GRADIENT_RUN_H
#define CS_PAINT_GRADIENT_RUN_H

#include "paint/gradient_table.h"
#include "paint/painter.h"
#include "span/row.h"
#include "span/run.h"

/* Whether a table, or NULL, is of such a gradient. */
bool cs_gradient_run_fits(const cs_gradient_table *table);
/* Appends the spans of a run, as cs_lines_run. */
CELSPAN_CHECKED celspan_status cs_gradient_run(cs_painter *painter, const cs_gradient_table *table,
                                               cs_run run, cs_row *row);

#endif
