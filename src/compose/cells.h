/* The cells between the active boundaries of a row, which boundaries can be seen, and where along
 * them the composer stands.
 *
 * Invariants: cells[0] is left of every boundary, cells[i + 1] right of boundary i; a boundary is
 * visible iff the cells on its two sides look different, and then listed once the cells are asked
 * for the list. Cells belong to places in the order, not to boundaries: where the set of leaves at
 * a place is the same as before, its cell is kept; so a swap composes one cell and a row without
 * events none. The composer stays where it was asked for last, from row to row: what happens beside
 * it changes nothing of what is present there.
 */
#ifndef CS_COMPOSE_CELLS_H
#define CS_COMPOSE_CELLS_H

#include "compose/composer.h"
#include "sweep/active.h"

/* Where the composer is among the deferred winding changes of a row: culled boundaries take effect
 * there, unseen. A cell is composed with the changes at or left of its own left end, neither more
 * nor fewer. */
typedef struct cs_deferred_cursor {
  const cs_deferred *first, *next, *end; /* those before next have been crossed */
} cs_deferred_cursor;

/* Crosses the changes up to and at x. */
static inline void cs_deferred_forward(cs_deferred_cursor *cursor, cs_composer *composer,
                                       double x) {
  const cs_deferred *next = cursor->next;
  for (; next < cursor->end && next->x <= x; next++)
    cs_composer_cross(composer, next->layer, next->direction);
  cursor->next = next;
}

/* The same, or back across those right of x. */
static inline void cs_deferred_to(cs_deferred_cursor *cursor, cs_composer *composer, double x) {
  cs_deferred_forward(cursor, composer, x);
  for (; cursor->next > cursor->first && cursor->next[-1].x > x; cursor->next--)
    cs_composer_cross(composer, cursor->next[-1].layer, -cursor->next[-1].direction);
}

/* Crosses the boundaries [low, high): from left to right where sign is 1, back where it is -1. */
static inline void cs_cells_cross(cs_composer *composer, const cs_crossing *crossing, size_t low,
                                  size_t high, int32_t sign) {
  cs_presence *presences = composer->presences;
  uint64_t *set = composer->set;
  uint8_t *filled = composer->filled;
  cs_set_hash hash = composer->hash; /* in registers on the way */
  for (size_t i = low; i < high; i++)
    cs_set_cross(presences, set, filled, &hash, crossing[i].layer, sign * crossing[i].direction);
  composer->hash = hash;
}

typedef struct cs_cells {
  cs_cell *cells;   /* count + 1 in use */
  bool *is_visible; /* by boundary; room for whole batches (sweep/advance.h) */
  bool is_listed;
  uint32_t *visible; /* where is_listed: the visible ones */
  size_t visible_count;
  size_t known; /* cells that were made, from the left */
  /* where the composer is: right of the first `place` of `count` boundaries, in this order, and
   * past the deferred changes before the cursor */
  size_t place, count;
  cs_crossing *crossing;
  cs_deferred_cursor deferred;
  size_t cell_capacity, flag_capacity, visible_capacity, crossing_capacity;
} cs_cells;

void cs_cells_init(cs_cells *cells);
void cs_cells_finish(cs_cells *cells, cs_memory *memory);
/* Brings the cells up to date with the active boundaries. change: where they differ from those of
 * the last update.
 * Errors: NO_MEMORY; what composing meets stays in composer->failure. */
CELSPAN_CHECKED celspan_status cs_cells_update(cs_cells *cells, cs_composer *composer,
                                               const cs_active *active, cs_change change);
/* The boundaries low..low + count - 1 have changed places among themselves, and known cells lie
 * right of them now, of which copies are put there. The composer does not stand between them. */
void cs_cells_commit(cs_cells *cells, const cs_composer *composer, const cs_active *active,
                     size_t low, size_t count, const cs_cell *const *right);
/* Lets the composer stand left of boundary `place`, right of the toggles at or left of x. */
void cs_cells_stand(cs_cells *cells, cs_composer *composer, size_t place, double x);
/* Lets it stand where nothing is present. */
void cs_cells_home(cs_cells *cells, cs_composer *composer);
/* Lists the visible boundaries. */
void cs_cells_list(cs_cells *cells);
/* Forgets every cell; the composer stays. */
void cs_cells_forget(cs_cells *cells);
/* The same after a failure: nothing is present where the composer stands. */
void cs_cells_restart(cs_cells *cells, cs_composer *composer);

/* Self-check: whether the composer's windings and the set of every cell are those of a walk from the
 * left end of the row. */
bool cs_cells_are_true(const cs_cells *cells, const cs_composer *composer,
                       const cs_active *active);

#endif
