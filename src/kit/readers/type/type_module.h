/* The type module for a context: loaded on first use, so a film without drawings and type pays
 * nothing for it. */
#pragma once

#include "inside/context.h"
#include "readers/type/module.h"

/* purpose: for the message if there is no module, such as "reading SVG". Errors: INPUT, NO_MEMORY.
 * Any thread. */
CELSPAN_CHECKED celspan_status cs_type_module_load(celspan_context *context, const char *purpose,
                                                   const cs_type_module **out);
