/* Variables of styles: --name: value, and var(--name, fallback) in other values.
 *
 * Invariant: a list of variables is never changed; an element that sets some adds them before the
 * inherited ones.
 */
#pragma once

#include "base/arena.h"

#define CS_SVG_VARIABLE_BYTES ((size_t)64 << 20) /* that all of a document may take */

/* One variable; the next ones are those that it hides and variables of other names; NULL: the
 * last. */
typedef struct cs_svg_variable {
  const char *name, *value;
  const struct cs_svg_variable *next;
} cs_svg_variable;

/* Where variables and values are made. */
typedef struct cs_svg_variables {
  celspan_context *context;
  cs_arena *arena;
  size_t used; /* bytes of the arena */
} cs_svg_variables;

/* Errors: NO_MEMORY; LIMIT for more than CS_SVG_VARIABLE_BYTES. */
CELSPAN_CHECKED celspan_status cs_svg_variable_add(cs_svg_variables *made, const char *name,
                                                   const char *value, const cs_svg_variable **list);
/* The value in which every var() is replaced by the value of its variable. *out: NULL where a
 * variable has no value, or the text is too long, or variables refer to one another in a circle.
 * Errors: as above. */
CELSPAN_CHECKED celspan_status cs_svg_variable_fill(cs_svg_variables *made,
                                                    const cs_svg_variable *list, const char *value,
                                                    const char **out);
