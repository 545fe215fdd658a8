/* Runs of one gradient without perspective: pieces end where its stops are, and how far a piece
 * bends is known without looking at its colours.
 */
#ifndef CS_COMPOSE_PALETTE_RUN_H
#define CS_COMPOSE_PALETTE_RUN_H

#include "compose/palette.h"

/* Whether a palette, or NULL, is of such a gradient. */
bool cs_palette_run_fits(const cs_palette *palette);
/* Appends the spans of [x0, x1), as cs_ramps_run. */
CELSPAN_CHECKED celspan_status cs_palette_run(cs_composer *composer, const cs_palette *palette,
                                              int32_t x0, int32_t x1, double y, cs_row *row);

#endif
