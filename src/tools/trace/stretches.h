/* Points taken apart into stretches, of which each lies on a line or on an arc of a circle.
 *
 *      . . . . .                 three stretches: two lines and an arc; of the point at the corner
 *               .                too little is true for either of both lines: it is in none
 *              .
 *              .                 the cheapest sum is chosen: a price for a line, more for an arc, a
 *               ` . .            little for a point that is left out, and the squares of distances
 *
 * What a stretch costs is what it takes to tell it, in the same units as what is off: of noise that
 * is as large as it is said to be, a point costs one half. So a line that is too short to be told
 * from an arc stays part of it, and where two lines do as well as three arcs there is a corner.
 *
 * Where pixels are whole nothing is noise: a stretch is a line or an arc that passes all its gates,
 * and of those that cost the same the one with the widest streets is taken.
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

/* Points [from, to) of a list, counted on where it is closed. */
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

/* Takes apart points [from, to); noise: how far points are off, root mean square. Errors:
 * NO_MEMORY.
 */
CELSPAN_CHECKED celspan_status cs_stretches_find(celspan_context *context, const cs_points *points,
                                                 ptrdiff_t from, ptrdiff_t to, double noise,
                                                 cs_stretches *out);
/* The same, of points of whole pixels, through their gates. */
CELSPAN_CHECKED celspan_status cs_stretches_thread(celspan_context *context,
                                                   const cs_points *points, ptrdiff_t from,
                                                   ptrdiff_t to, cs_stretches *out);
void cs_stretches_finish(celspan_context *context, cs_stretches *stretches);
