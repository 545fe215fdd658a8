/* The active boundaries: the chains that cross the current height, from left to right.
 *
 *      |      \      |     \
 *   ---*-------*-----*------*------- y       current height: the order is known
 *      |        \    |     /
 *   ---*---------*---o----*--------- y_next  height advanced to; o: a chain ends here (bend.h)
 *
 * Advancing leaves the order as it is at y, so that a row can be made from both ends of every
 * boundary. Settling then moves to y_next: it removes the chains that ended, sorts those that
 * crossed each other, and inserts the chains that begin. Every field that each row reads is an
 * array over the boundaries; the walk of a boundary down its chain is found by the boundary's slot.
 *
 * Invariants, at height y
 *   - exactly those chains with y0 <= y < y1 are listed that the cull keeps in y's row of tiles;
 *   - they are ordered by x at y, then by slope, then by chain: an order that depends on y and the
 *     set alone, not on the rows swept before (so strips agree to the bit);
 *   - x[i] is cs_boundary_x at y on the segment that y crosses.
 */
#ifndef CS_SWEEP_ACTIVE_H
#define CS_SWEEP_ACTIVE_H

#include "geometry/boundary_walk.h"
#include "sweep/advance.h"
#include "sweep/bend.h"
#include "sweep/change.h"
#include "sweep/cull.h"

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
  size_t capacity; /* of each of them */
} cs_active_store;

typedef struct cs_active {
  const cs_boundary_set *set;
  const cs_cull *cull;
  cs_isa isa;
  bool notes_bends; /* false: only x is needed; then bends are noted only for chains that end */
  /* The order: `count` of each, with room for CS_ADVANCE_BATCH more. */
  double *x;      /* at the current height */
  double *x_next; /* at the height advanced to; where the chain ends, if it ends before */
  cs_segments segments;
  cs_crossing *crossing;
  uint32_t *slot;
  size_t count;
  cs_boundary_walk *walks; /* by slot */
  /* The heights. */
  double y;          /* the current height */
  double y_next;     /* the height advanced to */
  double calm_until; /* above this height no chain begins and no other row of tiles does */
  size_t next;       /* the first chain of the set that has not begun */
  int32_t tile_row;  /* in which the current height lies */
  /* What happens between the heights. */
  bool rises;        /* x_next is in order, no two alike */
  cs_bend *bends;    /* in the order of their boundaries */
  uint32_t *bend_of; /* by boundary: the only index in bends where its bend can be */
  celspan_point *vertices;
  size_t bend_count, bend_capacity;
  size_t vertex_count, vertex_capacity;
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
/* Moves boundary places[k] to index low + k, with its x at both heights. To be called between
 * advancing and settling. places: low..low + count - 1 in some order. room: for count numbers. */
void cs_active_permute(cs_active *active, size_t low, size_t count, const uint32_t *places,
                       uint64_t *room);
/* Makes the height advanced to the current one. *change: where boundaries began, ended or changed
 * places; the whole order when another row of tiles has begun. Errors: NO_MEMORY. */
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

static inline const cs_boundary_chain *cs_active_chain(const cs_active *active, size_t i) {
  return &active->set->chains[active->walks[active->slot[i]].chain];
}

/* The bend of boundary i, or NULL. */
static inline const cs_bend *cs_active_bend(const cs_active *active, size_t i) {
  uint32_t at = active->bend_of[i];
  return at < active->bend_count && active->bends[at].boundary == i ? &active->bends[at] : NULL;
}

/* Self-check: whether the boundaries are those that the current height crosses, each at its x, in
 * order, and no other begins while the row is said to be calm. */
bool cs_active_is_ordered(const cs_active *active);

#endif
