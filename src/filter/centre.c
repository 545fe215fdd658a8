/* Antialias "none": a pixel shows the cell that its centre lies in.
 *
 * Half-open: a boundary at x belongs to the cell on its right, so the first column of that cell is
 * ceil(x - 1/2), and abutting shapes tile without gap or overlap.
 */
#include "filter/centre.h"

#include "filter/scan.h"
#include "filter/strips.h"
#include "span/pen.h"

/* Right of the v-th visible boundary from the left; the leftmost, where v is 0. */
static const cs_cell *visible_cell(const cs_cells *cells, size_t v) {
  return v > 0 ? &cells->cells[cells->visible[v - 1] + 1] : cells->cells;
}

/* Flat cells, from visible cell v on, up to their ends; returns the first that is not flat. */
static size_t draw_flats(const cs_cells *cells, const int32_t *ends, cs_pen *pen, size_t v) {
  for (; v <= cells->visible_count; v++) {
    const cs_cell *cell = visible_cell(cells, v);
    if (cell->length > 0)
      break;
    cs_pen_to(pen, ends[v], cell->colour);
  }
  return v;
}

static celspan_status draw_row(cs_scan *scan, int32_t y, const int32_t *ends, cs_row *out) {
  const cs_cells *cells = &scan->cells;
  const size_t count = cells->visible_count + 1;
  int32_t from = 0;
  for (size_t v = 0; v < count; v++) {
    CS_TRY(cs_row_reserve(scan->context, out, count - v));
    cs_pen pen = cs_pen_take(out, from);
    v = draw_flats(cells, ends, &pen, v);
    cs_pen_put(&pen);
    from = pen.from;
    if (v == count)
      break;
    int32_t to = ends[v] > from ? ends[v] : from;
    CS_TRY(cs_composer_run(&scan->composer, visible_cell(cells, v), from, to, y + 0.5, out));
    from = to;
  }
  return CELSPAN_OK;
}

/* Gives every visible cell's colour to the span of the same number; false where one is not flat. */
static bool put_colours(const cs_cells *cells, celspan_span *spans) {
  uint32_t varied = 0;
  for (size_t v = 0; v <= cells->visible_count; v++) {
    const cs_cell *cell = visible_cell(cells, v);
    cs_v4_store(spans[v].colour, cell->colour);
    varied |= cell->length;
  }
  return varied == 0;
}

/* Where all visible cells are flat and none is empty, each is a span: of neighbours with one colour
 * neither is visible. False where not; the row is to be drawn then. Fills ends in any case. */
static bool draw_all(cs_scan *scan, cs_row *out, int32_t *ends) {
  const cs_cells *cells = &scan->cells;
  const cs_active *active = &scan->active;
  bool is_drawn = out->drawn_by == scan && out->drawn_as == scan->looks;
  bool is_full = CS_WIDE_CHOOSE(active->isa, cs_centre_place)(
      active->x, cells->is_visible, active->count, scan->shot->width, out->spans, ends);
  if (is_full && is_drawn)
    return true;
  cs_row_clear(out);
  if (!is_full || !put_colours(cells, out->spans))
    return false;
  out->count = cells->visible_count + 1;
  out->drawn_by = scan;
  out->drawn_as = scan->looks;
  return true;
}

celspan_status cs_centre_row(cs_scan *scan, int32_t y, cs_row *out) {
  size_t most = scan->cells.visible_count + 1 + CS_ADVANCE_BATCH;
  if (cs_strips_meet(scan, y)) {
    cs_row_clear(out);
    return cs_strips_centre_row(scan, y, out);
  }
  int32_t *ends = cs_arena_take(scan->context, &scan->arena, most * sizeof *ends);
  if (!ends)
    return CELSPAN_NO_MEMORY;
  CS_TRY(cs_row_room(scan->context, out, most));
  return draw_all(scan, out, ends) ? CELSPAN_OK : draw_row(scan, y, ends, out);
}
