/* Blocks: which boundaries of a row must be replayed together.
 *
 *   knot    neighbours that cross, with all that they may cross on the way
 *   range   what begins and ends at one height in one leaf (its windings balance only together),
 * all
 *           between, and all it may meet further down
 *
 * A block is a knot or a range, or several that touch; blocks in which what begins could meet are
 * one. Work is done where something happens, not over the whole row.
 *
 * Invariant: after cs_intervals_find the blocks ascend and share no boundary; a place between two
 * boundaries (low == high) touches no other block.
 */
#ifndef CS_AREA_INTERVALS_H
#define CS_AREA_INTERVALS_H

#include "area/local_sweep.h"

/* Neighbours [low, high) to be replayed together; low == high: what begins and ends between two. */
typedef struct cs_interval {
  size_t low, high;
  size_t last_low;              /* the greatest `low` merged into it */
  double low_x, high_x;         /* of what begins or ends in it; low_x > high_x when nothing does */
  double reach_low, reach_high; /* where its boundaries, and what begins, are in the row */
} cs_interval;

/* A begin or an end inside the row, and the x-range in the row of what begins or ends. */
typedef struct cs_row_event {
  double y, low, high;
  uint32_t layer;
  int32_t begin; /* which of begins this is about, or -1: a boundary that ends */
  bool is_end;
} cs_row_event;

/* At which place of the order something begins. */
typedef struct cs_begin_place {
  size_t low; /* as of its block */
  size_t begin;
} cs_begin_place;

typedef struct cs_intervals {
  cs_row_maker *maker;
  const cs_cell *cells;       /* as in cs_cells; they stay as they are until the row is done */
  double y0, y1;              /* the row, or a slice of it */
  cs_member *procedure_edges; /* edges of scan-line primitives on this row */
  size_t procedure_edge_count;
  double procedures_low, procedures_high;  /* their x-range */
  cs_member *begins;                       /* chains that begin inside the row, then the strips */
  cs_interval *begin_intervals;            /* for each: where its begin is replayed */
  cs_begin_place *begin_places;            /* from left to right */
  size_t begin_count, chain_count, picked; /* picked: begins of blocks that the walk has met */
  cs_row_event *events;
  size_t event_count;
  cs_interval *intervals; /* while they are sought, knots first */
  size_t count, capacity, knot_count;
} cs_intervals;

/* How many chains begin between the active boundaries' height and y1. */
size_t cs_intervals_count_begins(const cs_active *active, double y1);
/* Finds the blocks of the row the scan's active boundaries have reached through; scan, y0, y1 and
 * the strips are given. */
CELSPAN_CHECKED celspan_status cs_intervals_find(cs_intervals *intervals);

/* A chain as a member that stands at the top of its points. */
void cs_intervals_member(cs_member *member, const cs_active *active, uint32_t chain,
                         const celspan_point *points, uint32_t count);

#endif
