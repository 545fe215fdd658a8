/* The colours of pixels, each by itself: the samples of the layers that vary, one over the other.
 *
 * Pixels are made in batches of CS_OVER_ROW_BATCH, layer by layer from the front. Programs of
 * gradients alone are read from a table (gradient_table.h); unchanged pictures alone take a shorter
 * way to the same bits (over_bare.h).
 */
#pragma once

#include "engine/paint/over_row.h"
#include "engine/paint/painter.h"
#include "engine/span/row.h"
#include "engine/span/run.h"

/* Premultiplied RGBA at the middles of a run's pixels: of a cell, and of a program by itself.
 * Errors: NO_MEMORY, and those of reading pictures and making defocused cels. */
CELSPAN_CHECKED celspan_status cs_painter_colours(cs_painter *painter, const cs_cell *cell,
                                                  cs_run run, float (*rgba)[4]);
CELSPAN_CHECKED celspan_status cs_painter_program_colours(cs_painter *painter,
                                                          const cs_program *program, cs_run run,
                                                          float (*rgba)[4]);
/* Says that the colours of a cell will be asked for in some parts of a run. */
void cs_painter_ahead(cs_painter *painter, const cs_cell *cell, cs_run run);

/* ---- for the rest of the room */

/* The same for a program whose items all show (shown.h). */
CELSPAN_CHECKED celspan_status cs_painter_shown_colours(cs_painter *painter,
                                                        const cs_program *program, cs_run run,
                                                        float (*rgba)[4]);
/* Appends them to a row: an array, or codes if it takes them. */
CELSPAN_CHECKED celspan_status cs_painter_pixels(cs_painter *painter, const cs_program *program,
                                                 cs_run run, cs_row *row);

CELSPAN_CHECKED celspan_status cs_painter_batch_colours(cs_painter *painter,
                                                        const cs_program *program,
                                                        const cs_batch *batch, float (*rgba)[4]);
/* The same as 8-bit sRGB, four bytes a pixel. */
CELSPAN_CHECKED celspan_status cs_painter_batch_codes(cs_painter *painter,
                                                      const cs_program *program,
                                                      const cs_batch *batch, unsigned char *codes);
/* Whether an item shows the samples of its picture unchanged: not faded, lit white, in no group,
 * and in front of every back light. */
bool cs_painter_is_bare(const cs_painter *painter, cs_item item);
/* Whether all items are such pictures, and paints of light, so that the program is a fold of
 * over_bare.h. */
bool cs_painter_are_bare(const cs_painter *painter, const cs_program *program);
