/* Antialias "area" in busy rows: the exact mean of a row over each of its pixels, from units.
 *
 *     chains --descent.h--> units --columns.h--> lists by column --the walk--> spans
 *
 *          a \         b |   / c            the walk goes from one touched column to the next:
 *             \          |  /
 *     |    |   |\   |    |//|    |    |
 *       gap  one  one gap several gap       gap       the cell at the state of the composer
 *                                           one       two cells, mixed by the exact area
 *                                           several   the mixer (mixer.h)
 *
 * The composer's state is that at the top of the row, to the right of all units that have been
 * passed.
 *
 * Invariant: as in area.h, the mean is of composed colour, and depends on the plan and the row's
 * number alone.
 */
#ifndef CS_BUSY_BUSY_H
#define CS_BUSY_BUSY_H

#include "area/row_tools.h"
#include "busy/columns.h"
#include "busy/descent.h"
#include "busy/mixer.h"
#include "span/row_writer.h"

typedef struct cs_busy {
  cs_row_tools tools; /* borrowed; the cells and boundaries in order are not used */
  cs_descent descent;
  cs_columns columns; /* without storage until the first row */
  cs_mixer mixer;
} cs_busy;

void cs_busy_init(cs_busy *busy, const cs_row_tools *tools, const cs_boundary_set *set);
void cs_busy_finish(cs_busy *busy, cs_memory *memory);
/* Row y. The composer is at the left end of the row, and there again when it returns; after a
 * failure it may be anywhere. out: is empty, gets [0, width).
 * Errors: NO_MEMORY, INPUT, LIMIT; what composing meets is in composer->failure. */
CELSPAN_CHECKED celspan_status cs_busy_row(cs_busy *busy, int32_t y, cs_row *out);

#endif
