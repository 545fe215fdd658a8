/* Other places where a file was looked for: whoever searches for a file notes them in the context,
 * and the message about the missing file then names them.
 */
#pragma once

#include "base/context.h"

/* Notes that the file is neither at `path`, where it is opened next, nor at `tried`. Both are
 * copied. The latest notes are kept; without memory nothing is noted. One thread. */
void cs_tried_note(celspan_context *context, const char *path, const char *tried);
/* The other place where the file was searched for; NULL: none is known. It is valid until the next
 * note. */
const char *cs_tried_find(const celspan_context *context, const char *path);
