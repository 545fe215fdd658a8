#include "engine/map/brush.h"

#include "engine/paint/colours.h"
#include "engine/paint/shade.h"
#include "model/colour/grade.h"

/* ---------------------------------------------------------------- the place */

celspan_status cs_map_brush_place(celspan_context *context, cs_map_drawing *drawing) {
  const cs_stack *from = &drawing->map->stack;
  cs_stack *to = &drawing->stack;
  *to = *from;
  to->space = drawing->space;
  to->shades = NULL;
  to->images = NULL;
  to->shades_room = to->images_room = (cs_room){0};
  CS_TRY(CS_ARRAY_MAKE(context, to->shades, from->shade_count));
  CS_TRY(CS_ARRAY_MAKE(context, to->images, from->image_count));
  for (size_t i = 0; i < from->shade_count; i++) {
    to->shades[i] = from->shades[i];
    to->shades[i].inverse = celspan_matrix_then(drawing->to_raster, from->shades[i].inverse);
    cs_shade_prepare(&to->shades[i]);
  }
  for (size_t i = 0; i < from->image_count; i++) {
    to->images[i] = from->images[i];
    to->images[i].inverse = celspan_matrix_then(drawing->to_raster, from->images[i].inverse);
  }
  return CELSPAN_OK;
}

void cs_map_brush_displace(cs_map_drawing *drawing, cs_memory *memory) {
  CS_ARRAYS_FREE(memory, &drawing->stack, shades, images);
  drawing->stack = (cs_stack){0};
}

/* ---------------------------------------------------------------- life */

celspan_status cs_map_brush_init(cs_map_brush *brush, celspan_context *context,
                                 const cs_map_drawing *drawing) {
  if (drawing->stack.layer_count == 0)
    return CELSPAN_OK;
  brush->drawing = drawing;
  for (size_t i = 0; i < sizeof brush->streaks / sizeof *brush->streaks; i++)
    brush->streaks[i].y = -1;
  return cs_painter_init(&brush->painter, context, &drawing->stack, NULL);
}

void cs_map_brush_finish(cs_map_brush *brush) {
  if (brush->drawing)
    cs_painter_finish(&brush->painter);
  brush->drawing = NULL;
}

/* ---------------------------------------------------------------- colours */

cs_v4 cs_map_brush_light(const cs_map_drawing *drawing, cs_v4 colour) {
  float rgba[4];
  colour *= drawing->light;
  if (!drawing->grade)
    return colour;
  cs_v4_store(rgba, colour);
  cs_grade_light(drawing->grade, drawing->space, rgba[3], rgba);
  return cs_v4_load(rgba);
}

bool cs_map_brush_is_bare(const cs_map_drawing *drawing) {
  return !drawing->grade && cs_v4_same(drawing->light, cs_v4_all(1));
}

cs_program cs_map_brush_program(const cs_map_drawing *drawing, uint32_t cell) {
  const cs_map *map = drawing->map;
  return (cs_program){map->items + map->cells[cell].item, NULL, map->cells[cell].length};
}

static celspan_status paint(cs_map_brush *brush, uint32_t cell, cs_run run, cs_v4 *out) {
  cs_program program = cs_map_brush_program(brush->drawing, cell);
  float rgba[CS_OVER_ROW_BATCH][4];
  for (int32_t x = run.x0, end; x < run.x1; x = end) {
    end = run.x1 - x < CS_OVER_ROW_BATCH ? run.x1 : x + CS_OVER_ROW_BATCH;
    CS_TRY(
        cs_painter_program_colours(&brush->painter, &program, cs_run_between(run, x, end), rgba));
    for (int32_t k = 0; k < end - x; k++)
      *out++ = cs_map_brush_light(brush->drawing, cs_v4_load(rgba[k]));
  }
  return CELSPAN_OK;
}

/* The streak of a cell that has these pixels; NULL: none. */
static const cs_map_streak *find_streak(const cs_map_brush *brush, uint32_t cell, int32_t y,
                                        int32_t x0, int32_t x1) {
  for (size_t i = 0; i < sizeof brush->streaks / sizeof *brush->streaks; i++) {
    const cs_map_streak *streak = &brush->streaks[i];
    if (streak->y == y && streak->cell == cell && streak->x0 <= x0 &&
        x1 <= streak->x0 + CS_MAP_STREAK)
      return streak;
  }
  return NULL;
}

/* Paints a streak from a pixel on, in the place of the oldest one. */
static celspan_status paint_streak(cs_map_brush *brush, uint32_t cell, int32_t y, int32_t x0,
                                   const cs_map_streak **out) {
  size_t count = sizeof brush->streaks / sizeof *brush->streaks;
  cs_map_streak *streak = &brush->streaks[brush->oldest++ % count];
  *out = streak;
  streak->y = -1;
  CS_TRY(paint(brush, cell, (cs_run){x0, x0 + CS_MAP_STREAK, y + 0.5}, streak->colours));
  streak->cell = cell;
  streak->x0 = x0;
  streak->y = y;
  return CELSPAN_OK;
}

celspan_status cs_map_brush_colours(cs_map_brush *brush, uint32_t cell, int32_t y, int32_t x0,
                                    int32_t x1, cs_v4 *out) {
  if (x1 - x0 > CS_MAP_STREAK / 2)
    return paint(brush, cell, (cs_run){x0, x1, y + 0.5}, out);
  const cs_map_streak *streak = find_streak(brush, cell, y, x0, x1);
  if (!streak)
    CS_TRY(paint_streak(brush, cell, y, x0, &streak));
  memcpy(out, streak->colours + (x0 - streak->x0), (size_t)(x1 - x0) * sizeof *out);
  return CELSPAN_OK;
}

celspan_status cs_map_brush_colour(cs_map_brush *brush, const cs_map_drawing *drawing,
                                   uint32_t cell, int32_t x, int32_t y, cs_v4 *out) {
  *out = drawing->colours[cell];
  return drawing->map->cells[cell].length > 0 ? cs_map_brush_colours(brush, cell, y, x, x + 1, out)
                                              : CELSPAN_OK;
}
