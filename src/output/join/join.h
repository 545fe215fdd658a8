/* Strips (output/sinks/strip.h) to the picture that they are rows of, without unpacking a pixel.
 *
 *   every part: open, inspect --> do they follow one another? --> every part: open, inspect, add
 *
 * The parts of Targa and span files come to the bytes that the whole would have been written as;
 * those of PNG to its pixels, for their first rows are filtered otherwise.
 *
 * INVARIANT: the file appears whole or not at all (output/sinks/file.h), and only from parts that
 * are one picture from its first row to its last. Memory does not depend on the contents of the
 * parts. Unfinished files of this name that nobody writes any more are removed.
 */
#pragma once

#include "base/context.h"

/* paths: of the parts from the top down. Errors: INPUT for a part that is missing, damaged, no
 * strip or out of order; BAD_ARGUMENT for an output whose ending is of another format, or that is
 * one of the parts; OUTPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_join(celspan_context *context, const char *const *paths,
                                       size_t count, const char *output);
