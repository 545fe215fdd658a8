/* How people know a value: by the name it was given, and by the place in a script where it was
 * made.
 *
 *   name    "hand", by :named or celspan_object_named and its like
 * origin "shot.lua", line 12: the place that the context named when the value was made
 *
 * A mark is kept by the values that are made of a value by transforms, fades and names. It is no
 * part of a value's hash. Invariant: a name is valid UTF-8 of 1 to CS_MARK_NAME bytes, without
 * control characters.
 */
#pragma once

#include "base/context.h"

#define CS_MARK_NAME 255 /* bytes of a name at most */

/* A text that several values share: it never changes, and is counted. Any thread. */
typedef struct cs_text cs_text;
void cs_mark_keep_text(cs_text *text);
void cs_mark_drop_text(cs_text *text);

/* cs_mark_keep takes a reference of the name, and the other function drops one. Any thread. */
static inline cs_mark cs_mark_keep(cs_mark mark) {
  if (mark.name)
    cs_mark_keep_text(mark.name);
  return mark;
}

static inline void cs_mark_drop(cs_mark mark) {
  if (mark.name)
    cs_mark_drop_text(mark.name);
}

/* The mark of a value that is made now: no name, and the origin that the context holds. */
cs_mark cs_mark_now(const celspan_context *context);
/* *out: a copy of `mark` with another name and with its own references. Errors: NO_MEMORY;
 * BAD_ARGUMENT for a name that breaks the invariant. */
CELSPAN_CHECKED celspan_status cs_mark_named(celspan_context *context, cs_mark mark,
                                             const char *name, cs_mark *out);
/* "" if there is no name; lives as long as a value with this mark. */
const char *cs_mark_name(cs_mark mark);
celspan_origin cs_mark_origin(cs_mark mark);

/* A mark for a message: "", " 'hand'", " (shot.lua:12)" or " 'hand' (shot.lua:12)". */
typedef struct cs_mark_text {
  char text[CS_MARK_NAME + 288];
} cs_mark_text;
cs_mark_text cs_mark_describe(cs_mark mark);
