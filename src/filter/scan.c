#include "filter/cluster.h"

/* So many rows on, and more, it is cheaper to begin anew than to follow every boundary there. */
#define FAR_ROWS 16

celspan_status cs_scan_init(cs_scan *scan, celspan_context *context, const cs_shot *shot) {
  *scan = (cs_scan){.context = context, .shot = shot, .row = CS_SCAN_NOWHERE};
  cs_active_init(&scan->active, &shot->boundaries, &shot->cull);
  scan->active.notes_bends = shot->antialias != CELSPAN_ANTIALIAS_NONE;
  cs_cells_init(&scan->cells);
  cs_arena_init(&scan->arena);
  cs_scanline_init(&scan->output);
  CS_TRY(cs_composer_init(&scan->composer, context, &shot->stack));
  return shot->kernel ? cs_traces_init(scan) : CELSPAN_OK;
}

void cs_scan_finish(cs_scan *scan) {
  if (!scan->context)
    return;
  cs_memory *memory = scan->context->memory;
  cs_composer_finish(&scan->composer);
  cs_active_finish(&scan->active, memory);
  cs_cells_finish(&scan->cells, memory);
  cs_edges_finish(&scan->edges, memory);
  cs_window_free(&scan->window, memory);
  cs_meetings_finish(&scan->meetings, memory);
  cs_mem_free(memory, scan->members, scan->member_capacity * sizeof *scan->members);
  cs_mem_free(memory, scan->member_lists, scan->list_capacity * sizeof *scan->member_lists);
  cs_arena_finish(&scan->arena, memory);
  cs_scanline_finish(&scan->output, memory);
  cs_traces_finish(scan);
  *scan = (cs_scan){0};
}

/* The height at which the active boundaries stand for a row. */
static double row_height(const cs_scan *scan, int32_t y) {
  return scan->shot->antialias == CELSPAN_ANTIALIAS_NONE ? y + 0.5 : y;
}

static celspan_status advance(cs_scan *scan, double height, cs_change *change) {
  cs_active *active = &scan->active;
  cs_change settled = cs_change_none, moved = cs_change_none;
  if (active->y_next > active->y)
    CS_TRY(cs_active_settle(scan->context, active, &settled));
  if (active->y < height) {
    CS_TRY(cs_active_reach(scan->context, active, height));
    CS_TRY(cs_active_settle(scan->context, active, &moved));
  }
  *change = cs_change_join(settled, moved);
  return CELSPAN_OK;
}

/* Brings boundaries and cells to the row: from a row above when that is near. */
static celspan_status reach_row(cs_scan *scan, int32_t y) {
  cs_change change = cs_change_all;
  if (scan->row != CS_SCAN_NOWHERE && scan->row < y && y - scan->row < FAR_ROWS)
    CS_TRY(advance(scan, row_height(scan, y), &change));
  else
    CS_TRY(cs_active_start(scan->context, &scan->active, row_height(scan, y)));
  if (cs_composer_begin_row(&scan->composer)) {
    cs_cells_forget(&scan->cells);
    change = cs_change_all;
  }
  if (!cs_change_is_none(change)) {
    scan->looks++;
    scan->change = change;
    CS_TRY(cs_cells_update(&scan->cells, &scan->composer, &scan->active, change));
  }
  return scan->composer.failure;
}

celspan_status cs_scan_trace(cs_scan *scan, int32_t row, cs_trace *trace) {
  cs_arena_reset(&scan->arena);
  CS_TRY(reach_row(scan, row));
  scan->row = row;
  cs_trace_begin(trace, row, scan->cells.cells[0].colour);
  scan->window.trace = trace;
  CS_TRY(cs_area_row(scan, row, NULL));
  trace->is_sealed = scan->composer.failure == CELSPAN_OK;
  return scan->composer.failure;
}

static celspan_status make_row(cs_scan *scan, int32_t y, cs_row *out) {
  bool is_centre = scan->shot->antialias == CELSPAN_ANTIALIAS_NONE;
  if (!is_centre)
    cs_row_clear(out);
  if (scan->shot->kernel)
    return cs_traces_row(scan, y, out);
  CS_TRY(reach_row(scan, y));
  scan->row = y;
  if (is_centre)
    return cs_centre_row(scan, y, out);
  CS_TRY(cs_area_row(scan, y, out));
  return scan->composer.failure;
}

celspan_status cs_scan_row(cs_scan *scan, int32_t y, cs_row *out) {
  cs_arena_reset(&scan->arena);
  celspan_status status = make_row(scan, y, out);
  if (status != CELSPAN_OK) {
    scan->row = CS_SCAN_NOWHERE;
    cs_cells_restart(&scan->cells, &scan->composer);
  }
  return status;
}
