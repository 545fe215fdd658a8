#include "engine/map/swept.h"

#include <math.h>

/* ---------------------------------------------------------------- life */

static bool varies(const cs_stack *stack) {
  return stack->shade_count + stack->image_count + stack->defocused_count > 0;
}

celspan_status cs_map_swept_init(cs_map_swept *swept, celspan_context *context,
                                 const cs_plan *plan) {
  *swept = (cs_map_swept){.plan = plan, .cells = {.map = &swept->map}};
  swept->drawing = (cs_map_drawing){.map = &swept->map,
                                    .lines = &swept->map.lines,
                                    .scale_x = 1.0 / CS_MAP_UNIT,
                                    .scale_y = 1.0 / CS_MAP_UNIT,
                                    .light = cs_v4_all(1),
                                    .space = plan->stack.space};
  if (varies(&plan->stack))
    swept->drawing.stack = plan->stack;
  return cs_row_maker_init(&swept->maker, context, plan);
}

void cs_map_swept_finish(cs_map_swept *swept) {
  if (!swept->maker.context)
    return;
  cs_memory *memory = swept->maker.context->memory;
  cs_map *map = &swept->map;
  cs_map_lines_finish(&map->lines, memory);
  CS_ARRAYS_FREE(memory, map, flats, items);
  CS_ARRAYS_FREE(memory, &swept->drawing, colours, colours);
  CS_ARRAYS_FREE(memory, swept, numbers, numbers);
  cs_map_cells_finish(&swept->cells, memory);
  cs_retained_finish(&swept->retained, memory);
  cs_row_maker_finish(&swept->maker);
  *swept = (cs_map_swept){0};
}

/* ---------------------------------------------------------------- borders */

static int32_t round_to_unit(double place) { return (int32_t)floor(place * CS_MAP_UNIT + 0.5); }

/* Chains run along the sides of the frame where outlines are beyond them, so that all places are
 * near. */
static celspan_status add_border(cs_map_swept *swept, const cs_border *edge) {
  celspan_context *context = swept->maker.context;
  cs_map_lines *lines = &swept->map.lines;
  const cs_segment *line = &edge->line;
  const cs_map_point ends[2] = {{round_to_unit(line->xa), round_to_unit(line->ya)},
                                {round_to_unit(line->xb), round_to_unit(line->yb)}};
  uint32_t left = swept->numbers[cs_retained_number(&swept->retained, edge->left)];
  uint32_t right = swept->numbers[cs_retained_number(&swept->retained, edge->right)];
  size_t first = lines->point_count;
  if (left == right || ends[0].y >= ends[1].y)
    return CELSPAN_OK;
  CS_TRY(CS_ARRAY_RESERVE(context, lines->points, first + 2));
  memcpy(lines->points + first, ends, sizeof ends);
  lines->point_count += 2;
  const cs_map_border border = cs_map_lines_border(lines, first, left, right);
  return CS_ARRAY_APPEND(context, lines->borders, lines->border_count, border);
}

/* ---------------------------------------------------------------- a swath */

static cs_map_content content_of(const cs_retained_row *retained, const cs_cell *cell) {
  if (cell->length == 0)
    return (cs_map_content){.colour = cell->colour};
  return (cs_map_content){.items = retained->items + cell->program, .length = cell->length};
}

/* Finds the cells of the retained row in the map. */
static celspan_status number_cells(cs_map_swept *swept) {
  const cs_retained_row *retained = &swept->retained;
  celspan_context *context = swept->maker.context;
  CS_TRY(CS_ARRAY_RESERVE(context, swept->numbers, retained->cell_count));
  for (size_t i = 0; i < retained->cell_count; i++)
    CS_TRY(cs_map_cells_find(context, &swept->cells, content_of(retained, &retained->cells[i]),
                             &swept->numbers[i]));
  return CELSPAN_OK;
}

static celspan_status add_row(cs_map_swept *swept, int32_t y) {
  uint32_t base;
  CS_TRY(cs_row_retain(&swept->maker, y, &swept->retained));
  CS_TRY(cs_map_cells_find(swept->maker.context, &swept->cells,
                           (cs_map_content){.colour = swept->retained.base}, &base));
  CS_TRY(number_cells(swept));
  for (size_t i = 0; i < swept->retained.edge_count; i++)
    CS_TRY(add_border(swept, &swept->retained.edges[i]));
  return CELSPAN_OK;
}

/* The colours of the cells, which are lit already. */
static celspan_status take_colours(cs_map_swept *swept) {
  const cs_map *map = &swept->map;
  cs_map_drawing *drawing = &swept->drawing;
  CS_TRY(CS_ARRAY_RESERVE(swept->maker.context, drawing->colours, map->cell_count));
  for (size_t i = 0; i < map->cell_count; i++)
    drawing->colours[i] = map->cells[i].colour;
  return CELSPAN_OK;
}

celspan_status cs_map_swept_sweep(cs_map_swept *swept, int32_t row) {
  int32_t height = swept->plan->height;
  int32_t end = height - row < CS_MAP_ROWS ? height : row + CS_MAP_ROWS;
  celspan_status status = CELSPAN_OK;
  cs_map_cells_clear(&swept->cells);
  swept->map.lines.border_count = swept->map.lines.point_count = 0;
  for (int32_t y = row; y < end && status == CELSPAN_OK; y++)
    status = add_row(swept, y);
  if (status != CELSPAN_OK) {
    cs_row_maker_restart(&swept->maker);
    return status;
  }
  cs_map_cells_find_hiding(&swept->map, &swept->plan->stack);
  return take_colours(swept);
}
