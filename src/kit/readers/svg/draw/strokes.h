/* The stroke of a basic shape or a path: an object of the engine's own strokes.
 *
 *   one colour:  the stroke itself
 *   gradient:    a rectangle in the gradient's units, clipped by the stroke
 */
#pragma once

#include "inside/geometry.h"
#include "readers/svg/document/reading.h"

bool cs_svg_is_stroked(const cs_svg_style *style);
/* *out: new, in the drawing's units; NULL for nothing. Errors: NO_MEMORY, LIMIT, INPUT. */
CELSPAN_CHECKED celspan_status cs_svg_stroke(cs_svg_reading *reading, const cs_svg_node *node,
                                             const cs_svg_place *place, celspan_object **out);
/* Strokes an outline of closed contours in the user units of `place`, which may be changed. box:
 * for gradients whose units are shares of a box; NULL: the box of the outline. */
CELSPAN_CHECKED celspan_status cs_svg_stroke_outline(cs_svg_reading *reading,
                                                     const cs_svg_node *node,
                                                     const cs_svg_place *place, cs_outline *outline,
                                                     const celspan_box *box, celspan_object **out);
