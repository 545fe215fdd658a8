/* Local sweeps: the small groups of boundaries that cross, begin or end inside a row of pixels are
 * followed from its top to its foot, event by event.
 *
 *     y0  ------a-----b-----c---------   members at the top of the row, from left to right
 *                \   /      |
 *        slab     \ /       |
 *                  x        |            intersection: a and b change places, and the one cell
 *                 / \       |            between them is composed
 *     y   -------b---a------c------d--   c ends and d begins: the next slab begins here
 *        slab    |    \           /
 *     y1  -------b-----a---------d----
 *
 *   slab          the heights between two at which some member begins or ends
 *   intersection  two neighbours cross inside a slab (intersections.h)
 *
 * Intersections are found from the highest to the lowest. Their cells are then composed place by
 * place: what is visible right of a place depends on the intersections there alone, so the composer
 * goes from one to the next with few crossings. Swaps are always of neighbours, so an order exists
 * at every moment and the work is bounded by the number of inversions.
 *
 * Invariant: the effect of a local sweep is closed: left of it and right of it the sets of layers
 * present stay the same through the row. It knows only the members of its struct.
 */
#pragma once

#include "engine/area/extent.h"
#include "engine/area/intersections.h"
#include "engine/area/window.h"
#include "engine/compose/cells.h"
#include "engine/kernel/retained.h"

/* Where the borders of a row go: to the window, which makes the row's pixels, or into a row
 * of retained edges, for filters that extend over several rows.
 *
 *   lone boundaries --+                    +--> cs_window         pixels and spans of this row
 *                     +--> borders: target 
 *   local sweeps   ---+                    +--> cs_retained_row   kept for kernel/, no pixels
 *
 * Invariant: items (lone boundaries and local sweeps) come from left to right; `retained` does not
 * change between the beginning and the end of a row.
 */

typedef struct cs_target {
  cs_window window;
  cs_retained_row *retained; /* borrowed; NULL: the window has the borders */
} cs_target;

/* Begins an item whose least x is `x`. */
static inline CELSPAN_CHECKED celspan_status cs_target_begin_item(cs_target *target, double x) {
  return target->retained ? CELSPAN_OK : cs_window_begin_item(&target->window, x);
}

/* A border of the current item. */
static inline CELSPAN_CHECKED celspan_status cs_target_add(cs_target *target,
                                                           const cs_border *border) {
  return target->retained
             ? cs_retained_add(target->retained, target->window.composer->context, border)
             : cs_window_add(&target->window, border);
}

/* One boundary of a local sweep: a polyline that goes down from the place where the boundary enters
 * the row or begins. */
typedef struct cs_member {
  const celspan_point *points; /* ascending in y */
  uint32_t point_count;
  /* the segment that contains y ends at points[at]; point_count: the member has ended */
  uint32_t at;
  uint32_t layer;
  uint32_t span; /* the span of a procedure; UINT32_MAX for a chain */
  /* decides between equal members: the chain, or the edge of the procedure's span */
  uint32_t order;
  int32_t direction;
  double x, y; /* the segments of the member have been drawn down to here */
  double foot; /* x at the foot of the current slab */
  const cs_cell *right;
} cs_member;

static inline cs_extent cs_member_extent(const cs_member *member) {
  cs_extent extent = cs_extent_nowhere();
  for (uint32_t k = 0; k < member->point_count; k++)
    cs_extent_add(&extent, member->points[k].x);
  return extent;
}

static inline void cs_member_cross(const cs_member *member, cs_composer *composer, int32_t sign) {
  if (member->span == UINT32_MAX)
    cs_composer_cross(composer, member->layer, sign * member->direction);
  else
    cs_composer_cross_span(composer, member->layer, member->span, sign * member->direction);
}

typedef struct cs_local_sweep {
  cs_composer *composer; /* borrowed */
  cs_arena *arena;       /* borrowed: of the row, for cells */
  cs_target *target;     /* borrowed: gets the borders */
  /* given for each replay */
  double y0, y1;       /* the row, or a slab of it */
  const cs_cell *left; /* the cell left of all members */
  cs_member *begins;   /* members that have not begun yet, by height, then x, then order */
  size_t begin_count;
  cs_deferred_cursor deferred; /* starts at the least x of the members */
  /* while it runs */
  cs_member **members; /* the members at the current height, in order */
  size_t count;
  cs_member **spare; /* room for the same number of members */
  /* the cell right of each place at the foot of a slab; room for as many as members */
  const cs_cell **cells_below;
  size_t crossed; /* how many members are left of the composer, */
  bool is_low;    /* counted in their order at the foot of the slab, not at its top */
  /* memory of the sweep, kept from one replay to the next */
  cs_intersections intersections;
  CS_ARRAY(cs_member, entering); /* the members at the top of the row */
  CS_ARRAY(void *, lists);       /* for members, spare and cells_below */
} cs_local_sweep;

void cs_local_sweep_init(cs_local_sweep *sweep, cs_composer *composer, cs_arena *arena,
                         cs_target *target);
void cs_local_sweep_finish(cs_local_sweep *sweep, cs_memory *memory);
/* Makes room for `count` members at the top of the row, which the caller then fills through
 * `members`, and for the members that begin. The caller has set y0, y1, left, begins and
 * begin_count. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_local_sweep_begin(cs_local_sweep *sweep, size_t count);
/* Sets the input: `count` members at the top of the row, then the members that begin inside the
 * row. */
static inline cs_member *cs_local_sweep_member(const cs_local_sweep *sweep, size_t i) {
  return i < sweep->count ? &sweep->entering[i] : &sweep->begins[i - sweep->count];
}

/* The extent of the members in the row. */
cs_extent cs_local_sweep_extent(const cs_local_sweep *sweep);
/* Draws the members through the row. The composer is left of all members, before and after the
 * call. */
CELSPAN_CHECKED celspan_status cs_local_sweep_replay(cs_local_sweep *sweep);
