/* The active boundaries: the chains that a row height crosses, from left to right.
 *
 * The fields that every row reads lie in arrays of like fields, in order, so that advancing and
 * order checking run at memory speed; the walk of a boundary is found by its slot.
 *
 * Invariants, at height y
 *   - exactly the chains with y0 <= y < y1 are listed that the cull keeps in y's row of tiles;
 *   - they are ordered by x at y, then by slope, then by chain: an order that depends on y and the
 *     set alone, not on the rows swept before (so strips agree to the bit);
 *   - x[i] is cs_boundary_x at y on the segment that holds y.
 */
#ifndef CS_SWEEP_ACTIVE_H
#define CS_SWEEP_ACTIVE_H

#include "sweep/advance.h"
#include "sweep/cull.h"

/* What a boundary does between two heights, when that is not one straight piece. */
typedef struct cs_bend {
  uint32_t boundary; /* index into the order at the upper height */
  uint32_t vertex;   /* its vertices strictly between the heights: downwards */
  uint32_t vertex_count;
  bool ends;        /* it is not there at the lower height */
  bool ends_above;  /* it ended before, at its last vertex */
  double low, high; /* the least and the greatest x on the way, both ends included */
} cs_bend;

/* What crossing a boundary from left to right changes. */
typedef struct cs_crossing {
  uint32_t layer;
  int32_t direction;
} cs_crossing;

/* Where the order at a height differs from the one before: the boundaries left of place `low` and
 * the last `tail` ones are the same as before, and what lies between two of them too. */
typedef struct cs_change {
  size_t low, tail;
} cs_change;

static const cs_change cs_change_none = {SIZE_MAX, SIZE_MAX};
static const cs_change cs_change_all = {0, 0};

static inline bool cs_change_is_none(cs_change change) { return change.low == SIZE_MAX; }

static inline cs_change cs_change_join(cs_change a, cs_change b) {
  return (cs_change){a.low < b.low ? a.low : b.low, a.tail < b.tail ? a.tail : b.tail};
}

typedef struct cs_active {
  const cs_boundary_set *set;
  const cs_cull *cull;
  cs_isa isa;
  int32_t tile_row; /* that holds the current height */
  /* arrays of like fields, `count` of each, in order, with room for CS_ADVANCE_BATCH more */
  double *x;      /* at the current height */
  double *x_next; /* at the height reached; where the chain ends, if it ends before */
  double *x0, *y0, *slope, *curve, *y1; /* the segment: its top, how x goes on, its bottom */
  cs_crossing *crossing;
  uint32_t *slot;
  size_t count;
  bool rises;       /* x_next is in order, no two alike */
  bool notes_bends; /* false: only where boundaries stand counts, bends hold those that end */
  /* by slot */
  cs_boundary_walk *walks;
  uint32_t *free_slots;
  size_t free_count;
  uint32_t *ended;   /* scratch: whose segments end on the way */
  void *block;       /* that holds all the arrays above */
  size_t capacity;   /* of each of them */
  size_t next;       /* the first chain of the set that has not begun */
  double y;          /* the current height */
  double y_next;     /* the height reached */
  double calm_until; /* above this height no chain begins, and no other row of tiles */
  cs_bend *bends;    /* between the two, in order of their boundaries */
  uint32_t *bend_of; /* by boundary: the only place in bends where its bend may be */
  celspan_point *vertices;
  size_t bend_count, bend_capacity;
  size_t vertex_count, vertex_capacity;
} cs_active;

void cs_active_init(cs_active *active, const cs_boundary_set *set, const cs_cull *cull);
void cs_active_finish(cs_active *active, cs_memory *memory);
/* Stands at height y, from nothing. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_active_start(celspan_context *context, cs_active *active,
                                               double y);
/* Looks down to height y, at or below the current one: fills x_next and bends; the order stays as
 * it is at the current height. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_active_reach(celspan_context *context, cs_active *active,
                                               double y);
/* Puts boundary places[k] at place low + k, as it stands at both heights; between reach and settle.
 * places: low..low + count - 1 in some order. room: for count numbers. */
void cs_active_permute(cs_active *active, size_t low, size_t count, const uint32_t *places,
                       uint64_t *room);
/* Moves down to the height reached. *change: where boundaries began, ended or changed places; all
 * of the order when another row of tiles has begun.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_active_settle(celspan_context *context, cs_active *active,
                                                cs_change *change);

/* The toggles that stand for culled chains at the current height, from left to right. */
static inline const cs_deferred *cs_active_deferred(const cs_active *active,
                                                    const cs_deferred **end) {
  const cs_cull *cull = active->cull;
  if (cull->tile_rows == 0)
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
