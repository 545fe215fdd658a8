#include "area/commit.h"

static celspan_status note(cs_row_maker *maker, size_t low, size_t count, cs_committed **out) {
  cs_committed *committed = cs_arena_take(
      maker->context, &maker->arena,
      sizeof *committed + count * (sizeof *committed->cells + sizeof *committed->places));
  if (!committed)
    return CELSPAN_NO_MEMORY;
  const cs_cell **cells = (const cs_cell **)(committed + 1);
  *committed = (cs_committed){maker->committed, low, count, cells, (uint32_t *)(cells + count)};
  maker->committed = *out = committed;
  return CELSPAN_OK;
}

/* Whether boundary i is there at the foot. */
static bool goes_on(const cs_active *active, size_t i) {
  const cs_bend *bend = cs_active_bend(active, i);
  return !bend || !bend->ends;
}

celspan_status cs_commit_pair(cs_row_maker *maker, size_t i, const cs_cell *between) {
  cs_committed *committed;
  if (!goes_on(&maker->active, i) || !goes_on(&maker->active, i + 1))
    return CELSPAN_OK;
  CS_TRY(note(maker, i, 2, &committed));
  committed->places[0] = (uint32_t)i + 1;
  committed->places[1] = (uint32_t)i;
  committed->cells[0] = between;
  committed->cells[1] = &maker->cells.cells[i + 2];
  return CELSPAN_OK;
}

/* The cell right of boundary i: a copy where it is that of another place, which may be written to
 * first. */
static celspan_status keep_cell(cs_row_maker *maker, size_t i, const cs_cell *cell,
                                const cs_cell **out) {
  const cs_cell *cells = maker->cells.cells;
  *out = cell;
  if (cell < cells || cell >= cells + maker->cells.known || cell == &cells[i + 1])
    return CELSPAN_OK;
  cs_cell *copy = cs_arena_take(maker->context, &maker->arena, sizeof *copy);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  *copy = *cell;
  *out = copy;
  return CELSPAN_OK;
}

celspan_status cs_commit_cluster(const cs_local_sweep *sweep, size_t low, size_t high) {
  cs_committed *committed;
  size_t count = high - low;
  if (count == 0 || sweep->count != count)
    return CELSPAN_OK;
  for (size_t j = 0; j < count; j++) {
    uint32_t place = sweep->members[j]->place;
    if (place < low || place >= high || !goes_on(&sweep->maker->active, place))
      return CELSPAN_OK;
  }
  CS_TRY(note(sweep->maker, low, count, &committed));
  for (size_t j = 0; j < count; j++) {
    committed->places[j] = sweep->members[j]->place;
    CS_TRY(keep_cell(sweep->maker, low + j, sweep->members[j]->right, &committed->cells[j]));
  }
  return CELSPAN_OK;
}

celspan_status cs_commit_out(cs_row_maker *maker) {
  for (const cs_committed *committed = maker->committed; committed; committed = committed->next) {
    uint64_t *room = cs_arena_take(maker->context, &maker->arena, committed->count * sizeof *room);
    if (!room)
      return CELSPAN_NO_MEMORY;
    cs_active_permute(&maker->active, committed->low, committed->count, committed->places, room);
    cs_cells_commit(&maker->cells, &maker->composer, &maker->active, committed->low,
                    committed->count, committed->cells);
  }
  maker->committed = NULL;
  return CELSPAN_OK;
}
