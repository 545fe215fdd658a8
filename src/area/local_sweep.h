/* Clusters: the small groups of boundaries that cross, begin or end inside a row of pixels,
 * replayed event by event.
 *
 *   band:     between two heights at which some member begins or ends
 *   meeting:  two neighbours cross inside a band (meetings.h); the one cell between them is
 *             composed anew
 *
 * Meetings are found from the highest to the lowest; their cells are then composed place by place,
 * since what is seen right of a place depends on the meetings there alone: the composer goes from
 * one to the next with few steps. Swaps are always of neighbours, so an order exists at every
 * moment and the steps are bounded by the inversions.
 *
 * Invariant: what a cluster does is closed: left of it and right of it the sets of leaves present
 * stay as they are through the row.
 */
#ifndef CS_AREA_LOCAL_SWEEP_H
#define CS_AREA_LOCAL_SWEEP_H

#include "row/row.h"

/* One boundary inside a cluster: a polyline downwards from where it enters the row or begins. */
struct cs_member {
  const celspan_point *points; /* ascending in y */
  uint32_t point_count;
  uint32_t at; /* a segment that y is on ends at points[at]; point_count: ended */
  uint32_t layer;
  uint32_t span;  /* of a scan-line leaf; UINT32_MAX for a chain */
  uint32_t order; /* settles ties: the chain or the strip's edge */
  uint32_t place; /* in the order at the top of the row; UINT32_MAX: it begins in the row */
  int32_t direction;
  double x, y; /* up to where its fragments were given */
  double foot; /* x where the current band ends */
  const cs_cell *right;
};

typedef struct cs_local_sweep {
  cs_row_maker *maker;
  double y0, y1;       /* the row */
  const cs_cell *left; /* of all its members */
  cs_member **members; /* those that are there at the current height, in order */
  size_t count;
  cs_member *begins; /* those still to begin, by height, then x, then order */
  size_t begin_count;
  cs_member **spare;                          /* room for as many */
  const cs_cell **seen;                       /* right of each place; room for as many */
  const cs_deferred *deferred, *deferred_end; /* those right of the cluster's least x */
  /* where the composer stands: right of so many members, and of the toggles before `passed` */
  size_t stood;
  const cs_deferred *passed;
} cs_local_sweep;

/* Replays the cluster into the scan's window. The composer stands left of the cluster, and does so
 * again afterwards. members, spare, seen: room for count + begin_count. */
CELSPAN_CHECKED celspan_status cs_local_sweep_replay(cs_local_sweep *sweep);

/* The same for boundaries i and i + 1, straight through the row, that cross once: nearly all
 * clusters are that. left: of both; the composer stands there. *between: the cell between them
 * when they have crossed, good until the row is done. */
CELSPAN_CHECKED celspan_status cs_local_sweep_pair(cs_row_maker *maker, const cs_cell *left,
                                                   size_t i, const cs_cell **between);

#endif
