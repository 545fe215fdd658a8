/* The rows of a swath, read from the sums of its pixels: loops for every set of instructions.
 *
 *   sums      .  .  s1 s2 .  .  s3 s4 s5 .     .: nothing was added
 *   spans     | c0 |p1|  c1    |p2|p3| c2      of what the sums so far add up to. c: a cell
 *
 * Invariant: the bits are the same whichever instructions read them.
 */
#pragma once

#include "engine/map/sheets.h"

/* The spans of all rows of the swath, whose sums are cleared. colours: of the cells. Errors:
 * NO_MEMORY. */
CS_WIDE_DECLARE(CELSPAN_CHECKED celspan_status, cs_map_read,
                (celspan_context * context, cs_map_sums *sums, const cs_v4 *colours,
                 cs_map_rows *rows));
/* Row k of the swath, as in a frame that shows only this sheet and in which nothing varies. The
 * sums of the row are cleared. out: empty, with room for all columns. */
CS_WIDE_DECLARE(void, cs_map_read_alone,
                (const cs_map_sums *sums, const cs_map_rows *rows, const cs_map_frame *frame,
                 size_t k, cs_row *out));
/* Clears the sums of row k. */
CS_WIDE_DECLARE(void, cs_map_clear_row, (const cs_map_sums *sums, size_t k));
