/* Points taken apart into stretches, of which each lies on a line or on an arc of a circle.
 *
 *      . . . . .                 three stretches: two lines and an arc. The point at the corner
 *               .                lies too far from both lines, and is left out
 *              .
 *              .                 the cheapest solution is chosen: it pays for each line, more for
 *               ` . .            an arc, little for a point left out, and the squares of distances
 *
 * The price of a stretch is the length of its description, in the same units as the prices of
 * distances: a point whose distance is as large as the expected noise costs one half. So a line
 * that is too short to be distinguished from an arc stays part of the arc. Where two lines fit as
 * well as three arcs, there is a corner.
 *
 * Where pixels are whole, there is no noise: a stretch is a line or an arc that passes all its
 * gates. Of the solutions with the same price, the one with the widest streets is chosen.
 *
 * INVARIANT: stretches are in order, do not overlap, and have CS_STRETCH_FEWEST points at least and
 * CS_STRETCH_MOST at most; the total is the least that any such stretches have.
 */
#pragma once

#include "tools/trace/arc.h"
#include "tools/trace/edge.h"
#include "tools/trace/street.h"

#define CS_STRETCH_FEWEST 3
#define CS_STRETCH_MOST CS_GATES_MOST

/* Points [from, to) of a list. In a closed list, the first point follows the last one. */
typedef struct cs_stretch {
  ptrdiff_t from, to;
  cs_arc arc;
} cs_stretch;

typedef struct cs_stretches {
  cs_stretch *items;
  size_t count, capacity;
} cs_stretches;

static inline celspan_point cs_points_at(const cs_points *points, ptrdiff_t i) {
  ptrdiff_t count = (ptrdiff_t)points->count;
  return points->items[((i % count) + count) % count].at;
}

/* The gates of points [from, to), at most CS_GATES_MOST. */
void cs_stretches_row(const cs_points *points, ptrdiff_t from, ptrdiff_t to, cs_gate_row *row);

/* Divides points [from, to) into stretches. noise: the distance of points from them, root mean
 * square. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_stretches_find(celspan_context *context, const cs_points *points,
                                                 ptrdiff_t from, ptrdiff_t to, double noise,
                                                 cs_stretches *out);
/* The same for points of whole pixels: the stretches go through the gates of the points. */
CELSPAN_CHECKED celspan_status cs_stretches_thread(celspan_context *context,
                                                   const cs_points *points, ptrdiff_t from,
                                                   ptrdiff_t to, cs_stretches *out);
void cs_stretches_finish(celspan_context *context, cs_stretches *stretches);
