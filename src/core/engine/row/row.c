/* How a row is made. Two shapes, a disc and a bar beside it, on row y of the frame:
 *
 *  pixels  |    0    |    1    |    2    |    3    |    4    |    5    |
 *  y       +-----a---+---------+---------+b--------+--c------+---d-----+  sweep/   boundaries
 *          |    /    |         |         | \       |  |      |   |     |           in order:
 *          |   /     |         |         |  \      |  |      |   |     |           a b c d
 *  y + 1   +--/------+---------+---------+---\-----+--|------+---|-----+
 *  cells     0 |             1              |    2    |     3    |   4    compose/ the shapes in
 *          clear           disc                clear       bar     clear           each: a colour
 *                                                                                  or a program
 *  centre  |   disc  |   disc  |   disc  |  clear  |   bar   |  clear  |  row/     the cell at
 *                                                                                  its centre
 *  area    | .55 disc|   disc  |   disc  | .25 disc| .70 bar | .40 bar |  area/    the exact mean
 *  kernel  |       the mean of rows and columns around, weighted       |  kernel/  kept as edges
 *  spans   |---------|-------------------|---------|---------|---------|  span/    of "area"
 *
 * Further down the bar passes over the disc: when b and c have crossed, the order is a c b d. Only
 * the cell between c and b is composed, the others are kept.
 */
#include "engine/row/row.h"

#include "base/self_check.h"
#include "engine/compose/procedures.h"

/* When a row is this far below the last one, it costs less to find its boundaries from nothing than
 * to follow them down. */
#define FAR_ROWS 16

/* ---------------------------------------------------------------- life */

/* Gives the filter the edges of a row. */
static celspan_status retain(void *maker, int32_t y, cs_retained_row *retained) {
  return cs_row_retain(maker, y, retained);
}

celspan_status cs_row_maker_init(cs_row_maker *maker, celspan_context *context,
                                 const cs_plan *plan) {
  *maker = (cs_row_maker){.context = context, .plan = plan, .row = CS_ROW_NONE};
  bool notes_bends = plan->antialias != CELSPAN_ANTIALIAS_NONE; /* pixel centres ignore them */
  cs_active_init(&maker->active, &plan->boundaries, &plan->cull, notes_bends);
  cs_cells_init(&maker->cells);
  cs_arena_init(&maker->arena);
  cs_procedures_init(&maker->procedures, &maker->composer, &maker->arena, plan->width,
                     plan->margin);
  CS_TRY(cs_composer_init(&maker->composer, context, &plan->stack,
                          cs_painter_opacity(&maker->painter)));
  CS_TRY(cs_painter_init(&maker->painter, context, &plan->stack, &maker->composer));
  cs_row_tools tools = {&maker->composer,   &maker->painter, &maker->active, &maker->cells,
                        &maker->procedures, &maker->arena,   plan->width};
  cs_centre_init(&maker->centre, &tools);
  cs_area_init(&maker->area, &tools);
  return plan->kernel ? cs_filter_init(&maker->filter, plan->kernel, &maker->painter, plan->width,
                                       retain, maker)
                      : CELSPAN_OK;
}

void cs_row_maker_finish(cs_row_maker *maker) {
  if (!maker->context)
    return;
  cs_memory *memory = maker->context->memory;
  cs_filter_finish(&maker->filter, memory);
  cs_area_finish(&maker->area, memory);
  cs_procedures_finish(&maker->procedures, memory);
  cs_arena_finish(&maker->arena, memory);
  cs_cells_finish(&maker->cells, memory);
  cs_painter_finish(&maker->painter);
  cs_composer_finish(&maker->composer);
  cs_active_finish(&maker->active, memory);
  *maker = (cs_row_maker){0};
}

/* ---------------------------------------------------------------- boundaries and cells of a row */

/* The height that the boundaries are at for a row: its centre, or its top where the whole row
 * counts. */
static double row_height(const cs_row_maker *maker, int32_t y) {
  return maker->plan->antialias == CELSPAN_ANTIALIAS_NONE ? y + 0.5 : y;
}

/* Moves the boundaries down to a height. If a row has already advanced them to its foot, this step
 * is completed first. */
static celspan_status advance(cs_row_maker *maker, double height, cs_change *change) {
  cs_active *active = &maker->active;
  cs_change settled = cs_change_none, moved = cs_change_none;
  if (active->y_next > active->y)
    CS_TRY(cs_active_settle(maker->context, active, &settled));
  if (active->y < height) {
    CS_TRY(cs_active_advance(maker->context, active, height));
    CS_TRY(cs_active_settle(maker->context, active, &moved));
  }
  *change = cs_change_join(settled, moved);
  return CELSPAN_OK;
}

/* Brings the boundaries to the row: down from a row above if that row is near. */
static celspan_status sweep_to(cs_row_maker *maker, int32_t y, cs_change *change) {
  double height = row_height(maker, y);
  if (maker->row != CS_ROW_NONE && maker->row < y && y - maker->row < FAR_ROWS)
    return advance(maker, height, change);
  *change = cs_change_all;
  return cs_active_start(maker->context, &maker->active, height);
}

/* Brings the boundaries to the row. */
static celspan_status begin_row(cs_row_maker *maker, int32_t y, cs_change *change) {
  CS_TRY(sweep_to(maker, y, change));
  if (cs_composer_begin_row(&maker->composer)) {
    cs_cells_forget(&maker->cells);
    *change = cs_change_all;
  }
  CS_SELF_CHECK(cs_active_is_ordered(&maker->active));
  maker->row = y;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- rows */

celspan_status cs_row_retain(cs_row_maker *maker, int32_t y, cs_retained_row *retained) {
  cs_change change;
  cs_arena_reset(&maker->arena);
  CS_TRY(begin_row(maker, y, &change));
  CS_TRY(cs_area_retain(&maker->area, y, change, retained));
  return maker->composer.failure;
}

/* The cells at the pixels' centres. */
static celspan_status make_centres(cs_row_maker *maker, int32_t y, cs_row *out) {
  cs_change change;
  CS_TRY(begin_row(maker, y, &change));
  if (!cs_change_is_none(change))
    cs_centre_note_change(&maker->centre, change);
  CS_TRY(cs_cells_update(&maker->cells, &maker->composer, &maker->active, change, NULL, 0));
  CS_TRY(maker->composer.failure);
  CS_SELF_CHECK(cs_cells_are_true(&maker->cells, &maker->composer, &maker->active));
  return cs_centre_row(&maker->centre, y, out);
}

static celspan_status make_row(cs_row_maker *maker, int32_t y, cs_row *out) {
  cs_change change;
  if (maker->plan->antialias == CELSPAN_ANTIALIAS_NONE)
    return make_centres(maker, y, out);
  cs_row_clear(out);
  if (maker->plan->kernel) /* the filter begins each row under the kernel itself */
    return cs_filter_row(&maker->filter, y, out);
  CS_TRY(begin_row(maker, y, &change));
  CS_TRY(cs_area_row(&maker->area, y, change, out));
  return maker->composer.failure;
}

void cs_row_maker_restart(cs_row_maker *maker) {
  maker->row = CS_ROW_NONE;
  cs_cells_restart(&maker->cells, &maker->composer);
}

celspan_status cs_row_make(cs_row_maker *maker, int32_t y, cs_row *out) {
  cs_arena_reset(&maker->arena);
  celspan_status status = make_row(maker, y, out);
  if (status != CELSPAN_OK)
    cs_row_maker_restart(maker);
  CS_SELF_CHECK(status != CELSPAN_OK || cs_row_is_whole(out, maker->plan->width));
  return status;
}
