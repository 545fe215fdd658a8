/* Antialias "none": a pixel shows the cell that its centre lies in.
 *
 * Half-open: a boundary at x belongs to the cell on its right, so the first column of that cell is
 * ceil(x - 1/2), and abutting shapes tile without gap or overlap.
 */
#include "base/number.h"
#include "filter/scan.h"
#include "filter/strips.h"

/* Like cs_number_first_centre for an x inside the frame, where no conversion can overflow. */
static inline int32_t first_column(double x, int32_t width) {
  double centre = x - 0.5;
  int32_t column = (int32_t)centre;
  column += centre > column;
  return column < 0 ? 0 : column > width ? width : column;
}

celspan_status cs_centre_row(cs_scan *scan, int32_t y, cs_row *out) {
  if (cs_strips_meet(scan, y))
    return cs_strips_centre_row(scan, y, out);
  const cs_cell *cell = scan->cells.cells;
  const double *x = scan->active.x;
  int32_t from = 0, width = scan->shot->width;
  for (size_t v = 0; v < scan->cells.visible_count; v++) {
    uint32_t i = scan->cells.visible[v];
    int32_t to = first_column(x[i], width);
    if (to > from) {
      CS_TRY(cell->length == 0
                 ? cs_row_single(scan->context, out, from, to, cell->colour)
                 : cs_composer_run(&scan->composer, cell, from, to, y + 0.5, out));
      from = to;
    }
    cell = &scan->cells.cells[i + 1];
  }
  return cs_composer_run(&scan->composer, cell, from, width, y + 0.5, out);
}
