/* The operands of boolean objects: lists that grow at their end, and that several objects share.
 *
 *   a | b | c        shows 3 of   [ a  b  c | d .  . ]
 *   a | b | c | d    shows 4 of   [ a  b  c   d | . . ]     the same list, two places free
 *   a | b | c | e    shows 4 of   [ a  b  c   e | . . . . ] another: the fourth place was taken
 *
 * so that a chain of n operators costs n steps and not n * n. The object that shows all of a list
 * may add to it; a second one that is made from the same beginning gets a list of its own.
 *
 * An operand may itself show the beginning of the list that it is in, and keep it alive:
 *
 *   c = a | b
 *   d = c | c       shows 3 of   [ a  b  c | . . . ]     c shows 2 of the same
 *
 * so places are freed as soon as no living view shows them, and not when the list goes.
 *
 * INVARIANT: the longest view of a list that lives shows all that is used of it; no two living
 * views show equally many. An operand shows only the part of its list that lies before it. The
 * operands of a living view never change. Threads: views of one list may be extended and dropped on
 * any threads.
 */
#pragma once

#include "base/context.h"

typedef struct cs_operands_list cs_operands_list;

/* A view: the part of a list that one boolean object shows. Without operands there is no list. */
typedef struct cs_operands {
  cs_operands_list *list;
  celspan_object **objects; /* in the list */
  size_t count;
} cs_operands;

/* A view of a new list of these objects. The list keeps a reference to each. noun: for the message.
 * Errors: NO_MEMORY, BAD_ARGUMENT for an object that is missing. */
CELSPAN_CHECKED celspan_status cs_operands_create(celspan_context *context, const char *noun,
                                                  celspan_object *const *objects, size_t count,
                                                  cs_operands *out);
/* A view of the objects that `from` shows followed by these objects. Cost: O(count), on the average
 * over a chain. Errors as above. */
CELSPAN_CHECKED celspan_status cs_operands_extend(celspan_context *context, const char *noun,
                                                  const cs_operands *from,
                                                  celspan_object *const *objects, size_t count,
                                                  cs_operands *out);
void cs_operands_finish(cs_operands *operands);
