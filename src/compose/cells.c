#include "compose/cells.h"

#include <math.h>

void cs_cells_init(cs_cells *cells) { *cells = (cs_cells){0}; }

void cs_cells_finish(cs_cells *cells, cs_memory *memory) {
  cs_mem_free(memory, cells->cells, cells->cell_capacity * sizeof *cells->cells);
  cs_mem_free(memory, cells->visible, cells->visible_capacity * sizeof *cells->visible);
  *cells = (cs_cells){0};
}

void cs_cells_forget(cs_cells *cells) { cells->known = 0; }

celspan_status cs_cells_update(cs_cells *cells, cs_composer *composer, const cs_active *active) {
  celspan_context *context = composer->context;
  CS_TRY(cs_mem_reserve(context, (void **)&cells->cells, &cells->cell_capacity, active->count + 1,
                        sizeof *cells->cells));
  CS_TRY(cs_mem_reserve(context, (void **)&cells->visible, &cells->visible_capacity,
                        active->count + 1, sizeof *cells->visible));
  const cs_toggle *end, *toggle = cs_active_toggles(active, &end);
  toggle = cs_cells_toggle(composer, toggle, end, 0);
  if (cells->known == 0 || !cs_set_hash_same(cells->cells[0].hash, composer->hash))
    cs_composer_cell(composer, &cells->cells[0]);
  cells->visible_count = 0;
  for (size_t i = 0; i < active->count; i++) {
    const cs_boundary_chain *chain = cs_active_chain(active, i);
    cs_cell *cell = &cells->cells[i + 1];
    toggle = cs_cells_toggle(composer, toggle, end, active->x[i]);
    cs_composer_cross(composer, chain->leaf, chain->direction);
    if (i + 1 >= cells->known || !cs_set_hash_same(cell->hash, composer->hash))
      cs_composer_cell(composer, cell);
    if (!cs_composer_same(composer, cell, cell - 1))
      cells->visible[cells->visible_count++] = (uint32_t)i;
  }
  cs_cells_toggle(composer, toggle, end, INFINITY);
  cells->known = active->count + 1;
  return CELSPAN_OK;
}
