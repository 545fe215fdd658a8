/* Runs of one gradient without perspective: pieces end where its stops are, and how far a piece
 * bends is known without looking at its colours.
 */
#ifndef CS_PAINT_GRADIENT_RUN_H
#define CS_PAINT_GRADIENT_RUN_H

#include "paint/gradient_table.h"

/* Whether a palette, or NULL, is of such a gradient. */
bool cs_gradient_run_fits(const cs_gradient_table *palette);
/* Appends the spans of [x0, x1), as cs_lines_run. */
CELSPAN_CHECKED celspan_status cs_gradient_run(cs_composer *composer,
                                               const cs_gradient_table *palette, int32_t x0,
                                               int32_t x1, double y, cs_row *row);

#endif
