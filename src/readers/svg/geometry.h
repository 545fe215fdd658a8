/* Places and sizes that styles give: x, y, cx, cy, width, height, r, rx, ry and d. */
#pragma once

#include "readers/svg/cascade.h"

/* Writes the values of styles into the attributes of the elements that have such a property, so
 * that all other code reads only attributes. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_svg_geometry_apply(celspan_context *context,
                                                     cs_svg_document *document, uint64_t *tests);
