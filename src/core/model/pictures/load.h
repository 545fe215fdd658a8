/* Makes the blocks that are not in the store: from the file or surface, or from the level below.
 *
 * INVARIANT: a block is read by one thread at a time, under its entry's `reading`; others that want
 * a block of the same picture wait for it.
 */
#pragma once

#include "model/pictures/store.h"

/* Block (column, row) of a level, with a pin, until cs_store_release.
 * Errors: INPUT, LIMIT, NO_MEMORY, CALLBACK. */
CELSPAN_CHECKED celspan_status cs_load_block(celspan_context *context, const cs_picture *picture,
                                             int level, int32_t column, int32_t row,
                                             cs_picture_block **out);
