#include "area/local_sweep.h"

/* So many rows on, and more, it is cheaper to begin anew than to follow every boundary there. */
#define FAR_ROWS 16

celspan_status cs_row_maker_init(cs_row_maker *maker, celspan_context *context,
                                 const cs_plan *plan) {
  *maker = (cs_row_maker){.context = context, .plan = plan, .row = CS_ROW_NOWHERE};
  cs_active_init(&maker->active, &plan->boundaries, &plan->cull);
  maker->active.notes_bends = plan->antialias != CELSPAN_ANTIALIAS_NONE;
  cs_cells_init(&maker->cells);
  cs_arena_init(&maker->arena);
  cs_scanline_init(&maker->output);
  CS_TRY(cs_composer_init(&maker->composer, context, &plan->stack,
                          cs_painter_opacity(&maker->painter)));
  CS_TRY(cs_painter_init(&maker->painter, context, &maker->composer));
  return plan->kernel ? cs_filter_init(maker) : CELSPAN_OK;
}

void cs_row_maker_finish(cs_row_maker *maker) {
  if (!maker->context)
    return;
  cs_memory *memory = maker->context->memory;
  cs_painter_finish(&maker->painter);
  cs_composer_finish(&maker->composer);
  cs_active_finish(&maker->active, memory);
  cs_cells_finish(&maker->cells, memory);
  cs_edges_finish(&maker->edges, memory);
  cs_window_free(&maker->window, memory);
  cs_intersections_finish(&maker->intersections, memory);
  cs_mem_free(memory, maker->members, maker->member_capacity * sizeof *maker->members);
  cs_mem_free(memory, maker->member_lists, maker->list_capacity * sizeof *maker->member_lists);
  cs_arena_finish(&maker->arena, memory);
  cs_scanline_finish(&maker->output, memory);
  cs_filter_finish(maker);
  *maker = (cs_row_maker){0};
}

/* The height at which the active boundaries stand for a row. */
static double row_height(const cs_row_maker *maker, int32_t y) {
  return maker->plan->antialias == CELSPAN_ANTIALIAS_NONE ? y + 0.5 : y;
}

static celspan_status advance(cs_row_maker *maker, double height, cs_change *change) {
  cs_active *active = &maker->active;
  cs_change settled = cs_change_none, moved = cs_change_none;
  if (active->y_next > active->y)
    CS_TRY(cs_active_settle(maker->context, active, &settled));
  if (active->y < height) {
    CS_TRY(cs_active_reach(maker->context, active, height));
    CS_TRY(cs_active_settle(maker->context, active, &moved));
  }
  *change = cs_change_join(settled, moved);
  return CELSPAN_OK;
}

/* Brings boundaries and cells to the row: from a row above when that is near. */
static celspan_status reach_row(cs_row_maker *maker, int32_t y) {
  cs_change change = cs_change_all;
  if (maker->row != CS_ROW_NOWHERE && maker->row < y && y - maker->row < FAR_ROWS)
    CS_TRY(advance(maker, row_height(maker, y), &change));
  else
    CS_TRY(cs_active_start(maker->context, &maker->active, row_height(maker, y)));
  if (cs_composer_begin_row(&maker->composer)) {
    cs_cells_forget(&maker->cells);
    change = cs_change_all;
  }
  if (!cs_change_is_none(change)) {
    maker->looks++;
    maker->change = change;
    CS_TRY(cs_cells_update(&maker->cells, &maker->composer, &maker->active, change));
  }
  return maker->composer.failure;
}

celspan_status cs_row_retain(cs_row_maker *maker, int32_t row, cs_retained_row *retained) {
  cs_arena_reset(&maker->arena);
  CS_TRY(reach_row(maker, row));
  maker->row = row;
  cs_retained_begin(retained, row, maker->cells.cells[0].colour);
  maker->window.retained = retained;
  CS_TRY(cs_area_row(maker, row, NULL));
  retained->is_sealed = maker->composer.failure == CELSPAN_OK;
  return maker->composer.failure;
}

static celspan_status make_row(cs_row_maker *maker, int32_t y, cs_row *out) {
  bool is_centre = maker->plan->antialias == CELSPAN_ANTIALIAS_NONE;
  if (!is_centre)
    cs_row_clear(out);
  if (maker->plan->kernel)
    return cs_filter_row(maker, y, out);
  CS_TRY(reach_row(maker, y));
  maker->row = y;
  if (is_centre)
    return cs_centre_row(maker, y, out);
  CS_TRY(cs_area_row(maker, y, out));
  return maker->composer.failure;
}

celspan_status cs_row_make(cs_row_maker *maker, int32_t y, cs_row *out) {
  cs_arena_reset(&maker->arena);
  celspan_status status = make_row(maker, y, out);
  if (status != CELSPAN_OK) {
    maker->row = CS_ROW_NOWHERE;
    cs_cells_restart(&maker->cells, &maker->composer);
  }
  return status;
}
