/* The door of every sink that writes a file: what a caller may do with it, in which order.
 *
 *   create --> begin --> row 0, row 1, ... row height-1 --> end(OK)         the file is complete
 *      |         |          |
 *      +---------+----------+-- a call out of order, spans that do not cover the row, a failure:
 *                               every later call is refused, and end leaves nothing
 *
 * INVARIANT: the sink behind the door gets calls in this order alone: one begin with a size of 1 to
 * 1,048,576 pixels a side, rows whose spans cover them without gap, and an end whose outcome is OK
 * only if all rows were put. So no format asks for this again.
 */
#ifndef CS_OUTPUT_GUARD_H
#define CS_OUTPUT_GUARD_H

#include "base/context.h"

/* Puts a guard in front of *sink. path: for messages; copied. On failure *sink is discarded.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_guard_sink(celspan_context *context, const char *path,
                                             celspan_sink *sink);
/* The sink behind a guard, whose rows come in shares from now on; of another sink that sink itself. */
const celspan_sink *cs_guard_open(const celspan_sink *sink);

#endif
