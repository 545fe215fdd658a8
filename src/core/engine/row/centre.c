/* Antialias "none", along a row:
 *
 *   x                      1.7         3.2                5.5
 *   cells          0        |     1     |        2         |     3
 *   columns    |       |       |       |       |       |       |       |
 *   centres        .       .       .       .       .       .       .
 *   shown          0       0       1       2       2       3       3
 *   ends                      2       3               5               7
 *
 * A boundary at x belongs to the cell on its right, so the first column of that cell is
 * ceil(x - 1/2), and abutting shapes tile without gap or overlap.
 */
#include "engine/row/centre.h"

#include "base/number.h"
#include "engine/compose/procedures.h"
#include "engine/paint/run.h"
#include "engine/span/row_writer.h"

#include <math.h>

void cs_centre_init(cs_centre *centre, const cs_row_tools *tools) {
  *centre = (cs_centre){.tools = *tools};
}

/* ---------------------------------------------------------------- cells that vary, or are empty */

/* The visible cell on the right of the v-th visible boundary from the left; the leftmost cell where
 * v is 0. */
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

static celspan_status draw_row(cs_centre *centre, int32_t y, const int32_t *ends, cs_row *out) {
  const cs_cells *cells = centre->tools.cells;
  const size_t count = cells->visible_count + 1;
  int32_t from = 0;
  for (size_t v = 0; v < count; v++) {
    CS_TRY(cs_row_reserve(centre->tools.composer->context, out, count - v));
    cs_row_writer writer = cs_row_writer_begin(out, from);
    v = draw_flats(cells, ends, &writer, v);
    cs_row_writer_end(&writer);
    from = writer.from;
    if (v == count)
      break;
    int32_t to = ends[v] > from ? ends[v] : from;
    CS_TRY(cs_painter_run(centre->tools.painter, visible_cell(cells, v),
                          (cs_run){from, to, y + 0.5}, out));
    from = to;
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- flat cells */

static size_t count_visible(const bool *is_visible, size_t count) {
  size_t visible = 0;
  for (size_t i = 0; i < count; i++)
    visible += is_visible[i];
  return visible;
}

/* Gives the colours of the visible cells between boundaries [low, high) to their spans; false where
 * one is not flat. */
static bool put_colours(const cs_cells *cells, size_t low, size_t high, celspan_span *spans) {
  celspan_span *span = spans + count_visible(cells->is_visible, low);
  uint32_t varied = cells->cells[high].length;
  for (size_t i = low; i < high; i++) { /* cells with the same colours write the same bytes */
    cs_v4_store(span->colour, cells->cells[i].colour);
    varied |= cells->cells[i].length;
    span += cells->is_visible[i];
  }
  cs_v4_store(span->colour, cells->cells[high].colour);
  return varied == 0;
}

/* Where all visible cells are flat and none is empty, each cell becomes a span, since visible
 * neighbours never have the same colour. Otherwise returns false, and the row must be drawn. Fills
 * ends in any case. */
static bool draw_all(const cs_centre *centre, cs_row *out, int32_t *ends) {
  const cs_cells *cells = centre->tools.cells;
  const cs_active *active = centre->tools.active;
  size_t low = 0, high = active->count;
  size_t count = CS_WIDE_CHOOSE(active->isa, cs_centre_place)(
      active->x, cells->is_visible, active->count, centre->tools.width, out->spans, ends);
  bool is_ours = out->made_by.maker == centre && out->count == count;
  if (is_ours && out->made_by.changes == centre->changes)
    return true;
  if (is_ours && out->made_by.changes + 1 == centre->changes) {
    low = centre->last_change.low;
    high -= centre->last_change.tail;
  }
  cs_row_clear(out);
  if (count == 0 || !put_colours(cells, low, high, out->spans))
    return false;
  out->count = count;
  out->made_by = (cs_row_mark){centre, centre->changes};
  return true;
}

/* ---------------------------------------------------------------- procedures */

/* The boundaries of a row and the edges of its procedures, as one order. */
typedef struct merged_walk {
  cs_composer *composer;
  cs_painter *painter;
  const cs_active *active;
  cs_procedure_edges edges;
  size_t boundary, edge; /* the next of each */
  cs_deferred_cursor deferred;
} merged_walk;

static bool is_done(const merged_walk *w) {
  return w->boundary + w->edge == w->active->count + w->edges.count;
}

/* x of the next boundary or edge, at most `width`; `width` if there is none left. */
static double next_x(const merged_walk *w, int32_t width) {
  double x = width;
  if (w->boundary < w->active->count && w->active->x[w->boundary] < x)
    x = w->active->x[w->boundary];
  if (w->edge < w->edges.count && w->edges.edges[w->edge].x < x)
    x = w->edges.edges[w->edge].x;
  return x;
}

/* Crosses the next boundary or edge. */
static void cross_next(merged_walk *w) {
  const cs_active *active = w->active;
  if (w->edge == w->edges.count ||
      (w->boundary < active->count && active->x[w->boundary] <= w->edges.edges[w->edge].x)) {
    const cs_crossing *crossing = &active->crossing[w->boundary++];
    cs_composer_cross(w->composer, crossing->layer, crossing->direction);
    return;
  }
  const cs_procedure_edge *e = &w->edges.edges[w->edge++];
  cs_composer_cross_span(w->composer, e->layer, e->span, e->direction);
}

/* The columns [from, to) that one cell has been found to fill so far. */
typedef struct filled {
  cs_cell cell;
  int32_t from, to;
} filled;

/* The walk's cell fills the columns up to `to`; it joins the columns before if they have the same
 * colours. */
static celspan_status fill_to(merged_walk *w, filled *f, int32_t to, double y, cs_row *out) {
  cs_cell cell;
  cs_composer_cell(w->composer, &cell);
  CS_TRY(w->composer->failure);
  if (!cs_composer_same(w->composer, &cell, &f->cell)) {
    CS_TRY(cs_painter_run(w->painter, &f->cell, (cs_run){f->from, f->to, y}, out));
    f->from = f->to;
    f->cell = cell;
  }
  f->to = to;
  return CELSPAN_OK;
}

static celspan_status draw_merged(cs_centre *centre, int32_t y, cs_row *out) {
  merged_walk w = {.composer = centre->tools.composer,
                   .painter = centre->tools.painter,
                   .active = centre->tools.active};
  filled f = {.cell.colour = cs_v4_all(0)};
  double x = 0; /* where the current cell begins */
  CS_TRY(cs_procedures_collect(centre->tools.procedures, y + 0.5, &w.edges));
  cs_procedures_sort(&w.edges);
  cs_cells_walk_home(centre->tools.cells, centre->tools.composer);
  w.deferred.next = cs_active_deferred(centre->tools.active, &w.deferred.end);
  for (;;) {
    int32_t to = cs_number_first_centre(next_x(&w, centre->tools.width));
    cs_deferred_forward(&w.deferred, w.composer, x);
    if (to > f.to)
      CS_TRY(fill_to(&w, &f, to, y + 0.5, out));
    if (is_done(&w))
      break;
    x = next_x(&w, centre->tools.width);
    cross_next(&w);
  }
  cs_deferred_forward(&w.deferred, w.composer, INFINITY);
  return cs_painter_run(w.painter, &f.cell, (cs_run){f.from, centre->tools.width, y + 0.5}, out);
}

/* ---------------------------------------------------------------- rows */

celspan_status cs_centre_row(cs_centre *centre, int32_t y, cs_row *out) {
  size_t most = centre->tools.active->count + 1 + CS_ADVANCE_BATCH;
  if (cs_procedures_meet(centre->tools.procedures, y)) {
    cs_row_clear(out);
    return draw_merged(centre, y, out);
  }
  int32_t *ends =
      cs_arena_take(centre->tools.composer->context, centre->tools.arena, most * sizeof *ends);
  if (!ends)
    return CELSPAN_NO_MEMORY;
  CS_TRY(cs_row_room(centre->tools.composer->context, out, most));
  if (draw_all(centre, out, ends))
    return CELSPAN_OK;
  cs_cells_list(centre->tools.cells);
  return draw_row(centre, y, ends, out);
}
