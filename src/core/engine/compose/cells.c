#include "engine/compose/cells.h"

#include <math.h>
#include <string.h>

void cs_cells_init(cs_cells *cells) { *cells = (cs_cells){.gaps = cs_change_none}; }

void cs_cells_finish(cs_cells *cells, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, cells, cells, crossing);
  *cells = (cs_cells){0};
}

void cs_cells_forget(cs_cells *cells) {
  cells->known = cells->visible_count = 0;
  cells->is_listed = false;
}

static celspan_status make_room(cs_cells *cells, celspan_context *context, size_t count) {
  CS_TRY(CS_ARRAY_RESERVE(context, cells->cells, count + 1));
  CS_TRY(CS_ARRAY_RESERVE(context, cells->is_visible, count + CS_ADVANCE_BATCH));
  CS_TRY(CS_ARRAY_RESERVE(context, cells->crossing, count + 1));
  return CS_ARRAY_RESERVE(context, cells->visible, count + 1);
}

void cs_cells_list(cs_cells *cells) {
  size_t found = 0, count = cells->known - 1;
  const bool *is_visible = cells->is_visible;
  uint32_t *visible = cells->visible;
  if (cells->is_listed)
    return;
  /* no branch: the processor can hardly predict which boundaries are visible */
  for (size_t i = 0; i < count; i++) {
    visible[found] = (uint32_t)i;
    found += is_visible[i];
  }
  cells->visible_count = found;
  cells->is_listed = true;
}

/* Moves the items of the last `tail` boundaries to their places among `count`. */
static void move_tail(cs_cells *cells, size_t count, size_t tail) {
  size_t to = count - tail, from = cells->known - 1 - tail;
  if (to == from)
    return;
  memmove(&cells->cells[to + 1], &cells->cells[from + 1], tail * sizeof *cells->cells);
  memmove(&cells->is_visible[to], &cells->is_visible[from], tail * sizeof *cells->is_visible);
}

/* ---------------------------------------------------------------- the walk */

/* Crosses the boundaries [low, high): from left to right where sign is 1, back where it is -1. */
static void cross(cs_composer *composer, const cs_crossing *crossing, size_t low, size_t high,
                  int32_t sign) {
  cs_presence *presences = composer->presences;
  uint64_t *set = composer->set;
  uint8_t *filled = composer->filled;
  cs_set_hash hash = composer->hash; /* in a register during the loop */
  for (size_t i = low; i < high; i++)
    cs_set_cross(presences, set, filled, &hash, crossing[i].layer, sign * crossing[i].direction);
  composer->hash = hash;
}

static void cross_to(cs_cells *cells, cs_composer *composer, size_t place) {
  if (cells->place < place)
    cross(composer, cells->crossing, cells->place, place, 1);
  else
    cross(composer, cells->crossing, place, cells->place, -1);
  cells->place = place;
}

/* Leaves the row at one end and enters it at the other: no layer is present at either end, so the
 * two ends are the same place. */
static void walk_round(cs_cells *cells, cs_composer *composer, bool goes_right) {
  cross_to(cells, composer, goes_right ? cells->count : 0);
  cs_deferred_to(&cells->deferred, composer, goes_right ? INFINITY : -INFINITY);
  cells->place = goes_right ? 0 : cells->count;
  cells->deferred.next = goes_right ? cells->deferred.first : cells->deferred.end;
}

void cs_cells_walk_to(cs_cells *cells, cs_composer *composer, size_t place, double x) {
  size_t from = cells->place, away = place > from ? place - from : from - place;
  if (2 * away > cells->count) /* the way across the ends of the row is shorter */
    walk_round(cells, composer, place < from);
  cross_to(cells, composer, place);
  cs_deferred_to(&cells->deferred, composer, x);
}

void cs_cells_walk_home(cs_cells *cells, cs_composer *composer) {
  if (2 * cells->place > cells->count)
    walk_round(cells, composer, true);
  cross_to(cells, composer, 0);
  cs_deferred_to(&cells->deferred, composer, -INFINITY);
}

void cs_cells_restart(cs_cells *cells, cs_composer *composer) {
  cs_composer_restart(composer);
  cs_cells_forget(cells);
  cells->place = 0;
  cells->deferred.next = cells->deferred.first;
}

/* Adopts the new order of boundaries. Outside the range that changed, the windings are the same as
 * before, so the walk must move only if its place is inside this range. */
