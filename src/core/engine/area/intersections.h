/* Intersections: where boundaries that go down together cross, from the highest to the lowest.
 *
 *      y0   a    b     c
 *            \  /      |      step: all are straight, from one bend to the next
 *             \/       |
 *             /\       |      intersection: a and b change places, at share 0.5 of the step
 *      step  b  a      c
 *            |   \    /       the next step
 *            |    \  /
 *            |     \/         intersection of a and c
 *      y1    b     c a
 *
 * In each step, two neighbours whose feet are out of order cross on the way. Only places and
 * heights are found here; the cells between them are composed afterwards, place by place
 * (local_sweep.c).
 *
 * Invariant: swaps are always of neighbours, so an order exists at every moment, there are no more
 * of them than inversions, and at the foot all are in order.
 */
#pragma once

#include "base/arrays.h"

#define CS_INTERSECTIONS_NONE UINT32_MAX

/* How far an edge has been followed down its polyline. */
typedef struct cs_active_edge {
  const celspan_point *points; /* ascending in y */
  uint32_t at;                 /* the segment it is on ends at points[at] */
  uint32_t last_at;            /* the value of `at` when the edge last changed places */
  double last_x, last_y;       /* the point at which the edge last changed places */
} cs_active_edge;

/* Two neighbours change places. */
typedef struct cs_intersection {
  double y, left_x, right_x;  /* the height, and the x of both neighbours */
  uint32_t left_at, right_at; /* the segments of both neighbours */
  uint32_t left, right;       /* edges: `left` moves from this place to the next place on the
                                 right */
  uint32_t next, previous;    /* intersections at the same place, or NONE */
  const void *cell; /* for the caller: the cell between the two edges below the intersection */
} cs_intersection;

typedef struct cs_intersections {
  cs_active_edge *edges; /* in the order at the top */
  /* by place, from left to right */
  uint32_t *order; /* the edge at each place */
  /* x of the edge at both ends of the step; after the last step, at the lower height */
  double *top, *foot;
  double *shares; /* the share of the step at which the edge crosses its right neighbour; INFINITY:
                     it does not cross */
  double *least;  /* the least share of each batch of 16 shares, if there is more than one batch */
  /* intersections of this place with the next one on the right, or NONE */
  uint32_t *first, *last;
  CS_ARRAY(unsigned char, storage);         /* one allocation, of all the arrays above */
  CS_ARRAY(cs_intersection, intersections); /* from top to bottom */
  size_t count, edge_capacity;
} cs_intersections;

void cs_intersections_finish(cs_intersections *intersections, cs_memory *memory);
/* Makes room for `edges` edges. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_intersections_reserve(cs_intersections *intersections,
                                                        celspan_context *context, size_t edges);
/* Finds the intersections of the first `count` edges between two heights; all edges extend to the
 * lower height. The caller sets the edges, each on a segment at or above the first height, and sets
 * `foot` to their x at this height. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_intersections_find(cs_intersections *intersections,
                                                     celspan_context *context, size_t count,
                                                     double y0, double y1);
