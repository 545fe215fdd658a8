/* A name in a document that is not drawn: an attribute, a property, an element, or a value of one
 * of them; once for each name, at the line where it appears first.
 */
#pragma once

#include "base/arena.h"
#include "base/hash_table.h"

#define CS_SVG_UNREAD 1000 /* names; more are not noted */

typedef struct cs_svg_unread_name {
  const char *what; /* name, or: name "value" */
  uint32_t line;
} cs_svg_unread_name;

/* All zero is an empty list. */
typedef struct cs_svg_unread {
  cs_svg_unread_name *items;
  size_t count, capacity;
  cs_hash_table names;
} cs_svg_unread;

/* value: NULL where the name alone is not known. Texts are copied to the arena. Errors: NO_MEMORY.
 */
CELSPAN_CHECKED celspan_status cs_svg_unread_add(cs_svg_unread *list, celspan_context *context,
                                                 cs_arena *arena, uint32_t line, const char *name,
                                                 const char *value);
void cs_svg_unread_finish(cs_svg_unread *list, celspan_context *context);
