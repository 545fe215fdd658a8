/* Objects whose lines are changed: the tree of an object stays as it is, with its transforms,
 * fades, modes and names, and the contours of every primitive in it are changed where they are.
 *
 *     object          union{ shape, stroke }
 *     changed         union{ shape with other contours, stroke along another line }
 *
 * A stroke keeps its width, caps, joins and dashes. A texture keeps its place.
 */
#pragma once

#include "base/context.h"
#include "model/operators/lines.h"

typedef struct cs_operation cs_operation;
struct cs_operation {
  celspan_context *context;
  const char *noun; /* for messages */
  /* Appends the changed contours to `to`, which is empty. place: from the units of the primitive to
   * those around the whole object; not singular. scale: of lengths, by this map. */
  celspan_status (*change)(cs_operation *operation, const cs_lines *from,
                           const celspan_matrix *place, double scale, cs_lines *to);
};

/* Errors: those of change; NO_MEMORY, LIMIT; BAD_ARGUMENT for what has no lines, for a stroke whose
 * width varies, and for results beyond the greatest number. */
CELSPAN_CHECKED celspan_status cs_operate(cs_operation *operation, const celspan_object *object,
                                          celspan_object **out);
