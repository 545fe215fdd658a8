/* Boxes around objects and cels, as celspan_object_bounds and celspan_cel_bounds give them, for callers that
 * draw by them.
 *
 *   +-------------+
 *   |   .--.      |   the outer box always holds the stroke; the inner one is tight, and takes memory:
 *   |  +----+     |   the stroke's outline is made for it
 *   |  | // |     |
 *   |  +----+     |
 *   +-------------+
 *
 * INVARIANT: what is drawn by a box is drawn by the tight one, or not at all.
 */
#ifndef CS_SCENE_BOUNDS_H
#define CS_SCENE_BOUNDS_H

#include "scene/scene.h"

/* *is_there: whether there is anything; else *out is not set. Errors: NO_MEMORY. Shared read. */
CELSPAN_CHECKED celspan_status cs_bounds_object(celspan_context *context,
                                                const celspan_object *object, bool *is_there,
                                                celspan_box *out);
CELSPAN_CHECKED celspan_status cs_bounds_cel(celspan_context *context, const celspan_cel *cel,
                                             bool *is_there, celspan_box *out);

#endif
