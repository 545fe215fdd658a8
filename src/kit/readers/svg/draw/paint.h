/* The object of a basic shape or a path: its outline, filled. */
#pragma once

#include "inside/geometry.h"
#include "readers/svg/document/reading.h"

/* *out: new, in the drawing's units; NULL for nothing. */
CELSPAN_CHECKED celspan_status cs_svg_fill(cs_svg_reading *reading, const cs_svg_node *node,
                                           const cs_svg_place *place, celspan_object **out);

/* Fills an outline in the user units of `place`. The result owns the outline where it is drawn.
 * box: for gradients whose units are shares of a box; NULL: the box of the outline. */
CELSPAN_CHECKED celspan_status cs_svg_fill_outline(cs_svg_reading *reading, const cs_svg_node *node,
                                                   const cs_svg_place *place, cs_outline *outline,
                                                   const celspan_box *box, celspan_object **out);
