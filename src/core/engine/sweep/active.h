/* The active boundaries: the chains that cross the current height, from left to right.
 *
 *      |      \      |     \
 *   ---*-------*-----*------*------- y       current height: the order is known
 *      |        \    |     /
 *   ---*---------*---o----*--------- y_next  height advanced to; o: a chain ends here (cs_bend)
 *
 * Advancing keeps the order at y, so that a row can be made from both ends of every boundary.
 * Settling then moves to y_next: it removes the chains that ended, sorts those that crossed each
 * other, and inserts the chains that begin. Every field that each row reads is an array over the
 * boundaries; the walk of a boundary down its chain is found by the boundary's slot.
 *
 * Invariants, at height y
 *   - exactly those chains with y0 <= y < y1 are listed that the cull keeps in y's row of tiles;
 *   - they are ordered by x at y, then by slope, then by chain: an order that depends on y and the
 *     set alone, not on the rows swept before (so strips agree to the bit);
 *   - x[i] is cs_boundary_x at y on the segment that y crosses.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/sweep/advance.h"
#include "engine/sweep/cull.h"
#include "model/geometry/boundary_walk.h"

/* Where the order of the active boundaries differs from the order at the height before.
 *
 *   before   a  b  c  d  e  f         low = 1: the first boundary is the same in both
 *   after    a  c  b  d  f            tail = 1: the last boundary is the same in both
 */

/* Where the order at a height differs from the order before. The boundaries left of index `low` and
 * the last `tail` ones are the same as before, and so are the cells between them. */
typedef struct cs_change {
  size_t low, tail;
} cs_change;

static const cs_change cs_change_none = {SIZE_MAX, SIZE_MAX};
static const cs_change cs_change_all = {0, 0};

static inline bool cs_change_is_none(cs_change change) { return change.low == SIZE_MAX; }

static inline cs_change cs_change_join(cs_change a, cs_change b) {
  return (cs_change){a.low < b.low ? a.low : b.low, a.tail < b.tail ? a.tail : b.tail};
}

/* Bends: what happens to the boundaries that are not a single segment between two heights.
 *
 * From one row to the next every boundary advances from the current height y to the height y_next.
 * A boundary is a polyline of segments; where a segment ends between the two heights the boundary
 * has a vertex there, and the row notes a bend:
 *
 *        x[0]     x[1]         x[2]     x[3]
 *   -----*--------*------------*--------*-------------------- y       current height
 *        |         \           |         \
 *        |          o vertex   |          \
 *        |         /           o end       \
 *        |        /                         \
 *   -----*-------*---------------------------*--------------- y_next  height advanced to
 *    x_next[0] x_next[1]                  x_next[3]
 *
 *   boundaries 0 and 3: no bend; 1: a bend with one vertex; 2: a bend that ends, at x_next[2]
 */

/* One boundary between the heights, when it is not a single segment there. */
typedef struct cs_bend {
  uint32_t boundary;     /* the index in the order at the current height */
  uint32_t vertex;       /* the boundary's first vertex strictly between the heights */
  uint32_t vertex_count; /* the number of them */
  bool ends;             /* the chain does not cross the next height */
  bool ends_above;       /* the chain ends above the next height, at its last vertex */
  double low, high;      /* the least and the greatest x on the way, both ends included */
} cs_bend;

/* The change of winding that crossing a boundary from left to right makes. */
typedef struct cs_crossing {
  uint32_t layer;
  int32_t direction;
} cs_crossing;

/* The memory behind the arrays, and its free slots. */
typedef struct cs_active_store {
  uint32_t *free_slots;
  size_t free_count;
  void *storage;   /* one allocation for all arrays of cs_active except bends and vertices */
  size_t capacity; /* the capacity of each array */
} cs_active_store;

typedef struct cs_active {
  const cs_boundary_set *set;
  const cs_cull *cull;
  cs_isa isa;
  bool notes_bends; /* false: only x is needed; then bends are noted only for chains that end */
  /* The boundaries in order: each array has `count` items, and room for CS_ADVANCE_BATCH more. */
  double *x;      /* at the current height */
  double *x_next; /* at the height advanced to; where the chain ends, if it ends before */
  cs_segments segments;
  cs_crossing *crossing;
  uint32_t *slot;
  size_t count;
  cs_boundary_walk *walks; /* one for each slot */
  /* The heights. */
  double y;          /* the current height */
  double y_next;     /* the height advanced to */
  double calm_until; /* above this height no chain begins and no other row of tiles does */
  size_t next;       /* the first chain of the set that has not begun */
  int32_t tile_row;  /* in which the current height lies */
  /* What happens between the heights. */
  bool rises;               /* x_next is in order, no two alike */
  uint32_t *bend_of;        /* by boundary: the only index in bends where its bend can be */
  CS_ARRAY(cs_bend, bends); /* in the order of their boundaries */
  CS_ARRAY(celspan_point, vertices);
  size_t bend_count, vertex_count;
  uint32_t *ended; /* scratch: the boundaries whose segments end */
  cs_active_store store;
} cs_active;

/* notes_bends: see the field. */
void cs_active_init(cs_active *active, const cs_boundary_set *set, const cs_cull *cull,
                    bool notes_bends);
void cs_active_finish(cs_active *active, cs_memory *memory);
/* Begins at height y, whatever the height was before. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_active_start(celspan_context *context, cs_active *active,
                                               double y);
/* Advances to height y, at or below the current one: fills x_next, bends and vertices. The order
 * remains the one at the current height. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_active_advance(celspan_context *context, cs_active *active,
                                                 double y);
/* The height advanced to becomes the current height. *change: where boundaries began, ended or
 * changed places; the whole order when another row of tiles has begun. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_active_settle(celspan_context *context, cs_active *active,
                                                cs_change *change);

/* The deferred winding changes of culled chains at the current height, from left to right. */
static inline const cs_deferred *cs_active_deferred(const cs_active *active,
                                                    const cs_deferred **end) {
  const cs_cull *cull = active->cull;
  if (cull->tile_rows == 0 || cull->deferred_count == 0)
    return *end = NULL;
  *end = cull->deferred_list + cull->deferred_starts[active->tile_row + 1];
  return cull->deferred_list + cull->deferred_starts[active->tile_row];
}

static inline uint32_t cs_active_number(const cs_active *active, size_t i) {
  return active->walks[active->slot[i]].chain;
}

static inline const cs_boundary_chain *cs_active_chain(const cs_active *active, size_t i) {
  return &active->set->chains[cs_active_number(active, i)];
}

/* The bend of boundary i, or NULL. */
static inline const cs_bend *cs_active_bend(const cs_active *active, size_t i) {
  uint32_t at = active->bend_of[i];
  return at < active->bend_count && active->bends[at].boundary == i ? &active->bends[at] : NULL;
}

/* Self-check: whether the boundaries are those that the current height crosses, each at its x, in
 * order, and no other begins while the row is said to be calm. */
bool cs_active_is_ordered(const cs_active *active);
