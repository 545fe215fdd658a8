/* Objects that are displaced, or blurred in a direction: compositions of a cel with a shift. */
#pragma once

#include "model/scene/scene.h"

/* As celspan_object_displace; moves_clear: clear counts as black, as browsers take it. */
CELSPAN_CHECKED celspan_status cs_displace_object(celspan_context *context, celspan_object *object,
                                                  const celspan_displace_desc *desc,
                                                  bool moves_clear, celspan_object **out);
/* A directional blur of an object. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_displace_blur(celspan_context *context, celspan_object *object,
                                                const celspan_blur_desc *desc,
                                                celspan_object **out);
