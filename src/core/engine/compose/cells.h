/* The cells of a row between its active boundaries, and which boundaries can be seen.
 *
 *     boundary           0        1        2                 3
 *                        |        |        |        :        |        :
 *     cells        0     |   1    |   2    |   3    :        |   4    :
 *                        |        |        |        :        |        :
 *     deferred changes                           culled             culled
 *
 *     the walk:  - - - - - - - - -> * place 2: right of boundaries 0 and 1
 *
 * A boundary that is culled is not active, yet the winding of its layer changes there: such a
 * deferred change takes effect from its x on without being a boundary of its own, and nobody sees
 * it. A cell is composed with the deferred changes at or left of its own left end, neither more nor
 * fewer.
 *
 * Invariants: cells[0] is left of every boundary, cells[i + 1] right of boundary i; a boundary is
 * visible iff the cells on its two sides differ. Cells belong to places in the order, not to
 * boundaries: where the set of layers at a place is the same as before, its cell is kept; cells
 * inside the gaps of an update are not made, and nothing asks for them before the next. So a swap
 * of two boundaries composes one cell and a row without events none. The walk of the composer
 * is not moved between rows: events elsewhere do not change the set of layers at its place.
 */
#pragma once

#include "engine/compose/composer.h"
#include "engine/sweep/active.h"

/* The place of the walk among the deferred winding changes of a row. */
typedef struct cs_deferred_cursor {
  const cs_deferred *first, *next, *end; /* the changes before `next` have been crossed */
} cs_deferred_cursor;

/* Crosses the changes at or left of x. */
static inline void cs_deferred_forward(cs_deferred_cursor *cursor, cs_composer *composer,
                                       double x) {
  const cs_deferred *next = cursor->next;
  for (; next < cursor->end && next->x <= x; next++)
    cs_composer_cross(composer, next->layer, next->direction);
  cursor->next = next;
}

/* The same; also crosses the changes right of x back. */
static inline void cs_deferred_to(cs_deferred_cursor *cursor, cs_composer *composer, double x) {
  cs_deferred_forward(cursor, composer, x);
  for (; cursor->next > cursor->first && cursor->next[-1].x > x; cursor->next--)
    cs_composer_cross(composer, cursor->next[-1].layer, -cursor->next[-1].direction);
}

/* Boundaries [low, high) between which no cells are wanted: the cells right of the first boundary
 * and left of the last one are not made. */
typedef struct cs_cells_gap {
  size_t low, high;
} cs_cells_gap;

/* The hash of a cell that has not been made: in practice no set has this hash. */
static const cs_set_hash cs_cells_unmade = {UINT64_MAX, UINT64_MAX};

typedef struct cs_cells {
  CS_ARRAY(cs_cell, cells);    /* count + 1 in use */
  CS_ARRAY(bool, is_visible);  /* by boundary; room for whole batches (engine/sweep/advance.h) */
  CS_ARRAY(uint32_t, visible); /* if is_listed: the visible boundaries */
  CS_ARRAY(cs_crossing, crossing);
  bool is_listed;
  size_t visible_count;
  size_t known;   /* the number of cells that are known, from the left */
  cs_change gaps; /* around the cells that were not made at the last update */
  /* The walk is right of the first `place` of `count` boundaries, in the order of `crossing`, and
   * past the deferred changes before the cursor. */
  size_t place, count;
  cs_deferred_cursor deferred;
} cs_cells;

void cs_cells_init(cs_cells *cells);
void cs_cells_finish(cs_cells *cells, cs_memory *memory);
/* Brings the cells up to date with the active boundaries. change: where the boundaries differ from
 * those at the last update. gaps: from left to right; cells outside the gaps are made as usual.
 * Errors: NO_MEMORY; failures of composing stay in composer->failure. */
CELSPAN_CHECKED celspan_status cs_cells_update(cs_cells *cells, cs_composer *composer,
                                               const cs_active *active, cs_change change,
                                               const cs_cells_gap *gaps, size_t gap_count);
/* Moves the walk to just left of boundary `place`, right of the deferred changes at or left of x:
 * in the direction that is shorter. */
void cs_cells_walk_to(cs_cells *cells, cs_composer *composer, size_t place, double x);
/* Moves the walk to the left end of the row, where no layer is present. */
void cs_cells_walk_home(cs_cells *cells, cs_composer *composer);
/* Lists the visible boundaries. */
void cs_cells_list(cs_cells *cells);
/* Forgets every cell; the walk stays. */
void cs_cells_forget(cs_cells *cells);
/* The same after a failure: nothing is present at the place of the walk. */
void cs_cells_restart(cs_cells *cells, cs_composer *composer);

/* Self-check: whether the composer's windings and the set of every cell are the same as in a walk
 * from the left end of the row. */
bool cs_cells_are_true(const cs_cells *cells, const cs_composer *composer, const cs_active *active);
