/* The graph of thinned lines: branches of pixels from end or fork to end or fork, or around.
 *
 *      o                     o: ends     f: forks, with three neighbours or more
 *       \      .--o         a branch that ends within the width of the line that it leaves is
 *        .--f--.             a spur of thinning, and goes
 *           |
 *           o
 *
 * INVARIANT: every pixel of a thinned line is in one branch, but forks, which are at the end of
 * several.
 */
#ifndef CS_TRACE_BRANCHES_H
#define CS_TRACE_BRANCHES_H

#include "trace/thinning.h"

typedef struct cs_branch {
  size_t first, count; /* places in the plane of thinned lines */
  bool is_closed;
} cs_branch;

typedef struct cs_branches {
  cs_branch *list;
  size_t count, capacity;
  uint32_t *places;
  size_t place_count, place_capacity;
} cs_branches;

/* Errors: NO_MEMORY. To be finished, whatever happens. */
CELSPAN_CHECKED celspan_status cs_branches_find(celspan_context *context, cs_thin *thin,
                                                cs_branches *out);
void cs_branches_finish(cs_branches *branches, celspan_context *context);

#endif
