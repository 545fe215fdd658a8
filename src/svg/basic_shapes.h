/* Clip paths that are written as shapes: circle(), ellipse(), inset() and polygon(). Lengths and shares
 * are those of the element's box without its stroke. Source: CSS Shapes Module Level 1, 3.1. */
#ifndef CS_SVG_BASIC_SHAPES_H
#define CS_SVG_BASIC_SHAPES_H

#include "svg/reading.h"

/* The shape that `text` writes, for an element at `place`. *out: new, in the drawing's units; NULL:
 * everything is cut away. *is_shape: false for what is no such shape. */
CELSPAN_CHECKED celspan_status cs_svg_basic_shape(cs_svg_reading *reading, const cs_svg_node *node,
                                                  const cs_svg_place *place, const char *text,
                                                  celspan_object **out, bool *is_shape);

#endif
