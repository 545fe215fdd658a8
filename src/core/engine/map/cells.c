#include "engine/map/cells.h"

#include "base/splitmix.h"
#include "engine/compose/over.h"

void cs_map_cells_finish(cs_map_cells *cells, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, cells, table, table);
  *cells = (cs_map_cells){0};
}

void cs_map_cells_clear(cs_map_cells *cells) {
  if (cells->table)
    memset(cells->table, 0, CS_ARRAYS_BYTES(cells, table, table));
  cells->map->cell_count = cells->map->item_count = 0;
}

/* ---------------------------------------------------------------- contents */

static uint64_t mix(uint64_t word) { return cs_splitmix_next(&word); }

static cs_map_content content_of(const cs_map *map, uint32_t cell) {
  const cs_map_cell *of = &map->cells[cell];
  return (cs_map_content){of->colour, map->through ? map->through[cell] : cs_v4_all(0),
                          of->length > 0 ? map->items + of->item : NULL, of->length};
}

static bool is_content(cs_map_content a, cs_map_content b) {
  return a.length == b.length && memcmp(&a.colour, &b.colour, sizeof a.colour) == 0 &&
         memcmp(&a.through, &b.through, sizeof a.through) == 0 &&
         (a.length == 0 || memcmp(a.items, b.items, a.length * sizeof *a.items) == 0);
}

static size_t place_of(const cs_map_cells *cells, cs_map_content what) {
  uint64_t words[2], media[2], name = what.length;
  memcpy(words, &what.colour, sizeof words);
  memcpy(media, &what.through, sizeof media);
  name = mix(name ^ media[0]) ^ media[1];
  for (uint32_t i = 0; i < what.length; i++)
    name = mix(name ^ what.items[i].layer);
  return mix(words[0] ^ mix(words[1] ^ name)) & (cells->table_room.capacity - 1);
}

/* ---------------------------------------------------------------- the table */

/* Puts a cell into the table, which has room. */
static void place_cell(cs_map_cells *cells, uint32_t cell) {
  size_t at = place_of(cells, content_of(cells->map, cell));
  while (cells->table[at])
    at = (at + 1) & (cells->table_room.capacity - 1);
  cells->table[at] = cell + 1;
}

static celspan_status widen(celspan_context *context, cs_map_cells *cells) {
  size_t capacity = 2 * (size_t)cells->table_room.capacity;
  CS_TRY(CS_ARRAY_MAKE(context, cells->table, capacity > 0 ? capacity : 256));
  for (size_t i = 0; i < cells->map->cell_count; i++)
    place_cell(cells, (uint32_t)i);
  return CELSPAN_OK;
}

/* Appends a cell and its program. */
static celspan_status add_cell(celspan_context *context, cs_map *map, cs_map_content what,
                               uint32_t *out) {
  *out = (uint32_t)map->cell_count;
  map->is_whole = map->cell_count < CS_MAP_CELLS && map->item_count + what.length < UINT32_MAX;
  CS_TRY(CS_ARRAY_RESERVE(context, map->items, map->item_count + what.length));
  if (what.length > 0)
    memcpy(map->items + map->item_count, what.items, what.length * sizeof *what.items);
  const cs_map_cell cell = {.colour = what.colour,
                            .key = (mix(*out) << 20 | *out) & CS_MAP_KEY,
                            .item = (uint32_t)map->item_count,
                            .length = what.length};
  if (map->is_coloured) {
    CS_TRY(CS_ARRAY_RESERVE(context, map->through, map->cell_count + 1));
    map->through[map->cell_count] = what.through;
  }
  map->item_count += what.length;
  return CS_ARRAY_APPEND(context, map->cells, map->cell_count, cell);
}

celspan_status cs_map_cells_find(celspan_context *context, cs_map_cells *cells, cs_map_content what,
                                 uint32_t *out) {
  if (2 * cells->map->cell_count >= cells->table_room.capacity)
    CS_TRY(widen(context, cells));
  size_t at = place_of(cells, what);
  for (; cells->table[at]; at = (at + 1) & (cells->table_room.capacity - 1))
    if (is_content(content_of(cells->map, cells->table[at] - 1), what)) {
      *out = cells->table[at] - 1;
      return CELSPAN_OK;
    }
  CS_TRY(add_cell(context, cells->map, what, out));
  cells->table[at] = *out + 1;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- what hides */

static bool hides(const cs_stack *stack, const cs_item *items, uint32_t length) {
  bool hides = false;
  for (uint32_t i = 0; i < length && !hides; i++) {
    const cs_layer *layer = &stack->layers[items[i].layer];
    hides = layer->group == CS_STACK_NONE && cs_over_is_opaque(layer->t);
  }
  return hides;
}

bool cs_map_cells_is_even(const cs_stack *stack, const cs_item *items, uint32_t length) {
  bool is_even = true;
  for (uint32_t i = 0; i < length; i++)
    is_even &= cs_stack_layer_is_grey(stack, &stack->layers[items[i].layer]);
  return is_even || hides(stack, items, length);
}

void cs_map_cells_find_hiding(cs_map *map, const cs_stack *stack) {
  for (size_t i = 0; i < map->cell_count; i++) {
    cs_map_cell *cell = &map->cells[i];
    cell->hides = cell->length > 0 && hides(stack, map->items + cell->item, cell->length);
  }
}
