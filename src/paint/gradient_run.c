#include "paint/gradient_run.h"

#include "paint/line.h"

#include <math.h>

/* A row of a gradient. */
typedef struct cursor {
  cs_painter *painter;
  const cs_gradient_table *table;
  cs_row *row;
  double u, v;       /* the shade's planes in x = 0 */
  double bend;       /* RADIAL: second derivative of the distance r along the row, times r cubed */
  int32_t from, end; /* what is left of the run */
} cursor;

/* A column, where it lies along the stops, and its colour. */
typedef struct point {
  int32_t column;
  double at;
  cs_v4 colour;
} point;

static const celspan_texture *texture_of(const cursor *r) { return r->table->shade->texture; }

/* As cs_shade_at. */
static double at_column(const cursor *r, int32_t column) {
  const cs_shade *shade = r->table->shade;
  double x = column + 0.5, u = shade->plane[0][0] * x + r->u;
  if (shade->texture->kind == CS_TEXTURE_LINEAR)
    return u;
  double v = shade->plane[1][0] * x + r->v;
  return sqrt(u * u + v * v);
}

/* Held to the part, since where it ends has been rounded. */
static point take_point(const cursor *r, const cs_gradient_table_part *part, int32_t column) {
  double at = at_column(r, column);
  r->painter->evaluations++;
  return (point){column, at, cs_gradient_table_mix(part, at)};
}

/* ---------------------------------------------------------------- pieces */

/* The greatest change of a channel from here to there along the stops. */
static double steepness(const cs_gradient_table_part *part) {
  double most = 0;
  for (int c = 0; c < 4; c++)
    most = cs_number_most(fabs((double)part->step[c]), most);
  return most * part->scale;
}

/* Whether the line between two columns is near the colours between them. In a piece the second
 * derivative is greatest at the end nearer the centre: mostly that tells. */
static bool is_straight(const cursor *r, double steep, const point *first, const point *last) {
  double columns = last->column - first->column;
  double near = cs_number_least(first->at, last->at);
  double limit = CS_LINE_TOLERANCE;
  if (columns < 2 || columns * columns * r->bend * steep <= 8 * limit * near * near * near)
    return true;
  cs_run between = {first->column, last->column + 1, 0};
  static const int quarters[] = {2, 1, 3}; /* the middle first: there it is mostly farthest */
  for (int k = 0; k < 3; k++) {
    int32_t column = cs_line_quarter(between, quarters[k]);
    double u = (column - first->column) / columns;
    double off = at_column(r, column) - (first->at + u * (last->at - first->at));
    if (fabs(off) * steep > limit)
      return false;
  }
  return true;
}

/* Halves until pieces are straight; one of two columns is, so the depth is at most log2(width). */
static celspan_status put_arc(const cursor *r, const cs_gradient_table_part *part, double steep,
                              point first, point last) {
  if (is_straight(r, steep, &first, &last))
    return cs_line_put(r->painter->context, r->row, (cs_run){first.column, last.column + 1, 0},
                       first.colour, last.colour);
  int32_t middle = first.column + (last.column + 1 - first.column) / 2;
  CS_TRY(put_arc(r, part, steep, first, take_point(r, part, middle - 1)));
  return put_arc(r, part, steep, take_point(r, part, middle), last);
}

/* All up to a place x in which the gradient bends. */
static celspan_status put_until(cursor *r, double x) {
  int32_t from = r->from, end = cs_number_first_centre(x);
  end = end < r->end ? end : r->end;
  if (end <= from)
    return CELSPAN_OK;
  r->from = end;
  double at = at_column(r, from + (end - from) / 2);
  const cs_gradient_table_part *part =
      &r->table->parts[cs_gradient_table_part_at(r->table->shade, at)];
  point first = take_point(r, part, from), last = take_point(r, part, end - 1);
  return put_arc(r, part, steepness(part), first, last);
}

/* ---------------------------------------------------------------- rows */

static celspan_status run_linear(cursor *r) {
  const celspan_texture *texture = texture_of(r);
  double step = r->table->shade->plane[0][0];
  size_t count = step != 0 ? texture->stop_count : 0;
  for (size_t i = 0; i < count; i++) {
    const cs_stop *stop = &texture->stops[step > 0 ? i : count - 1 - i];
    CS_TRY(put_until(r, (stop->at - r->u) / step));
  }
  return put_until(r, r->end);
}

/* Half of what a circle around the centre covers of the row; negative where that is nothing. */
static double half_chord(const cursor *r, double at, double speed) {
  double square = at * at - r->bend / speed;
  return square > 0 ? sqrt(square / speed) : -1;
}

static celspan_status run_radial(cursor *r) {
  const celspan_texture *texture = texture_of(r);
  double su = r->table->shade->plane[0][0], sv = r->table->shade->plane[1][0];
  double speed = su * su + sv * sv, cross = r->u * sv - r->v * su;
  if (!(speed > 0))
    return put_until(r, r->end);
  double nearest = -(r->u * su + r->v * sv) / speed;
  r->bend = cross * cross;
  for (size_t i = texture->stop_count; i-- > 0;) {
    double half = half_chord(r, texture->stops[i].at, speed);
    if (half >= 0)
      CS_TRY(put_until(r, nearest - half));
  }
  CS_TRY(put_until(r, nearest));
  for (size_t i = 0; i < texture->stop_count; i++) {
    double half = half_chord(r, texture->stops[i].at, speed);
    if (half >= 0)
      CS_TRY(put_until(r, nearest + half));
  }
  return put_until(r, r->end);
}

bool cs_gradient_run_fits(const cs_gradient_table *table) {
  return table && table->layer_count == 0 && table->shade->is_affine;
}

celspan_status cs_gradient_run(cs_painter *painter, const cs_gradient_table *table, cs_run run,
                               cs_row *row) {
  const double *p = table->shade->plane[0], *q = table->shade->plane[1];
  cursor r = {.painter = painter,
              .table = table,
              .row = row,
              .u = p[1] * run.y + p[2],
              .v = q[1] * run.y + q[2],
              .from = run.x0,
              .end = run.x1};
  return table->shade->texture->kind == CS_TEXTURE_LINEAR ? run_linear(&r) : run_radial(&r);
}
