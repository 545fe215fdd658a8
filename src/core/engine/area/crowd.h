/* Crowds: intervals in which so many edges share pixels that following their intersections would
 * cost more than solving each pixel by itself: hatching, hair, rain, confetti.
 *
 *      p       p+1      p+2
 *      |--------+--------|      each edge gives a segment to each pixel that it crosses
 *   ---|.       | B      |---   left side of p + 1: what is present at the top (the composer),
 *   s->|  `.    |/       |      and steps s below it, where an edge has entered, begun or ended
 *      |     `.-*        |
 *      |  A    /s`.      |      pixel p + 1: layers A and B are partial; all others cover it
 *   ---+------/-+---`.---+---   or are not there
 *
 * A pixel depends on the edges in it and on what is present at its left side. crowd_pixel.h walks
 * through its layers, crowd_solver.h finds what the partial ones show.
 *
 * Invariants: coordinates in a pixel are whole units, and the same line gives the same units in all
 * layers: shapes that abut leave no gap. Spans between edges have the composer's cell, never the
 * colour of a pixel. As for local sweeps (local_sweep.h), nothing changes left and right of the
 * interval.
 */
#pragma once

#include "engine/area/crowd_pixel.h"
#include "engine/area/intervals.h"

/* The part of a straight piece of an edge in one pixel. Left of the frame x has no meaning. */
typedef struct cs_crowd_segment {
  uint16_t xa, ya, xb, yb; /* units from the pixel's corner: 0 .. CS_CROWD_UNIT */
  uint32_t edge;           /* 2 * layer, + 1 if the winding grows to its right */
  uint32_t next;           /* the next segment in the same column; UINT32_MAX: none */
} cs_crowd_segment;

/* At the left side of a pixel, a layer's winding changes below a height. */
typedef struct cs_crowd_step {
  uint32_t layer;
  int32_t y, change;
} cs_crowd_step;

typedef struct cs_crowd_steps {
  CS_ARRAY(cs_crowd_step, list); /* the nearest layers first */
  size_t count;
} cs_crowd_steps;

/* The memory that a worker keeps for crowds. */
typedef struct cs_crowd {
  cs_crowd_pixel pixel;
  CS_ARRAY(cs_crowd_segment, segments);
  CS_ARRAY(uint32_t, columns); /* by column, from the one left of the interval: its first segment */
  CS_ARRAY(uint64_t, order);   /* the segments of a column, the nearest layers first */
  CS_ARRAY(cs_crossing, crossings); /* of the composer */
  cs_crowd_steps here, next;        /* at the left side of a column, and of the next one */
  size_t segment_count, order_count, crossing_count;
} cs_crowd;

void cs_crowd_init(cs_crowd *crowd);
void cs_crowd_finish(cs_crowd *crowd, cs_memory *memory);
/* Whether an interval of a whole row is crowded. */
bool cs_crowd_suits(const cs_intervals *intervals, const cs_interval *interval,
                    const cs_composer *composer, int32_t width);
/* Draws the members of a sweep, and those that begin, through a whole row. The composer is left of
 * all members, before and after the call. extent: the columns of the members; next: the least x of
 * everything that is drawn after the members; right: the cell right of the members. Errors:
 * NO_MEMORY, and the errors of painting. */
CELSPAN_CHECKED celspan_status cs_crowd_draw(cs_crowd *crowd, cs_local_sweep *sweep,
                                             cs_extent extent, double next, const cs_cell *right);
