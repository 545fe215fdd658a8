/* The result of feMorphology on an object of one colour: the points around which the rectangle of
 * two radii contains some of the object, or nothing but the object.
 *
 *     object --> light of 1 where it is --> mean of the rectangle --> much brighter --> matte
 *
 * INVARIANT: a rectangle counts as touched when the object fills 1/256 of it.
 */
#pragma once

#include "base/context.h"

typedef struct cs_svg_morphology {
  bool shrinks;
  celspan_point radius;
  celspan_paint paint; /* of the object: its alpha is all that the object has */
} cs_svg_morphology;

/* object: NULL: nothing. *out: new; NULL: nothing. Errors: NO_MEMORY, LIMIT. */
CELSPAN_CHECKED celspan_status cs_svg_morphology_make(celspan_context *context,
                                                      celspan_object *object,
                                                      const cs_svg_morphology *wanted,
                                                      celspan_object **out);
