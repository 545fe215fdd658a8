/* Art that continues beyond a border with the colours on the border.
 *
 *      .-----+---------------+-----.        inside: the art, clipped
 *      |corner    strip      |     |        strip:  the art, mirrored at its side of the border
 *      +-----+---------------+-----+                and stretched so far that reach / STRETCH
 *      |strip|    inside     |strip|                of it beside the side fills the strip
 *      +-----+---------------+-----+        corner: the same along both axes
 *      |     |               |     |
 *      `-----+---------------+-----'        All nine abut, so nothing leaks between them.
 *            |<-- border --> |<--->| reach
 *
 * A strip shows at most 1/SHARE of the art inside, however far it reaches.
 */
#pragma once

#include "model/scene/scene.h"

#define CS_EXTEND_STRETCH 0x1p14 /* at least */
#define CS_EXTEND_SHARE 64

/* placed: from the objects' units to the border's; not singular. *out: in the objects' units.
 * Errors: NO_MEMORY, LIMIT, and BAD_ARGUMENT where the objects cannot be transformed so. */
CELSPAN_CHECKED celspan_status cs_extend(celspan_context *context, celspan_object *const *objects,
                                         size_t count, const celspan_matrix *placed,
                                         const celspan_box *border, double reach,
                                         celspan_object **out);
