/* Committing the order: boundaries that have been swept locally are in a known order at the foot of
 * the row, between known cells, so neither has to be found again on the next row.
 *
 *      top   a   b   c          places low, low + 1, low + 2
 *              x              a and b have changed places
 *      foot  b   a   c          committed: places {low + 1, low, low + 2}, and the cells right of
 *                               each at the foot
 *
 * Invariant: after cs_commit_apply the committed places are as the sweep would have ordered them at
 * the foot, and their cells have the colours that would be composed there. Groups in which
 * something begins or ends are not committed: they have other places afterwards.
 */
#ifndef CS_AREA_COMMIT_H
#define CS_AREA_COMMIT_H

#include "area/local_sweep.h"

/* How one group of neighbours has ended. */
typedef struct cs_committed {
  struct cs_committed *next;
  size_t low, count;     /* places of the order */
  const cs_cell **cells; /* for each: right of it, at the foot */
  uint32_t *places;      /* for each: where its boundary was at the top */
} cs_committed;

typedef struct cs_commit {
  cs_active *active; /* borrowed, as the next three */
  cs_cells *cells;
  cs_composer *composer;
  cs_arena *arena;     /* of the row */
  cs_committed *first; /* of the current row; NULL: none */
} cs_commit;

/* Notes that boundaries i and i + 1 have changed places, with a cell between them. */
CELSPAN_CHECKED celspan_status cs_commit_pair(cs_commit *commit, size_t i, const cs_cell *between);
/* Notes how a local sweep of the boundaries [low, high) has ended, if that can be committed. */
CELSPAN_CHECKED celspan_status cs_commit_sweep(cs_commit *commit, const cs_local_sweep *sweep,
                                               size_t low, size_t high);
/* Brings the order and the cells of what has been noted to the foot of the row. */
CELSPAN_CHECKED celspan_status cs_commit_apply(cs_commit *commit);

#endif
