/* The object of a basic shape or a path: its outline, filled. */
#ifndef CS_SVG_PAINT_H
#define CS_SVG_PAINT_H

#include "svg/reading.h"

/* *out: new, in the drawing's units; NULL for nothing. */
CELSPAN_CHECKED celspan_status cs_svg_fill(cs_svg_reading *reading, const cs_svg_node *node,
                                           const cs_svg_place *place, celspan_object **out);

#endif
