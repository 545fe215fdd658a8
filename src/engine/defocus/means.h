/* Means over pixels, which shifted cels read (shifted.h).
 *
 *     plan --row--> spans: | single | array          | gradient |
 *                            ||       ||               ||
 *     band --row--> nodes: o o o o  o o o o o o o o   o o o o      one for each pixel
 *
 * A grid of a cel's own whose kernel is the pixel needs no more than its rows, pixel by pixel.
 */
#pragma once

#include "engine/row/row.h"

/* Fills the rows [first, end) of `columns` nodes each. maker: of the means. Errors: those of its
 * rows. */
CELSPAN_CHECKED celspan_status cs_means_fill(celspan_context *context, cs_row_maker *maker,
                                             int32_t columns, int32_t first, int32_t end,
                                             float (*nodes)[4]);