static void adopt_order(cs_cells *cells, cs_composer *composer, const cs_active *active,
                        cs_change change) {
  size_t high = cells->count - change.tail;
  if (change.low == 0 && change.tail == 0)
    cs_cells_walk_home(cells, composer);
  else if (cells->place > change.low && cells->place < high)
    cross_to(cells, composer, change.low);
  if (cells->place > change.low)
    cells->place += active->count - cells->count;
  size_t end = active->count == cells->count ? active->count - change.tail : active->count;
  cells->count = active->count;
  if (end > change.low)
    memcpy(cells->crossing + change.low, active->crossing + change.low,
           (end - change.low) * sizeof *cells->crossing);
  if (change.low > 0 || change.tail > 0)
    return;
  cells->deferred.first = cells->deferred.next = cs_active_deferred(active, &cells->deferred.end);
}

/* ---------------------------------------------------------------- making */

/* The cell right of i boundaries, which is at the place of the walk. Returns whether it has
 * changed. */
static inline bool make_cell(cs_cells *cells, cs_composer *composer, size_t i) {
  cs_cell *cell = &cells->cells[i];
  bool is_new = i >= cells->known || !cs_set_hash_same(cell->hash, composer->hash);
  if (is_new)
    cs_composer_cell(composer, cell);
  return is_new;
}

/* Moves the walk across the next boundary on its right, which is at x. */
static inline void cross_next(cs_cells *cells, cs_composer *composer, double x) {
  cs_crossing crossing = cells->crossing[cells->place++];
  cs_composer_cross(composer, crossing.layer, crossing.direction);
  cs_deferred_forward(&cells->deferred, composer, x);
}

/* Makes the cells right of the boundaries [first, end). The walk is at the first of these. */
static void make_cells(cs_cells *cells, cs_composer *composer, const cs_active *active,
                       size_t first, size_t end) {
  for (size_t i = first, is_new = true; i < end; i++) {
    bool was_new = is_new;
    cross_next(cells, composer, active->x[i]);
    is_new = make_cell(cells, composer, i + 1);
    if (was_new || is_new)
      cells->is_visible[i] = !cs_composer_same(composer, &cells->cells[i + 1], &cells->cells[i]);
  }
}

/* The same for cells that are left out. */
static void leave_out(cs_cells *cells, cs_composer *composer, const cs_active *active, size_t first,
                      size_t end) {
  for (size_t i = first; i < end; i++) {
    cross_next(cells, composer, active->x[i]);
    cells->cells[i + 1] = (cs_cell){.hash = cs_cells_unmade};
    cells->is_visible[i] = true;
  }
}

static inline size_t within(size_t place, size_t least, size_t most) {
  return place < least ? least : place > most ? most : place;
}

/* Walks through a range of boundaries. The walk is at the first boundary of the range. */
static void go_through(cs_cells *cells, cs_composer *composer, const cs_active *active,
                       cs_cells_gap range, const cs_cells_gap *gaps, size_t gap_count) {
  size_t i = range.low;
  for (size_t k = 0; k < gap_count; k++) {
    size_t low = within(gaps[k].low, i, range.high),
           last = within(gaps[k].high - 1, low, range.high);
    make_cells(cells, composer, active, i, low);
    leave_out(cells, composer, active, low, last);
    i = last;
  }
  make_cells(cells, composer, active, i, range.high);
}

celspan_status cs_cells_update(cs_cells *cells, cs_composer *composer, const cs_active *active,
                               cs_change change, const cs_cells_gap *gaps, size_t gap_count) {
  CS_TRY(make_room(cells, composer->context, active->count));
  change = cells->known == 0 ? cs_change_all : cs_change_join(change, cells->gaps);
  cells->gaps = cs_change_none;
  if (cs_change_is_none(change))
    return CELSPAN_OK;
  if (gap_count > 0)
    cells->gaps = (cs_change){gaps[0].low, active->count - gaps[gap_count - 1].high};
  adopt_order(cells, composer, active, change);
  cs_cells_walk_to(cells, composer, change.low, change.low > 0 ? active->x[change.low - 1] : 0);
  if (change.low == 0)
    make_cell(cells, composer, 0);
  if (cells->known == 0)
    cells->known = 1; /* the cell that was just made */
  move_tail(cells, active->count, change.tail);
  go_through(cells, composer, active, (cs_cells_gap){change.low, active->count - change.tail}, gaps,
             gap_count);
  cells->is_listed = false;
  cells->known = active->count + 1;
  return CELSPAN_OK;
}
