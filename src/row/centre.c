/* Antialias "none": a pixel shows the cell that its centre lies in.
 *
 * Half-open: a boundary at x belongs to the cell on its right, so the first column of that cell is
 * ceil(x - 1/2), and abutting shapes tile without gap or overlap.
 */
#include "row/centre.h"

#include "paint/run.h"
#include "row/procedures.h"
#include "row/row.h"
#include "span/row_writer.h"

/* Right of the v-th visible boundary from the left; the leftmost, where v is 0. */
static const cs_cell *visible_cell(const cs_cells *cells, size_t v) {
  return v > 0 ? &cells->cells[cells->visible[v - 1] + 1] : cells->cells;
}

/* Flat cells, from visible cell v on, up to their ends; returns the first that is not flat. */
static size_t draw_flats(const cs_cells *cells, const int32_t *ends, cs_row_writer *writer,
                         size_t v) {
  for (; v <= cells->visible_count; v++) {
    const cs_cell *cell = visible_cell(cells, v);
    if (cell->length > 0)
      break;
    cs_row_writer_to(writer, ends[v], cell->colour);
  }
  return v;
}

static celspan_status draw_row(cs_row_maker *maker, int32_t y, const int32_t *ends, cs_row *out) {
  const cs_cells *cells = &maker->cells;
  const size_t count = cells->visible_count + 1;
  int32_t from = 0;
  for (size_t v = 0; v < count; v++) {
    CS_TRY(cs_row_reserve(maker->context, out, count - v));
    cs_row_writer writer = cs_row_writer_take(out, from);
    v = draw_flats(cells, ends, &writer, v);
    cs_row_writer_put(&writer);
    from = writer.from;
    if (v == count)
      break;
    int32_t to = ends[v] > from ? ends[v] : from;
    CS_TRY(
        cs_painter_run(&maker->painter, visible_cell(cells, v), (cs_run){from, to, y + 0.5}, out));
    from = to;
  }
  return CELSPAN_OK;
}

static size_t count_visible(const bool *is_visible, size_t count) {
  size_t visible = 0;
  for (size_t i = 0; i < count; i++)
    visible += is_visible[i];
  return visible;
}

/* Gives the colours of the visible cells that boundaries [low, high) lie between to their spans;
 * false where one is not flat. */
static bool put_colours(const cs_cells *cells, size_t low, size_t high, celspan_span *spans) {
  celspan_span *span = spans + count_visible(cells->is_visible, low);
  uint32_t varied = cells->cells[high].length;
  for (size_t i = low; i < high; i++) { /* cells that look alike write the same */
    cs_v4_store(span->colour, cells->cells[i].colour);
    varied |= cells->cells[i].length;
    span += cells->is_visible[i];
  }
  cs_v4_store(span->colour, cells->cells[high].colour);
  return varied == 0;
}

/* Where all visible cells are flat and none is empty, each is a span: of neighbours with one colour
 * neither is visible. False where not; the row is to be drawn then. Fills ends in any case. */
static bool draw_all(cs_row_maker *maker, cs_row *out, int32_t *ends) {
  const cs_cells *cells = &maker->cells;
  const cs_active *active = &maker->active;
  size_t low = 0, high = active->count;
  size_t count = CS_WIDE_CHOOSE(active->isa, cs_centre_place)(
      active->x, cells->is_visible, active->count, maker->plan->width, out->spans, ends);
  bool is_ours = out->drawn_by == maker && out->count == count;
  if (is_ours && out->drawn_as == maker->looks)
    return true;
  if (is_ours && out->drawn_as + 1 == maker->looks) {
    low = maker->change.low;
    high -= maker->change.tail;
  }
  cs_row_clear(out);
  if (count == 0 || !put_colours(cells, low, high, out->spans))
    return false;
  out->count = count;
  out->drawn_by = maker;
  out->drawn_as = maker->looks;
  return true;
}

celspan_status cs_centre_row(cs_row_maker *maker, int32_t y, cs_row *out) {
  size_t most = maker->active.count + 1 + CS_ADVANCE_BATCH;
  if (cs_procedures_meet(maker, y)) {
    cs_row_clear(out);
    return cs_procedures_centre_row(maker, y, out);
  }
  int32_t *ends = cs_arena_take(maker->context, &maker->arena, most * sizeof *ends);
  if (!ends)
    return CELSPAN_NO_MEMORY;
  CS_TRY(cs_row_room(maker->context, out, most));
  if (draw_all(maker, out, ends))
    return CELSPAN_OK;
  cs_cells_list(&maker->cells);
  return draw_row(maker, y, ends, out);
}
