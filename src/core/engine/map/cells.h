/* The cells of a map that is being filled, found by their contents.
 *
 * Invariant: no two cells of the map have the same contents, and cells are numbered in the order in
 * which they were first requested.
 */
#pragma once

#include "engine/map/map.h"

typedef struct cs_map_cells {
  cs_map *map;               /* borrowed */
  CS_ARRAY(uint32_t, table); /* the number of a cell plus 1; 0: free. A power of two */
} cs_map_cells;

/* The contents of a cell: a colour where length is 0, otherwise a program. */
typedef struct cs_map_content {
  cs_v4 colour;
  /* of a colour in a coloured map: the light that this colour transmits; otherwise 0 */
  cs_v4 through;
  const cs_item *items;
  uint32_t length;
} cs_map_content;

void cs_map_cells_finish(cs_map_cells *cells, cs_memory *memory);
/* Empties the map's list of cells. */
void cs_map_cells_clear(cs_map_cells *cells);
/* The number of the cell with these contents, which is appended to the map if it is new. If there
 * are too many cells the map is not whole. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_map_cells_find(celspan_context *context, cs_map_cells *cells,
                                                 cs_map_content what, uint32_t *out);

/* Whether a program dims all channels alike, whatever its layers show: all its layers do so, or
 * nothing shines through one of them. */
bool cs_map_cells_is_even(const cs_stack *stack, const cs_item *items, uint32_t length);

/* Finds which of the map's cells hide their background: nothing shines through some layer of
 * their program, which is in no group. */
void cs_map_cells_find_hiding(cs_map *map, const cs_stack *stack);
