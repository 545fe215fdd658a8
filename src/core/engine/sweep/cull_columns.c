/* The columns that a chain touches, from few chords, each wider than the curve that it replaces by
 * a slack.
 */
#include "engine/sweep/cull_grid.h"

#include "model/geometry/polyline.h"
#include "model/geometry/polyline_vertex.h"

#include <math.h>

#define SLACK_LEAST 0x1p-8 /* pixels: more than all rounding */

/* A chord of a chain, and how far the chain may be from it. */
typedef struct chord {
  celspan_point top, foot;
  double slack;
} chord;

/* The column at x. Callers have added a slack to x that is larger than any rounding error. */
static inline uint8_t column(const cs_cull_grid *grid, double x) {
  const double most = CS_CULL_COLUMNS - 1;
  double at = x * grid->columns_a_pixel, least = at > 0 ? at : 0; /* NaN counts as 0 */
  return (uint8_t)(int32_t)(least < most ? least : most);
}

static inline void widen(cs_cull_columns *r, uint8_t low, uint8_t high) {
  r->low = low < r->low ? low : r->low;
  r->high = high > r->high ? high : r->high;
}

/* x of the chord at a height; beyond its ends, x of the end. */
static inline double chord_x(const chord *line, double slope, double y) {
  double above = y < line->foot.y ? y : line->foot.y;
  double inside = above > line->top.y ? above : line->top.y;
  return line->top.x + (inside - line->top.y) * slope;
}

/* Notes the columns that a chord touches in the rows first..last. */
static void find_chord(const cs_cull_grid *grid, const chord *line, int32_t first, int32_t last,
                       cs_cull_columns *columns) {
  int32_t from = cs_cull_row(grid->cull, line->top.y - line->slack);
  int32_t to = cs_cull_row(grid->cull, line->foot.y + line->slack);
  from = from > first ? from : first;
  to = to < last ? to : last;
  double height = line->foot.y - line->top.y;
  double slope = height > 0 ? (line->foot.x - line->top.x) / height : 0;
  for (int32_t row = from; row <= to; row++) {
    double top = chord_x(line, slope, cs_cull_grid_top(grid, row) - line->slack);
    double foot = chord_x(line, slope, cs_cull_grid_foot(grid, row) + line->slack);
    widen(&columns[row - first], column(grid, (top < foot ? top : foot) - line->slack),
          column(grid, (top < foot ? foot : top) + line->slack));
  }
}

/* Covers a piece with chords that are as long as the slack allows. A chord over s of the piece's
 * own chords lies within s^2 sags of the curve. The polyline that the sweep walks later, in
 * segments at most 1.5 times as long as the piece's own chords, lies within 2.25 sags of the curve,
 * and its displaced vertices within CS_POLYLINE_LIFT sags more. */
static void find_piece(const cs_cull_grid *grid, const cs_boundary_piece *piece, int32_t first,
                       int32_t last, cs_cull_columns *columns) {
  const double near = 2.25 + CS_POLYLINE_LIFT;
  double stride = piece->sag > 0 ? sqrt(fmax(grid->slack / piece->sag - near, 1)) : 1;
  uint32_t step = stride < piece->chords ? (uint32_t)stride : piece->chords;
  chord line = {.slack = SLACK_LEAST + ((double)step * step + near) * piece->sag};
  line.top = cs_polyline_plain(grid->desc->set, piece, 0);
  for (uint32_t vertex = 0; vertex < piece->chords; line.top = line.foot) {
    vertex = piece->chords - vertex > step ? vertex + step : piece->chords;
    line.foot = cs_polyline_plain(grid->desc->set, piece, vertex);
    find_chord(grid, &line, first, last, columns);
  }
}

void cs_cull_columns_find(const cs_cull_grid *grid, uint32_t chain, cs_cull_columns *columns) {
  const cs_boundary_chain *ch = &grid->desc->set->chains[chain];
  int32_t first = grid->cull->first_rows[chain], last = grid->last_rows[chain];
  for (int32_t row = first; row <= last; row++)
    columns[row - first] = (cs_cull_columns){CS_CULL_COLUMNS - 1, 0};
  for (uint32_t k = 0; k < ch->piece_count; k++)
    find_piece(grid, &grid->desc->set->pieces[ch->piece + k], first, last, columns);
}
