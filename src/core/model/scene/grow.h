/* Shapes grown by a width: all points in a shape or within that distance of it; or shrunk by it:
 * all points of a shape that are not within that distance of its outline. Paints do not count.
 *
 *     a primitive     the shape and a stroke along its outline        .-----------.
 *     a union         the union of what its operands grow to          |  .-----.  |
 *     an xor          the xor, and a stroke along all outlines        |  |     |  |
 *     intersections   of what the operands grow to                    |  '-----'  |
 *     a difference    what the first grows to, without what the       '-----------'
 *                     others shrink to
 *
 * An outline is present wherever its inner object is, grown. The outline of an outline with the
 * same joins, or of one with round joins, is made of that object, by both widths together, so that
 * outlines around each other do not multiply.
 *
 * INVARIANT: the result is a tree of vector shapes, exact at every size. Where the outlines of the
 * operands of an intersection or a difference cross, the result has the corner in which the grown
 * outlines meet; everywhere else it has the joins of strokes.
 */
#pragma once

#include "model/scene/scene.h"

typedef struct cs_grow {
  double width; /* in the units around the object; below 0 the shape shrinks */
  celspan_stroke_join join;
} cs_grow;

/* Whether the shape of an object alone decides where it is present: it contains no pictures,
 * mattes, keys, compositions (effects that blur are compositions) or procedures. */
bool cs_grow_is_vector(const celspan_object *object);

/* *out: a new object that is present where the grown or shrunk shape is, whatever its paint.
 * Errors: NO_MEMORY, LIMIT; BAD_ARGUMENT where an outline reaches the horizon of its
 * perspective. */
CELSPAN_CHECKED celspan_status cs_grow_object(celspan_context *context, celspan_object *object,
                                              const cs_grow *grow, celspan_object **out);

/* Notes for a new boolean that it is present where an object is present that was grown in this way.
 * Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_grow_note(celspan_context *context, celspan_object *boolean,
                                            celspan_object *object, const cs_grow *grow);
