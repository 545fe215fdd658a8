/* Antialias "area": the exact mean of a row over each of its pixels.
 *
 *   active boundaries, cells --> edges --> lone boundaries --+--> target --> spans, or
 *                            \-> intervals -> local sweeps --+              retained edges
 *
 * Invariant: the mean is of composed colour (composite first, integrate after), and depends on the
 * plan and the row's number alone.
 */
#pragma once

#include "engine/area/crowd.h"
#include "engine/area/dense.h"
#include "engine/area/edges.h"
#include "engine/area/local_sweep.h"
#include "engine/area/row_tools.h"

/* Committing the order: boundaries that have been swept locally are in a known order at the foot of
 * the row, between known cells, so neither has to be found again on the next row.
 *
 *      top   a   b   c          places low, low + 1, low + 2
 *              x              a and b have changed places
 *      foot  b   a   c          committed: places {low + 1, low, low + 2}, and the cells right of
 *                               each at the foot
 *
 * Invariant: after apply_commit the committed places are as the sweep would have ordered them at
 * the foot, and their cells have the colours that would be composed there. Groups in which
 * something begins or ends are not committed: they have other places afterwards.
 */

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

typedef struct cs_area {
  cs_row_tools tools; /* borrowed */
  cs_edges edges;     /* of the row being made */
  cs_target target;   /* receives the borders of the row */
  cs_local_sweep sweep;
  cs_dense dense;
  cs_crowd crowd;
  cs_commit commit; /* the order and cells that the row leaves for the next one */
} cs_area;

void cs_area_init(cs_area *area, const cs_row_tools *tools);
void cs_area_finish(cs_area *area, cs_memory *memory);
/* Row y. The boundaries are at its top; change: where they differ from those of the last update of
 * the cells. Boundaries and cells have reached its foot when it returns, and are in the order that
 * they have there as far as that is known. out: is empty, gets [0, width).
 * Errors: NO_MEMORY, CALLBACK; what composing meets is in composer->failure too. */
CELSPAN_CHECKED celspan_status cs_area_row(cs_area *area, int32_t y, cs_change change, cs_row *out);
/* The same, but the visible edges of the row are kept in `retained`, which is begun and sealed, and
 * no pixels are made. y: may lie beyond the frame. */
CELSPAN_CHECKED celspan_status cs_area_retain(cs_area *area, int32_t y, cs_change change,
                                              cs_retained_row *retained);
