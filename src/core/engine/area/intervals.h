/* Intervals: which neighbouring boundaries of a row must be replayed together.
 *
 *      places   0     1   2      3        4   5
 *      y    ----|-----\---/------|--------|---|----
 *               |      \ /       |    .   |   |
 *               |       x        |   / \  |   |         1 and 2 cross: an inversion group
 *               |      / \       |  /   \ |   |         something begins at the dot
 *      y+1  ----|-----/---\------|-/-----\|---|----
 *                     [---]      [--------]
 *                    interval     interval: 3 and 4 with what begins, because it may meet them
 *
 *   inversion group   neighbours that cross, with all that they may cross on the way
 *   events            what begins and ends at one height in one layer (its windings balance only
 *                     together), with all between, and all that it may meet further down
 *
 * An interval is one of these, or several that touch; intervals in which what begins could meet are
 * one. So work is done where something happens, and not over the whole row.
 *
 * Invariant: after cs_intervals_find the intervals ascend and share no boundary; a place between
 * two boundaries (low == high) touches no other interval.
 */
#pragma once

#include "engine/area/edges.h"
#include "engine/area/local_sweep.h"

/* Neighbours [low, high) that are replayed together. low == high: the interval has only boundaries
 * that begin and end between two others. */
typedef struct cs_interval {
  size_t low, high;
  size_t last_low;  /* the greatest `low` of all intervals that were merged into this one */
  cs_extent events; /* the events of the boundaries that begin or end in the interval */
  cs_extent extent; /* around the interval's boundaries in the row and those that begin there */
  bool is_crowd;    /* the interval is drawn without its cells (crowd.h) */
} cs_interval;

/* A begin or an end inside the row, and the extent in the row of the boundaries concerned. */
typedef struct cs_interval_event {
  double y;
  cs_extent extent;
  uint32_t layer;
  int32_t begin; /* index into `begins`; -1: the event is the end of a boundary */
  bool is_end;
} cs_interval_event;

/* The interval in which something begins. */
typedef struct cs_interval_begin {
  size_t low; /* the lowest boundary of the interval, before it was merged with others */
  size_t begin;
} cs_interval_begin;

typedef struct cs_intervals {
  /* given: borrowed */
  celspan_context *context;
  cs_arena *arena; /* the arena of the row */
  const cs_active *active;
  const cs_edges *edges;      /* the edges of the active boundaries */
  double y0, y1;              /* the row, or a slab of it */
  cs_member *procedure_edges; /* edges of scan-line primitives on this row */
  size_t procedure_edge_count;
  cs_extent procedures; /* the extent of these edges */
  /* found */
  /* from left to right; groups come first while intervals are being searched for */
  cs_interval *intervals;
  size_t count, capacity, group_count;
  cs_member *begins;            /* chains that begin inside the row, then the edges of procedures */
  cs_interval *begin_intervals; /* for each begin: the interval in which it is replayed */
  cs_interval_begin *begin_order; /* from left to right */
  size_t begin_count, chain_count;
  size_t picked; /* how many of begin_order have been used */
  cs_interval_event *events;
  size_t event_count;
} cs_intervals;

/* How many chains begin between the active boundaries' height and y1. */
size_t cs_intervals_count_begins(const cs_active *active, double y1);
/* Finds the intervals of the row through which the active boundaries have been advanced. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_intervals_find(cs_intervals *intervals);
/* Copies of the members that begin in an interval, by height, then x, then order. Intervals must be
 * requested from left to right. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_intervals_pick_begins(cs_intervals *intervals,
                                                        const cs_interval *interval,
                                                        cs_member **begins, size_t *count);
/* Makes a member of active boundary i, at the top of its polyline through the row.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_intervals_member(const cs_intervals *intervals, size_t i,
                                                   cs_member *member);
