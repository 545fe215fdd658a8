/* Boxes around objects and cels for callers whose picture depends on them: gradients that are
 * spread over a box, places that scripts take from it. celspan_object_bounds and celspan_cel_bounds
 * are for callers that only leave out objects outside the box: the box is larger if memory runs
 * out.
 *
 *   +-------------+
 *   |   .--.      |  the outer box always contains the stroke; the inner one is tight and takes
 *   |  +----+     |  memory, because the outline of the stroke is made for it
 *   |  | // |     |
 *   |  +----+     |
 *   +-------------+
 *
 * INVARIANT: a box from here is tight, but not the box of cs_bounds_around.
 */
#pragma once

#include "model/scene/scene.h"

/* *is_there: whether there is something to paint; if not, *out is not set. Errors: NO_MEMORY.
 * Shared read. */
CELSPAN_CHECKED celspan_status cs_bounds_object(celspan_context *context,
                                                const celspan_object *object, bool *is_there,
                                                celspan_box *out);
CELSPAN_CHECKED celspan_status cs_bounds_cel(celspan_context *context, const celspan_cel *cel,
                                             bool *is_there, celspan_box *out);
/* Bounds of the objects of a cel, without the cel's own matrix, under a matrix. */
CELSPAN_CHECKED celspan_status cs_bounds_drawing(celspan_context *context, const celspan_cel *cel,
                                                 const celspan_matrix *matrix, bool *is_there,
                                                 celspan_box *out);
/* A box around objects under a matrix that is found quickly: from the boxes of their outlines, and
 * from the outer boxes of strokes. False if there is nothing to paint; *out is not set then. */
bool cs_bounds_around(celspan_object *const *objects, size_t count, const celspan_matrix *matrix,
                      celspan_box *out);
