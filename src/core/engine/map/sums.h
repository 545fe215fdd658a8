/* Rows of one map: sums of the changes at its borders.
 *
 *      border             pixel p           p + 1
 *                   +-----------/-----+-----------------+     right of a border the colour changes
 *                   |          /######|#################|     by right - left, in the area that is
 *                   |   left  / right |#################|     marked: pixel p gets that times its
 *                   |        /########|#################|     area, and all that are right of it
 *                   +-------/---------+-----------------+     that times the border's height
 *
 * What is kept of a pixel is by how much it exceeds the one on its left: a border adds its area to
 * pixel p, and the rest of its height to p + 1. The rows of a swath are summed together (adding.h),
 * and read one after the other (reading.h). The sums are floats, whatever the light and the sink: a
 * step of colour has 24 bits, and no error is carried on beyond the next whole pixel.
 *
 * The keys of cells are summed, too, in integers and with the same areas. Where such a sum is the
 * key of a cell times a whole pixel, nothing else is in the pixel: its colour is then
 * that of the cell to the bit, and nothing of the sum so far is carried on. A pixel in which there
 * is more than one cell is broken.
 *
 * Cells that vary are clear in these sums. Their areas are summed cell by cell instead, and their
 * visible parts are painted (brush.h): as a share of the cell's own colour in that pixel, so that
 * nothing leaks between a gradient and its neighbour.
 *
 * Invariant: the rows are a function of the drawing and their numbers: borders are added in the
 * order that the map has, whichever rows were made before.
 */
#pragma once

#include "engine/map/swath.h"

CELSPAN_CHECKED celspan_status cs_map_sums_init(celspan_context *context, int32_t width,
                                                cs_map_sums *out);
void cs_map_sums_finish(cs_map_sums *sums, cs_memory *memory);

void cs_map_rows_finish(cs_map_rows *rows, cs_memory *memory);
/* Makes the rows of the swath that begins with `row`. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_rows_make(celspan_context *context, cs_map_sums *sums,
                                                cs_map_rows *rows, int32_t row);
/* Leaves the rows as sums, to be read one by one; rows that are not read are cleared when the next
 * swath is made. Nothing in the drawing varies. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_rows_sum(celspan_context *context, cs_map_sums *sums,
                                               cs_map_rows *rows, int32_t row);
