#include "compose/cells.h"

#include <math.h>
#include <string.h>

void cs_cells_init(cs_cells *cells) { *cells = (cs_cells){0}; }

void cs_cells_finish(cs_cells *cells, cs_memory *memory) {
  cs_mem_free(memory, cells->cells, cells->cell_capacity * sizeof *cells->cells);
  cs_mem_free(memory, cells->visible, cells->visible_capacity * sizeof *cells->visible);
  *cells = (cs_cells){0};
}

void cs_cells_forget(cs_cells *cells) { cells->known = cells->visible_count = 0; }

static celspan_status make_room(cs_cells *cells, celspan_context *context, size_t count) {
  CS_TRY(cs_mem_reserve(context, (void **)&cells->cells, &cells->cell_capacity, count + 1,
                        sizeof *cells->cells));
  return cs_mem_reserve(context, (void **)&cells->visible, &cells->visible_capacity, count + 1,
                        sizeof *cells->visible);
}

/* The first visible boundary at or right of place i. */
static size_t find_visible(const cs_cells *cells, size_t i) {
  size_t low = 0, high = cells->visible_count;
  while (low < high) {
    size_t middle = (low + high) / 2;
    if (cells->visible[middle] < i)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/* The boundaries [low, high) are to be looked at anew; in the last update high was old_high. */
typedef struct patch {
  size_t low, high, old_high;
  size_t visible;      /* where the first visible one of them goes */
  size_t visible_tail; /* those right of them */
} patch;

/* Opens a gap for the patch's cells and for as many visible boundaries as it may have. */
static patch open_patch(cs_cells *cells, size_t count, cs_change change) {
  size_t old_count = cells->known - 1;
  patch p = {change.low, count - change.tail, old_count - change.tail, 0, 0};
  if (p.high != p.old_high)
    memmove(&cells->cells[p.high + 1], &cells->cells[p.old_high + 1],
            change.tail * sizeof *cells->cells);
  p.visible = find_visible(cells, p.low);
  size_t from = find_visible(cells, p.old_high), to = p.visible + (p.high - p.low);
  p.visible_tail = cells->visible_count - from;
  memmove(&cells->visible[to], &cells->visible[from], p.visible_tail * sizeof *cells->visible);
  for (size_t v = 0; p.high != p.old_high && v < p.visible_tail; v++)
    cells->visible[to + v] += (uint32_t)(p.high - p.old_high);
  return p;
}

static void close_patch(cs_cells *cells, const patch *p, size_t found) {
  size_t from = p->visible + (p->high - p->low), to = p->visible + found;
  memmove(&cells->visible[to], &cells->visible[from], p->visible_tail * sizeof *cells->visible);
  cells->visible_count = to + p->visible_tail;
}

/* A walk along the order with the composer. */
typedef struct walk {
  cs_composer *composer;
  const cs_active *active;
  const cs_toggle *first, *next, *end; /* toggles: next is the first not crossed */
  size_t place;                        /* boundaries crossed */
} walk;

static void walk_to(walk *w, size_t place) {
  const cs_crossing *crossing = w->active->crossing;
  for (; w->place < place; w->place++)
    cs_composer_cross(w->composer, crossing[w->place].leaf, crossing[w->place].direction);
}

/* Leaves the composer with nothing present: on to the right end, or back, whichever is nearer. */
static void walk_home(walk *w) {
  const cs_crossing *crossing = w->active->crossing;
  if (w->place > w->active->count / 2) {
    walk_to(w, w->active->count);
    cs_cells_toggle(w->composer, w->next, w->end, INFINITY);
    return;
  }
  for (; w->place > 0; w->place--)
    cs_composer_cross(w->composer, crossing[w->place - 1].leaf, -crossing[w->place - 1].direction);
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
  patch p = open_patch(cells, active->count, change);
  size_t found = 0;
  walk_to(&w, p.low);
  for (size_t i = p.low; i < p.high; i++) {
    walk_to(&w, i + 1);
    make_cell(cells, &w, i + 1, active->x[i]);
    if (!cs_composer_same(composer, &cells->cells[i + 1], &cells->cells[i]))
      cells->visible[p.visible + found++] = (uint32_t)i;
  }
  close_patch(cells, &p, found);
  walk_home(&w);
  cells->known = active->count + 1;
  return CELSPAN_OK;
}

void cs_cells_carry(cs_cells *cells, const cs_composer *composer, size_t low, size_t count,
                    const cs_cell *const *right) {
  size_t boundaries = cells->known - 1, found = 0;
  patch p = open_patch(cells, boundaries, (cs_change){low, boundaries - (low + count)});
  for (size_t k = 0; k < count; k++) {
    cs_cell *cell = &cells->cells[low + k + 1];
    if (right[k] != cell)
      *cell = *right[k];
    if (!cs_composer_same(composer, cell, cell - 1))
      cells->visible[p.visible + found++] = (uint32_t)(low + k);
  }
  close_patch(cells, &p, found);
}
