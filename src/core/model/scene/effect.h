/* What all effects need: the composition that holds an object as a cel, and modes, which stay
 * outermost.
 */
#pragma once

#include "model/scene/scene.h"

/* The result of an effect on an object without a mode. desc: of the effect. */
typedef celspan_status (*cs_effect_maker)(celspan_context *context, celspan_object *object,
                                          const void *desc, celspan_object **made);

/* Replaces *object by the new object, unless making it has failed with this status. */
CELSPAN_CHECKED celspan_status cs_effect_replace(celspan_object **object, celspan_status status,
                                                 celspan_object *made);
/* Gives *object a mode. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_effect_give_mode(celspan_context *context,
                                                   celspan_object **object, celspan_blend mode);
/* Makes the effect of an object. The mode of the object becomes the mode of the result, which gets
 * the object's name and line. Errors: NO_MEMORY, and those of `add`. */
CELSPAN_CHECKED celspan_status cs_effect_make(celspan_context *context, celspan_object *object,
                                              cs_effect_maker add, const void *desc,
                                              celspan_object **out);
/* A cel as an object: a composition of it that ends at `frame`, in the cel's units, where the
 * object lies, too. brightness: the factor of its light. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_CHECKED celspan_status cs_effect_compose(celspan_context *context, celspan_cel *cel,
                                                 const celspan_box *frame, double brightness,
                                                 celspan_object **out);
