/* Clip paths, and other uses of elements as mere shapes: boolean objects in the drawing's units,
 * without paint.
 *
 *   clip path = union of its children, each inside its own clip path, inside the clip path's own
 */
#pragma once

#include "readers/svg/document/reading.h"

/* The shape of a child of a clip path or mask: of a shape or a text, directly or through `use`.
 * *out: new; NULL for nothing. place: of the parent. uses_fill_rule: the element's fill-rule
 * defines the inside, as in masks; else its clip-rule. style: the element's computed style. */
CELSPAN_CHECKED celspan_status cs_svg_shape_object(cs_svg_reading *reading, const cs_svg_node *node,
                                                   cs_svg_place place, bool uses_fill_rule,
                                                   celspan_object **out, cs_svg_style *style);

/* The clip path of an element at `place`. *out: new; NULL: everything is cut away. *is_clip: false
 * when the reference leads to no clip path, and nothing is cut. */
CELSPAN_CHECKED celspan_status cs_svg_clip_make(cs_svg_reading *reading, const cs_svg_node *node,
                                                const cs_svg_place *place, celspan_object **out,
                                                bool *is_clip);

/* The intersection of two objects. It releases both; NULL where either is NULL. */
CELSPAN_CHECKED celspan_status cs_svg_intersect(cs_svg_reading *reading, celspan_object *a,
                                                celspan_object *b, celspan_object **out);
