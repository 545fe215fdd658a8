#include "area/commit.h"

static celspan_status note(cs_commit *commit, size_t low, size_t count, cs_committed **out) {
  cs_committed *committed = cs_arena_take(
      commit->composer->context, commit->arena,
      sizeof *committed + count * (sizeof *committed->cells + sizeof *committed->places));
  if (!committed)
    return CELSPAN_NO_MEMORY;
  const cs_cell **cells = (const cs_cell **)(committed + 1);
  *committed = (cs_committed){commit->first, low, count, cells, (uint32_t *)(cells + count)};
  commit->first = *out = committed;
  return CELSPAN_OK;
}

/* Whether boundary i is still there at the foot of the row. */
static bool goes_on(const cs_active *active, size_t i) {
  const cs_bend *bend = cs_active_bend(active, i);
  return !bend || !bend->ends;
}

celspan_status cs_commit_pair(cs_commit *commit, size_t i, const cs_cell *between) {
  cs_committed *committed;
  if (!goes_on(commit->active, i) || !goes_on(commit->active, i + 1))
    return CELSPAN_OK;
  CS_TRY(note(commit, i, 2, &committed));
  committed->places[0] = (uint32_t)i + 1;
  committed->places[1] = (uint32_t)i;
  committed->cells[0] = between;
  committed->cells[1] = &commit->cells->cells[i + 2];
  return CELSPAN_OK;
}

/* The cell right of boundary i. Where it is that of another place, a copy is kept: that place may
 * be written to first. */
static celspan_status keep_cell(cs_commit *commit, size_t i, const cs_cell *cell,
                                const cs_cell **out) {
  const cs_cell *cells = commit->cells->cells;
  *out = cell;
  if (cell < cells || cell >= cells + commit->cells->known || cell == &cells[i + 1])
    return CELSPAN_OK;
  cs_cell *copy = cs_arena_take(commit->composer->context, commit->arena, sizeof *copy);
  if (!copy)
    return CELSPAN_NO_MEMORY;
  *copy = *cell;
  *out = copy;
  return CELSPAN_OK;
}

celspan_status cs_commit_sweep(cs_commit *commit, const cs_local_sweep *sweep, size_t low,
                               size_t high) {
  cs_committed *committed;
  size_t count = high - low;
  if (count == 0 || sweep->count != count)
    return CELSPAN_OK;
  for (size_t j = 0; j < count; j++) {
    uint32_t place = sweep->members[j]->place;
    if (place < low || place >= high || !goes_on(commit->active, place))
      return CELSPAN_OK;
  }
  CS_TRY(note(commit, low, count, &committed));
  for (size_t j = 0; j < count; j++) {
    committed->places[j] = sweep->members[j]->place;
    CS_TRY(keep_cell(commit, low + j, sweep->members[j]->right, &committed->cells[j]));
  }
  return CELSPAN_OK;
}

celspan_status cs_commit_apply(cs_commit *commit) {
  for (const cs_committed *committed = commit->first; committed; committed = committed->next) {
    uint64_t *room =
        cs_arena_take(commit->composer->context, commit->arena, committed->count * sizeof *room);
    if (!room)
      return CELSPAN_NO_MEMORY;
    cs_active_permute(commit->active, committed->low, committed->count, committed->places, room);
    cs_cells_commit(commit->cells, commit->composer, commit->active, committed->low,
                    committed->count, committed->cells);
  }
  commit->first = NULL;
  return CELSPAN_OK;
}
