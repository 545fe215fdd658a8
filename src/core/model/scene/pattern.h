/* Patterns: art repeated over the plane, as a texture.
 *
 *     primitive in a pattern      a clip of two operands
 *       [ plane | shape ]         plane:  a rostrum of one box of the art, repeated over the bounds
 *                                         of the shape (cs_repeat)
 *                                 shape:  the primitive in opaque black
 *
 *     +-----+-----+-----+         A point of the plane shows what the point of the box does that
 *     | .'. | .'. | .'. |         lies a whole number of widths and heights away from it.
 *     +-----+-----+-----+
 *
 * Invariant: data with an outline keep it: cs_pattern_shape.
 */
#pragma once

#include "model/scene/scene.h"

/* As cs_primitive_data_wrap, for data of an outline, whose texture may be a pattern: the object is
 * the clip then. Errors: `status`, NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_pattern_wrap(celspan_context *context, cs_primitive_data *data,
                                               celspan_status status, celspan_object **out);
/* Repeats the plane of a pattern over the bounds of a shape that has changed, in the same units.
 * *plane is replaced. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_pattern_refill(celspan_context *context, celspan_object *shape,
                                                 celspan_object **plane);
/* The data of the outline: where `data` are filled with a pattern, the data of the filled shape;
 * otherwise `data`. */
const cs_primitive_data *cs_pattern_shape(const cs_primitive_data *data);
/* The point of the box that is shown at a point of the plane, in the rostrum's units. */
celspan_point cs_pattern_fold(const cs_repeat *repeat, celspan_point point);
