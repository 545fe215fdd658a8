/* Antialias "none": a pixel shows the cell that its centre lies in.
 *
 * Half-open: a boundary at x belongs to the cell on its right, so the first column of that cell is
 * ceil(x - 1/2), and abutting shapes tile without gap or overlap.
 */
#include "base/number.h"
#include "filter/scan.h"
#include "filter/strips.h"
#include "span/pen.h"

/* Like cs_number_first_centre for an x inside the frame, where no conversion can overflow. */
static inline int32_t first_column(double x, int32_t width) {
  double centre = x - 0.5;
  int32_t column = (int32_t)centre;
  column += centre > column;
  return column < 0 ? 0 : column > width ? width : column;
}

/* Flat cells, from the first visible boundary on; returns how many boundaries lie behind the
 * pen. */
static size_t draw_flats(const cs_scan *scan, cs_pen *pen, size_t v) {
  const cs_cells *cells = &scan->cells;
  const double *x = scan->active.x;
  const int32_t width = scan->shot->width;
  const cs_cell *cell = v > 0 ? &cells->cells[cells->visible[v - 1] + 1] : cells->cells;
  for (; v < cells->visible_count && cell->length == 0; v++) {
    uint32_t i = cells->visible[v];
    cs_pen_to(pen, first_column(x[i], width), cell->colour);
    cell = &cells->cells[i + 1];
  }
  return v;
}

celspan_status cs_centre_row(cs_scan *scan, int32_t y, cs_row *out) {
  if (cs_strips_meet(scan, y))
    return cs_strips_centre_row(scan, y, out);
  const cs_cells *cells = &scan->cells;
  int32_t from = 0, width = scan->shot->width;
  for (size_t v = 0;; v++) {
    CS_TRY(cs_row_reserve(scan->context, out, cells->visible_count - v));
    cs_pen pen = cs_pen_take(out, from);
    v = draw_flats(scan, &pen, v);
    cs_pen_put(&pen);
    from = pen.from;
    const cs_cell *cell = v > 0 ? &cells->cells[cells->visible[v - 1] + 1] : cells->cells;
    if (v == cells->visible_count)
      return cs_composer_run(&scan->composer, cell, from, width, y + 0.5, out);
    int32_t to = first_column(scan->active.x[cells->visible[v]], width);
    CS_TRY(cs_composer_run(&scan->composer, cell, from, to, y + 0.5, out));
    from = to > from ? to : from;
  }
}
