/* Objects that are changed by a rule about neighbouring pixels (nearby.h): those of SVG filters,
 * and sharpened ones.
 */
#pragma once

#include "model/scene/nearby.h"
#include "model/scene/scene.h"

/* An object without a mode, or nothing (NULL), changed by a rule inside a frame. *out: new. Errors:
 * NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_nearby_object_create(celspan_context *context,
                                                       celspan_object *object, cs_nearby *nearby,
                                                       const celspan_box *frame,
                                                       celspan_object **out);
