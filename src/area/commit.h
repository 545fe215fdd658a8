/* What is carried over to the next row: a block that has been replayed stands at the foot of the
 * row in a known order, between known cells, so neither is sought anew.
 *
 * Invariant: after cs_commit_out the places of the carried blocks are as the sweep would have put
 * them at the foot, and their cells look as it would have composed them there. Blocks in which
 * something begins or ends are not carried: their places are no longer the same ones.
 */
#ifndef CS_AREA_COMMIT_H
#define CS_AREA_COMMIT_H

#include "area/local_sweep.h"

typedef struct cs_committed {
  struct cs_committed *next;
  size_t low, count;     /* places of the order */
  const cs_cell **cells; /* for each: right of it, at the foot */
  uint32_t *places;      /* for each: where its boundary stood at the top */
} cs_committed;

/* Notes that boundaries i and i + 1 have changed places, with a cell between them. */
CELSPAN_CHECKED celspan_status cs_commit_pair(cs_row_maker *maker, size_t i,
                                              const cs_cell *between);
/* Notes how a cluster of the boundaries [low, high) has ended, if it can be carried. */
CELSPAN_CHECKED celspan_status cs_commit_cluster(const cs_local_sweep *sweep, size_t low,
                                                 size_t high);
/* Brings the order and the cells of what has been noted to the foot of the row. */
CELSPAN_CHECKED celspan_status cs_commit_out(cs_row_maker *maker);

#endif
