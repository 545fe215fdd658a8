#include "paint/gradient_run.h"

#include "paint/line.h"

#include <math.h>

/* A gradient along a row. `at` of its points is where they lie along the stops. */
typedef struct arc {
  cs_curve curve;
  cs_painter *painter;
  const cs_gradient_table *table;
  double u, v;       /* the shade's planes in x = 0 */
  double bend;       /* RADIAL: second derivative of the distance r along the row, times r cubed */
  int32_t from, end; /* what is left of the run */
  /* the part of the table between the two cuts at hand, and the greatest change there of a channel
   * from here to there along the stops */
  const cs_gradient_table_part *part;
  double steepness;
} arc;

static const celspan_texture *texture_of(const arc *a) { return a->table->shade->texture; }

/* As cs_shade_at. */
static double at_column(const arc *a, int32_t column) {
  const cs_shade *shade = a->table->shade;
  double x = column + 0.5, u = shade->plane[0][0] * x + a->u;
  if (shade->texture->kind == CS_TEXTURE_LINEAR)
    return u;
  double v = shade->plane[1][0] * x + a->v;
  return sqrt(u * u + v * v);
}

/* Of the current part, even where rounding puts the column beyond its end. */
static cs_line_point take_point(arc *a, int32_t column) {
  double at = at_column(a, column);
  a->painter->evaluations++;
  return (cs_line_point){column, at, cs_gradient_table_mix(a->part, at)};
}

/* ---------------------------------------------------------------- pieces */

static double steepness_of(const cs_gradient_table_part *part) {
  double most = 0;
  for (int c = 0; c < 4; c++)
    most = cs_number_most(fabs((double)part->step[c]), most);
  return most * part->scale;
}

/* In a piece the second derivative is greatest at the end nearer the centre: mostly that decides,
 * else the quarters are compared, without their colours. */
static celspan_status test(cs_curve *curve, const cs_line_point *first, const cs_line_point *last,
                           bool *is_straight) {
  const arc *a = (const arc *)curve;
  double columns = last->column - first->column;
  double near = cs_number_least(first->at, last->at);
  double limit = CS_LINE_TOLERANCE;
  *is_straight = true;
  if (columns < 2 || columns * columns * a->bend * a->steepness <= 8 * limit * near * near * near)
    return CELSPAN_OK;
  static const int quarters[] = {2, 1, 3}; /* the middle first: there it is mostly farthest */
  for (int k = 0; k < 3 && *is_straight; k++) {
    int32_t column = cs_line_quarter(cs_line_run(first, last), quarters[k]);
    double u = (column - first->column) / columns;
    double off = at_column(a, column) - (first->at + u * (last->at - first->at));
    *is_straight = !(fabs(off) * a->steepness > limit);
  }
  return CELSPAN_OK;
}

static celspan_status split(cs_curve *curve, int32_t column, cs_line_point points[2]) {
  arc *a = (arc *)curve;
  points[0] = take_point(a, column);
  points[1] = take_point(a, column + 1);
  return CELSPAN_OK;
}

/* All up to a place x in which the gradient bends. */
static celspan_status put_until(arc *a, double x) {
  int32_t from = a->from, end = cs_number_first_centre(x);
  end = end < a->end ? end : a->end;
  if (end <= from)
    return CELSPAN_OK;
  a->from = end;
  double at = at_column(a, from + (end - from) / 2);
  a->part = &a->table->parts[cs_gradient_table_part_at(a->table->shade, at)];
  a->steepness = steepness_of(a->part);
  cs_line_point first = take_point(a, from), last = take_point(a, end - 1);
  return cs_line_fit(&a->curve, &first, &last);
}

/* ---------------------------------------------------------------- rows */

static celspan_status run_linear(arc *a) {
  const celspan_texture *texture = texture_of(a);
  double step = a->table->shade->plane[0][0];
  size_t count = step != 0 ? texture->stop_count : 0;
  for (size_t i = 0; i < count; i++) {
    const cs_stop *stop = &texture->stops[step > 0 ? i : count - 1 - i];
    CS_TRY(put_until(a, (stop->at - a->u) / step));
  }
  return put_until(a, a->end);
}

/* Half of what a circle around the centre covers of the row; negative where that is nothing. */
static double half_chord(const arc *a, double at, double speed) {
  double square = at * at - a->bend / speed;
  return square > 0 ? sqrt(square / speed) : -1;
}

static celspan_status run_radial(arc *a) {
  const celspan_texture *texture = texture_of(a);
  double su = a->table->shade->plane[0][0], sv = a->table->shade->plane[1][0];
  double speed = su * su + sv * sv, cross = a->u * sv - a->v * su;
  if (!(speed > 0))
    return put_until(a, a->end);
  double nearest = -(a->u * su + a->v * sv) / speed;
  a->bend = cross * cross;
  for (size_t i = texture->stop_count; i-- > 0;) {
    double half = half_chord(a, texture->stops[i].at, speed);
    if (half >= 0)
      CS_TRY(put_until(a, nearest - half));
  }
  CS_TRY(put_until(a, nearest));
  for (size_t i = 0; i < texture->stop_count; i++) {
    double half = half_chord(a, texture->stops[i].at, speed);
    if (half >= 0)
      CS_TRY(put_until(a, nearest + half));
  }
  return put_until(a, a->end);
}

bool cs_gradient_run_fits(const cs_gradient_table *table) {
  return table && table->layer_count == 0 && table->shade->is_affine;
}

celspan_status cs_gradient_run(cs_painter *painter, const cs_gradient_table *table, cs_run run,
                               cs_row *row) {
  const double *p = table->shade->plane[0], *q = table->shade->plane[1];
  arc a = {.curve = {painter->context, row, test, split},
           .painter = painter,
           .table = table,
           .u = p[1] * run.y + p[2],
           .v = q[1] * run.y + q[2],
           .from = run.x0,
           .end = run.x1};
  return table->shade->texture->kind == CS_TEXTURE_LINEAR ? run_linear(&a) : run_radial(&a);
}
