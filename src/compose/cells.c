#include "compose/cells.h"

#include <math.h>
#include <string.h>

void cs_cells_init(cs_cells *cells) { *cells = (cs_cells){0}; }

void cs_cells_finish(cs_cells *cells, cs_memory *memory) {
  cs_mem_free(memory, cells->cells, cells->cell_capacity * sizeof *cells->cells);
  cs_mem_free(memory, cells->is_visible, cells->flag_capacity * sizeof *cells->is_visible);
  cs_mem_free(memory, cells->visible, cells->visible_capacity * sizeof *cells->visible);
  *cells = (cs_cells){0};
}

void cs_cells_forget(cs_cells *cells) {
  cells->known = cells->visible_count = 0;
  cells->is_listed = false;
}

static celspan_status make_room(cs_cells *cells, celspan_context *context, size_t count) {
  CS_TRY(cs_mem_reserve(context, (void **)&cells->cells, &cells->cell_capacity, count + 1,
                        sizeof *cells->cells));
  CS_TRY(cs_mem_reserve(context, (void **)&cells->is_visible, &cells->flag_capacity,
                        count + CS_ADVANCE_BATCH, sizeof *cells->is_visible));
  return cs_mem_reserve(context, (void **)&cells->visible, &cells->visible_capacity, count + 1,
                        sizeof *cells->visible);
}

void cs_cells_list(cs_cells *cells) {
  size_t found = 0, count = cells->known - 1;
  const bool *is_visible = cells->is_visible;
  uint32_t *visible = cells->visible;
  if (cells->is_listed)
    return;
  for (size_t i = 0; i < count; i++) { /* which are visible cannot be foreseen: no branch */
    visible[found] = (uint32_t)i;
    found += is_visible[i];
  }
  cells->visible_count = found;
  cells->is_listed = true;
}

/* Moves what belongs to the last `tail` boundaries to where they stand among `count`. */
static void move_tail(cs_cells *cells, size_t count, size_t tail) {
  size_t to = count - tail, from = cells->known - 1 - tail;
  if (to == from)
    return;
  memmove(&cells->cells[to + 1], &cells->cells[from + 1], tail * sizeof *cells->cells);
  memmove(&cells->is_visible[to], &cells->is_visible[from], tail * sizeof *cells->is_visible);
}

/* A walk along the order with the composer. */
typedef struct walk {
  cs_composer *composer;
  const cs_active *active;
  const cs_toggle *first, *next, *end; /* toggles: next is the first not crossed */
  size_t place;                        /* boundaries crossed */
} walk;

static void walk_to(walk *w, size_t place) {
  if (w->place < place)
    cs_cells_cross(w->composer, w->active, w->place, place, 1);
  w->place = place;
}

/* Leaves the composer with nothing present: on to the right end, or back, whichever is nearer. */
static void walk_home(walk *w) {
  if (w->place > w->active->count / 2) {
    walk_to(w, w->active->count);
    cs_cells_toggle(w->composer, w->next, w->end, INFINITY);
    return;
  }
  cs_cells_cross(w->composer, w->active, 0, w->place, -1);
  for (; w->next > w->first; w->next--)
    cs_composer_cross(w->composer, w->next[-1].leaf, -w->next[-1].direction);
}

/* The cell right of boundary i, whose left end is at x. */
static void make_cell(cs_cells *cells, walk *w, size_t i, double x) {
  cs_cell *cell = &cells->cells[i];
  w->next = cs_cells_toggle(w->composer, w->next, w->end, x);
  if (i >= cells->known || !cs_set_hash_same(cell->hash, w->composer->hash))
    cs_composer_cell(w->composer, cell);
}

celspan_status cs_cells_update(cs_cells *cells, cs_composer *composer, const cs_active *active,
                               cs_change change) {
  CS_TRY(make_room(cells, composer->context, active->count));
  walk w = {.composer = composer, .active = active};
  w.first = w.next = cs_active_toggles(active, &w.end);
  if (cells->known == 0)
    change = cs_change_all;
  if (change.low == 0)
    make_cell(cells, &w, 0, 0);
  if (cells->known == 0)
    cells->known = 1; /* the one just made */
  move_tail(cells, active->count, change.tail);
  walk_to(&w, change.low);
  for (size_t i = change.low; i < active->count - change.tail; i++) {
    walk_to(&w, i + 1);
    make_cell(cells, &w, i + 1, active->x[i]);
    cells->is_visible[i] = !cs_composer_same(composer, &cells->cells[i + 1], &cells->cells[i]);
  }
  cells->is_listed = false;
  walk_home(&w);
  cells->known = active->count + 1;
  return CELSPAN_OK;
}

void cs_cells_carry(cs_cells *cells, const cs_composer *composer, size_t low, size_t count,
                    const cs_cell *const *right) {
  for (size_t k = 0; k < count; k++) {
    cs_cell *cell = &cells->cells[low + k + 1];
    if (right[k] != cell)
      *cell = *right[k];
    cells->is_visible[low + k] = !cs_composer_same(composer, cell, cell - 1);
  }
  cells->is_listed = false;
}
