/* Patterns: from an element of the file to a texture for one shape.
 *
 *      contents --viewBox or patternContentUnits--> the pattern's units --patternTransform--> user
 *                                                   x, y, width, height: the box that repeats
 */
#pragma once

#include "readers/svg/painted.h"

/* As cs_svg_server_find, for a pattern. *is_missing: nothing is painted, since its box has no
 * size. Errors: NO_MEMORY; LIMIT for patterns too deep inside each other;
 * INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_pattern_make(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const cs_svg_painted *shape, bool *is_missing,
                                                   cs_svg_server *out);
