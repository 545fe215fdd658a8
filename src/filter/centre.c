/* Antialias "none": a pixel shows the cell that its centre lies in.
 *
 * Half-open: a boundary at x belongs to the cell on its right, so the first column of that cell is
 * ceil(x - 1/2), and abutting shapes tile without gap or overlap.
 */
#include "filter/centre.h"

#include "filter/scan.h"
#include "filter/strips.h"
#include "span/pen.h"

/* Where the visible cells of a row begin, from left to right, and where the last one ends; room in
 * the scan's arena. NULL without memory. */
static int32_t *find_ends(cs_scan *scan) {
  const cs_cells *cells = &scan->cells;
  size_t count = scan->active.count, room = 2 + cells->visible_count + CS_ADVANCE_BATCH;
  int32_t *ends = cs_arena_take(scan->context, &scan->arena, room * sizeof *ends);
  if (!ends)
    return NULL;
  int32_t width = scan->shot->width;
  ends[0] = 0;
  CS_WIDE_CHOOSE(scan->active.isa, cs_centre_ends)
  (scan->active.x, cells->is_visible, count, width, ends + 1);
  ends[cells->visible_count + 1] = width;
  return ends;
}

/* Right of the v-th visible boundary from the left; the leftmost, where v is 0. */
static const cs_cell *visible_cell(const cs_cells *cells, size_t v) {
  return v > 0 ? &cells->cells[cells->visible[v - 1] + 1] : cells->cells;
}

/* Flat cells, from visible cell v on; returns the first that is not flat. */
static size_t draw_flats(const cs_cells *cells, const int32_t *ends, cs_pen *pen, size_t v) {
  for (; v <= cells->visible_count; v++) {
    const cs_cell *cell = visible_cell(cells, v);
    if (cell->length > 0)
      break;
    cs_pen_to(pen, ends[v + 1], cell->colour);
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
    int32_t to = ends[v + 1] > from ? ends[v + 1] : from;
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
 * neither is visible. False, and nothing done that counts, where not. */
static bool draw_all(cs_scan *scan, const int32_t *ends, cs_row *out) {
  const size_t count = scan->cells.visible_count + 1;
  bool is_drawn = out->drawn_by == scan && out->drawn_as == scan->looks;
  if (!CS_WIDE_CHOOSE(scan->active.isa, cs_centre_place)(out->spans, ends, count))
    return false;
  if (is_drawn)
    return true;
  cs_row_clear(out);
  if (!put_colours(&scan->cells, out->spans))
    return false;
  out->count = count;
  out->drawn_by = scan;
  out->drawn_as = scan->looks;
  return true;
}

celspan_status cs_centre_row(cs_scan *scan, int32_t y, cs_row *out) {
  if (cs_strips_meet(scan, y)) {
    cs_row_clear(out);
    return cs_strips_centre_row(scan, y, out);
  }
  const int32_t *ends = find_ends(scan);
  if (!ends)
    return CELSPAN_NO_MEMORY;
  CS_TRY(cs_row_room(scan->context, out, scan->cells.visible_count + 1 + CS_CENTRE_BATCH));
  if (draw_all(scan, ends, out))
    return CELSPAN_OK;
  cs_row_clear(out);
  return draw_row(scan, y, ends, out);
}
