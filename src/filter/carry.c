#include "filter/carry.h"

static celspan_status note(cs_scan *scan, size_t low, size_t count, cs_carried **out) {
  cs_carried *carried = cs_arena_take(
      scan->context, &scan->arena,
      sizeof *carried + count * (sizeof *carried->cells + sizeof *carried->places));
  if (!carried)
    return CELSPAN_NO_MEMORY;
  const cs_cell **cells = (const cs_cell **)(carried + 1);
  *carried = (cs_carried){scan->carried, low, count, cells, (uint32_t *)(cells + count)};
  scan->carried = *out = carried;
  return CELSPAN_OK;
}

/* Whether boundary i is there at the foot. */
static bool goes_on(const cs_active *active, size_t i) {
  const cs_bend *bend = cs_active_bend(active, i);
  return !bend || !bend->ends;
}

celspan_status cs_carry_pair(cs_scan *scan, size_t i, const cs_cell *between) {
  cs_carried *carried;
  if (!goes_on(&scan->active, i) || !goes_on(&scan->active, i + 1))
    return CELSPAN_OK;
  CS_TRY(note(scan, i, 2, &carried));
  carried->places[0] = (uint32_t)i + 1;
  carried->places[1] = (uint32_t)i;
  carried->cells[0] = between;
  carried->cells[1] = &scan->cells.cells[i + 2];
  return CELSPAN_OK;
}

/* The cell right of boundary i: a copy where it is that of another place, which may be written to
 * first. */
static celspan_status keep_cell(cs_scan *scan, size_t i, const cs_cell *cell,
                                const cs_cell **out) {
  const cs_cell *cells = scan->cells.cells;
  *out = cell;
  if (cell < cells || cell >= cells + scan->cells.known || cell == &cells[i + 1])
    return CELSPAN_OK;
  cs_cell *copy = cs_arena_take(scan->context, &scan->arena, sizeof *copy);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  *copy = *cell;
  *out = copy;
  return CELSPAN_OK;
}

celspan_status cs_carry_cluster(const cs_cluster *cluster, size_t low, size_t high) {
  cs_carried *carried;
  size_t count = high - low;
  if (count == 0 || cluster->count != count)
    return CELSPAN_OK;
  for (size_t j = 0; j < count; j++) {
    uint32_t place = cluster->members[j]->place;
    if (place < low || place >= high || !goes_on(&cluster->scan->active, place))
      return CELSPAN_OK;
  }
  CS_TRY(note(cluster->scan, low, count, &carried));
  for (size_t j = 0; j < count; j++) {
    carried->places[j] = cluster->members[j]->place;
    CS_TRY(keep_cell(cluster->scan, low + j, cluster->members[j]->right, &carried->cells[j]));
  }
  return CELSPAN_OK;
}

celspan_status cs_carry_out(cs_scan *scan) {
  for (const cs_carried *carried = scan->carried; carried; carried = carried->next) {
    uint64_t *room = cs_arena_take(scan->context, &scan->arena, carried->count * sizeof *room);
    if (!room)
      return CELSPAN_NO_MEMORY;
    cs_active_permute(&scan->active, carried->low, carried->count, carried->places, room);
    cs_cells_carry(&scan->cells, &scan->composer, &scan->active, carried->low, carried->count,
                   carried->cells);
  }
  scan->carried = NULL;
  return CELSPAN_OK;
}
