/* Other places where a file was looked for: whoever searches for a file notes them in the context,
 * and the message about the missing file then names them.
 */
#pragma once

#include "base/context.h"

/* The file is not at `path`, where it is opened next, nor at `tried`. Both: copied. The last of
 * these notes are kept; without memory there is none. One thread. */
void cs_tried_note(celspan_context *context, const char *path, const char *tried);
/* Where else the path was looked for; NULL: nowhere, or it is not known. It lives until the next
 * note. */
const char *cs_tried_find(const celspan_context *context, const char *path);
