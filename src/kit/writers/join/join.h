/* Joins strips (output/sinks/strip.h) to their picture, without unpacking a pixel.
 *
 *   every part: open, inspect --> do they follow one another? --> every part: open, inspect, add
 *
 * Joined parts of Targa and span files have the bytes of a file that was written as a whole; joined
 * parts of PNG have only its pixels, because their first rows are filtered differently.
 *
 * INVARIANT: the file appears whole or not at all (output/sinks/file.h), and only from parts that
 * are one picture from its first row to its last. Memory does not depend on the contents of the
 * parts. Unfinished files of this name that nobody writes any more are removed.
 */
#pragma once

#include "inside/context.h"

/* paths: of the parts, from top to bottom. Errors: INPUT for a part that is missing, damaged, no
 * strip or out of order; BAD_ARGUMENT if the output's ending belongs to another format, or if the
 * output is one of the parts; OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_join(celspan_context *context, const char *const *paths,
                                       size_t count, const char *output);
