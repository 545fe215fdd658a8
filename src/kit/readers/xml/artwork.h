/* The art module for a context: loaded on first use, so a film without drawings and type pays
 * nothing for it. */
#pragma once

#include "inside/context.h"
#include "readers/xml/module.h"

/* purpose: for the message if there is no module, such as "reading SVG". Errors: INPUT, NO_MEMORY.
 * Any thread. */
CELSPAN_CHECKED celspan_status cs_artwork_module(celspan_context *context, const char *purpose,
                                                 const cs_art_module **out);
